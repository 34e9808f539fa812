#include "canopen/node_guard.h"

#include <algorithm>

#include "canopen/nmt.h"

namespace nord_driver::canopen {
namespace {

constexpr std::uint8_t kToggle = 0x80;

}  // namespace

NodeGuard::NodeGuard(std::uint8_t node, Duration guard_time, std::uint8_t life_time_factor) noexcept
    : node_(node), guard_time_(guard_time), life_time_(guard_time * life_time_factor) {}

void NodeGuard::start(bool fresh, Instant now) noexcept {
  next_question_ = now + guard_time_;
  life_end_ = now + life_time_;
  over_ = false;
  due_ = true;
  open_ = false;
  expected_toggle_.reset();
  if (fresh) expected_toggle_ = std::uint8_t{0};
}

void NodeGuard::stop() noexcept {
  next_question_.reset();
  due_ = false;
  open_ = false;
}

GuardAnswer NodeGuard::handle(std::uint8_t value, Instant now) noexcept {
  if (!open_) return GuardAnswer::kNotAsked;
  open_ = false;
  const std::uint8_t toggle = value & kToggle;
  if (expected_toggle_ && *expected_toggle_ != toggle) return GuardAnswer::kWrongToggle;
  expected_toggle_ = static_cast<std::uint8_t>(toggle ^ kToggle);
  life_end_ = now + life_time_;
  over_ = false;
  return GuardAnswer::kAccepted;
}

bool NodeGuard::poll(Instant now) noexcept {
  over_ = expired(now);
  if (!running() || now < *next_question_) return false;
  // A late look asks once, not once for each time that was missed.
  next_question_ = std::max(*next_question_ + guard_time_, now + guard_time_ / 2);
  const bool missed = open_;
  // The node may have toggled in an answer that did not reach us: the next one sets the bit anew.
  if (missed) expected_toggle_.reset();
  open_ = false;
  due_ = true;
  return missed;
}

bool NodeGuard::pollTransmit(CanFrame& frame) noexcept {
  if (!due_) return false;
  due_ = false;
  open_ = true;
  frame = remoteFrame(kErrorControlBase + node_, 1);
  return true;
}

std::optional<Instant> NodeGuard::nextDeadline() const noexcept {
  if (!running() || over_) return next_question_;
  return std::min(*next_question_, life_end_);
}

}  // namespace nord_driver::canopen
