#include "link/can/can_health.h"

#include <linux/can/error.h>

#include <cstring>

namespace nord_driver::link {

const std::uint32_t kCanErrorClasses =
    CAN_ERR_TX_TIMEOUT | CAN_ERR_CRTL | CAN_ERR_PROT | CAN_ERR_TRX | CAN_ERR_ACK | CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;

namespace {

constexpr std::chrono::seconds kSecond{1};
/// A lone disturbance is daily life; this many in a second are not.
constexpr std::uint32_t kErrorRateToTell = 5;

/// Some drivers have a class for it, others name the place in the frame.
bool isMissingAcknowledge(const CanErrorFrame& error) noexcept {
  return (error.classes & CAN_ERR_ACK) != 0 ||
         ((error.classes & CAN_ERR_PROT) != 0 && error.data[3] == CAN_ERR_PROT_LOC_ACK);
}

}  // namespace

void CanHealth::opened(const CanInterface& interface) noexcept {
  state_ = CanState::kUnknown;
  nobody_acknowledges_ = restart_refused_ = false;
  full_in_a_row_ = good_frames_ = 0;
  errors_this_second_ = error_rate_ = 0;
  handleInterface(interface);
}

void CanHealth::enter(CanState state) noexcept {
  if (state == state_) return;
  if (state == CanState::kBusOff) {
    ++counters_.bus_off;
    restart_refused_ = false;
  } else if (state_ == CanState::kBusOff && state != CanState::kDown) {
    ++counters_.restarts;
  }
  state_ = state;
  good_frames_ = 0;
}

void CanHealth::handleDown() noexcept {
  interface_.up = false;
  enter(CanState::kDown);
}

void CanHealth::handleInterface(const CanInterface& interface) noexcept {
  interface_ = interface;
  if (!interface.up) {
    enter(CanState::kDown);
  } else if (interface.state != CanState::kUnknown) {
    enter(interface.state);
  } else if (state_ == CanState::kDown) {
    enter(CanState::kUnknown);
  }
}

void CanHealth::handleController(std::uint8_t status) noexcept {
  if ((status & CAN_ERR_CRTL_ACTIVE) != 0) {
    enter(CanState::kActive);
  } else {
    ++counters_.controller_errors;
  }
  if ((status & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) != 0) enter(CanState::kWarning);
  if ((status & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0) enter(CanState::kPassive);
}

void CanHealth::countBusError(Instant now) noexcept {
  ++counters_.bus_errors;
  if (now - second_begins_ >= kSecond) {
    second_begins_ = now;
    errors_this_second_ = 0;
  }
  ++errors_this_second_;
  if (errors_this_second_ >= kErrorRateToTell) error_rate_ = errors_this_second_;
}

void CanHealth::handleError(const CanErrorFrame& error, Instant now) noexcept {
  good_frames_ = 0;
  if (isMissingAcknowledge(error)) {
    ++counters_.no_acknowledge;
    nobody_acknowledges_ = true;
  } else if ((error.classes & CAN_ERR_PROT) != 0) {
    countBusError(now);
  }
  if ((error.classes & CAN_ERR_CRTL) != 0) handleController(error.data[1]);
  if ((error.classes & (CAN_ERR_TRX | CAN_ERR_TX_TIMEOUT)) != 0) ++counters_.controller_errors;
  if ((error.classes & CAN_ERR_BUSOFF) != 0) enter(CanState::kBusOff);
  if ((error.classes & CAN_ERR_RESTARTED) != 0) {
    nobody_acknowledges_ = false;
    enter(CanState::kActive);
  }
}

void CanHealth::handleFrame() noexcept {
  nobody_acknowledges_ = false;  // whoever sends this acknowledges, too
  if (good_frames_ >= kFramesToRecover || ++good_frames_ < kFramesToRecover) return;
  error_rate_ = 0;
  if (state_ == CanState::kWarning || state_ == CanState::kPassive) enter(CanState::kActive);
}

void CanHealth::handleSent() noexcept {
  full_in_a_row_ = 0;
  if (state_ != CanState::kDown) return;
  interface_.up = true;
  enter(CanState::kUnknown);
}

void CanHealth::handleQueueFull() noexcept {
  ++counters_.queue_full;
  if (full_in_a_row_ < kFullToTell) ++full_in_a_row_;
}

bool CanHealth::wantsRestart() const noexcept {
  return state_ == CanState::kBusOff && interface_.has_controller && interface_.restart_ms == 0 && !restart_refused_;
}

void CanHealth::tellBusOff() const noexcept {
  const char* name = interface_.name.c_str();
  constexpr const char* kCause = "too many errors: check the wiring, the termination and the bit rate of every node";
  if (interface_.restart_ms > 0) {
    advice_.format("%s is bus-off (%s); it restarts by itself after %u ms", name, kCause,
                   static_cast<unsigned>(interface_.restart_ms));
  } else if (restart_refused_) {
    advice_.format("%s is bus-off (%s); to restart it: sudo ip link set %s type can restart", name, kCause, name);
  } else if (interface_.has_controller) {
    advice_.format("%s is bus-off (%s); a restart is asked for every second", name, kCause);
  } else {
    advice_.format("%s is bus-off (%s)", name, kCause);
  }
}

const char* CanHealth::advice() const noexcept {
  const char* name = interface_.name.c_str();
  advice_.clear();
  if (state_ == CanState::kDown) {
    advice_.format("%s is down: sudo ip link set %s up%s", name, name,
                   interface_.has_controller && interface_.bit_rate == 0 ? " type can bitrate RATE" : "");
  } else if (state_ == CanState::kBusOff) {
    tellBusOff();
  } else if (nobody_acknowledges_) {
    advice_.format("%s: no other node acknowledges: are the drives powered and is the bus terminated?", name);
  } else if (state_ == CanState::kPassive) {
    advice_.format(
        "%s is error passive: no other node acknowledges, or the bus is disturbed: check power, wiring, termination "
        "(120 ohm at both ends) and the bit rate of every node",
        name);
  } else if (full_in_a_row_ >= kFullToTell) {
    advice_.format("%s: frames do not leave, the send queue stays full: is the bus overloaded, or does no node answer?",
                   name);
  } else if (state_ == CanState::kWarning) {
    advice_.format("%s: many errors on the bus: check wiring, shield and termination (120 ohm at both ends)", name);
  } else if (error_rate_ > 0) {
    advice_.format(
        "%s: %u bus errors within a second: check wiring, shield, termination and the bit rate of every node", name,
        static_cast<unsigned>(error_rate_));
  } else if (std::strcmp(interface_.queue.c_str(), "fq_codel") == 0) {
    // It throws frames away that waited; on a CAN interface nobody is told.
    advice_.format("%s: its queue fq_codel loses frames: sudo tc qdisc replace dev %s root pfifo_fast", name, name);
  }
  return advice_.c_str();
}

}  // namespace nord_driver::link
