#include "transport/devicenet/devicenet_listen_first.h"

#include "devicenet/identifier.h"

namespace nord_driver {

using devicenet::Group1;
using devicenet::Group2;

bool isOfMaster(const CanFrame& frame) noexcept {
  const auto id = devicenet::readIdentifier(frame.id);
  if (frame.extended || frame.remote || !id) return false;
  if (id->group == 1) return id->message >= static_cast<std::uint8_t>(Group1::kMulticastPollResponse);
  if (id->group != 2) return false;
  // A slave's explicit response is also its heartbeat, which nobody need have asked for.
  const auto message = static_cast<Group2>(id->message);
  return message != Group2::kDuplicateMac && message != Group2::kSlaveExplicit;
}

void DevicenetListenFirst::restart(Instant now) noexcept {
  heard_.reset();
  end_ = now + time_;
  listening_ = true;
}

void DevicenetListenFirst::handle(const CanFrame& frame) noexcept {
  if (listening_ && !heard_ && isOfMaster(frame)) heard_ = frame.id;
}

void DevicenetListenFirst::handleScanner(std::uint32_t id) noexcept {
  if (!heard_) heard_ = id;
}

bool DevicenetListenFirst::mayTalk(Instant now) noexcept {
  if (!heard_ && listening_ && now >= end_) listening_ = false;
  return !isSilent();
}

std::optional<Instant> DevicenetListenFirst::nextDeadline() const noexcept {
  return listening_ && !heard_ ? std::optional<Instant>{end_} : std::nullopt;
}

Sentence DevicenetListenFirst::text() const noexcept {
  Sentence text;
  if (heard_) {
    text.format("the bus is in use: %03Xh was seen; nothing is sent beside another scanner: end it",
                static_cast<unsigned>(*heard_));
  } else if (listening_) {
    text = "listens for others on the bus before anything is sent";
  }
  return text;
}

}  // namespace nord_driver
