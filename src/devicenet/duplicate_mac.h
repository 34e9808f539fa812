// The duplicate-MAC check, our side of it: two requests with a second of silence after each before anything else is
// sent; on-line every request of another device is answered. A second device with our MAC id is a communication fault.
#pragma once

#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "core/timer_table.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

/// What tells two devices with one MAC id apart.
struct DeviceSignature {
  std::uint16_t vendor_id = 0;
  std::uint32_t serial_number = 0;
};

struct DuplicateMacMessage {
  bool response = false;
  DeviceSignature sender;
};

/// Nothing when it does not have the seven bytes of one.
std::optional<DuplicateMacMessage> readDuplicateMac(const CanFrame& frame) noexcept;
CanFrame duplicateMacFrame(std::uint8_t mac, const DuplicateMacMessage& message) noexcept;

class DuplicateMacCheck {
 public:
  enum class State : std::uint8_t {
    kOff,       ///< nothing is sent
    kFirst,     ///< the first request, and the second after it
    kSecond,    ///< the second request
    kOnline,    ///< nobody objected
    kCommFault  ///< another device has our MAC id. Silent, then from the beginning
  };

  /// `pause`: of silence in a communication fault.
  DuplicateMacCheck(std::uint8_t mac, DeviceSignature own, Duration pause) noexcept
      : mac_(mac), own_(own), pause_(pause) {}

  void restart() noexcept;
  void stop() noexcept;
  /// A message with our MAC id.
  void handle(const DuplicateMacMessage& message, Instant now) noexcept;
  void poll(Instant now) noexcept;
  bool pollTransmit(CanFrame& frame, Instant now) noexcept;
  /// The link did not take the frame given out last: it comes again.
  void notSent(const CanFrame& frame) noexcept;
  std::optional<Instant> nextDeadline() const noexcept { return timers_.nextTimeout(); }

  State state() const noexcept { return state_; }
  bool online() const noexcept { return state_ == State::kOnline; }
  /// In a communication fault: who it was.
  DeviceSignature rival() const noexcept { return rival_; }

 private:
  enum class Timer : std::uint8_t { kSilence, kAgain, kCount };

  void request(State state) noexcept;

  std::uint8_t mac_;
  DeviceSignature own_;
  Duration pause_;
  State state_ = State::kOff;
  TimerTable<Timer> timers_;
  std::optional<CanFrame> due_;
  DeviceSignature rival_;
};

}  // namespace nord_driver::devicenet
