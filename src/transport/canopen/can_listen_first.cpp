#include "transport/canopen/can_listen_first.h"

namespace nord_driver {

namespace {

// The pre-defined connection set (CiA 301 7.3.3).
constexpr std::uint32_t kEmergencyBase = 0x080;
constexpr std::uint32_t kErrorControlBase = 0x700;
constexpr std::uint32_t kMaxNode = 127;
constexpr std::uint8_t kEmergencySize = 8;
constexpr std::uint8_t kBootUp = 0x00, kStopped = 0x04, kPreOperational = 0x7F;

bool isOfNode(std::uint32_t id, std::uint32_t base) noexcept {
  return id > base && id <= base + kMaxNode;
}

}  // namespace

bool isSaidUnasked(const CanFrame& frame) noexcept {
  if (frame.extended || frame.remote) return false;
  if (isOfNode(frame.id, kEmergencyBase)) return frame.size == kEmergencySize;
  if (!isOfNode(frame.id, kErrorControlBase) || frame.size != 1) return false;
  const std::uint8_t state = frame.data[0];
  return state == kBootUp || state == kStopped || state == kPreOperational;
}

void CanListenFirst::restart(Instant now) noexcept {
  heard_.reset();
  end_ = now + time_;
  listening_ = true;
}

void CanListenFirst::handle(const CanFrame& frame) noexcept {
  if (listening_ && !heard_ && !isSaidUnasked(frame)) heard_ = frame.id;
}

void CanListenFirst::handleMaster(std::uint32_t id, Instant at) noexcept {
  if (who_ == CanListener::kGuest) {
    if (!heard_) heard_ = id;
  } else if (listening_) {
    heard_ = id;
    end_ = at + kGone;
  }
}

bool CanListenFirst::mayTalk(Instant now) noexcept {
  const auto end = nextDeadline();
  if (end && now >= *end) {
    listening_ = false;
    heard_.reset();
  }
  return !isSilent();
}

std::optional<Instant> CanListenFirst::nextDeadline() const noexcept {
  const bool for_good = heard_ && who_ == CanListener::kGuest;
  return listening_ && !for_good ? std::optional<Instant>{end_} : std::nullopt;
}

Sentence CanListenFirst::text() const noexcept {
  Sentence text;
  if (heard_ && who_ == CanListener::kDriver) {
    text.format(
        "another master works with these nodes: %03Xh was seen; nothing is sent until it has been silent for %d s",
        static_cast<unsigned>(*heard_), static_cast<int>(kGone.count()));
  } else if (heard_) {
    text.format(
        "the bus is in use: %03Xh was seen; nothing is sent beside another master, nor to nodes that one has left "
        "operational: end it, or switch them off and on",
        static_cast<unsigned>(*heard_));
  } else if (listening_) {
    text = "listens for others on the bus before anything is sent";
  }
  return text;
}

}  // namespace nord_driver
