#include "transport/devicenet/motor_probe.h"

#include "devicenet/error_codes.h"

namespace nord_driver {

using devicenet::ExplicitEnd;

namespace {

constexpr std::uint8_t kMotorData = 40;
constexpr std::uint8_t kPoleCount = 12;

}  // namespace

std::optional<devicenet::ExplicitRequest> MotorProbe::pendingRequest(Instant now) const noexcept {
  if (under_way_ || asked_ || now < next_) return std::nullopt;
  return devicenet::getAttribute(id(), kMotorData, inverter_, kPoleCount);
}

void MotorProbe::handleAnswer(const devicenet::ExplicitAnswer& answer, Instant now) noexcept {
  if (!under_way_ || answer.id != id()) return;
  under_way_ = false;
  ++sequence_;
  switch (answer.end) {
    case ExplicitEnd::kDone:
      asked_ = true;
      poles_ = answer.number().value_or(0);
      break;
    case ExplicitEnd::kRefused:
      // Not every module need have the object; an inverter that is off is asked again.
      asked_ = answer.general != devicenet::general_error::kResourceUnavailable;
      next_ = now + kPause;
      break;
    case ExplicitEnd::kTooLong:
      asked_ = true;
      break;
    case ExplicitEnd::kTimedOut:
    case ExplicitEnd::kNotConnected:
      next_ = now + kPause;
      break;
  }
}

void MotorProbe::handleOffline() noexcept {
  under_way_ = asked_ = false;
  ++sequence_;
  next_ = {};
}

std::optional<Sentence> MotorProbe::takeFinding() noexcept {
  const auto configured = static_cast<std::uint32_t>(2 * pole_pairs_);
  if (poles_ == 0 || poles_ == configured || poles_ == found_) return std::nullopt;
  found_ = poles_;
  Sentence text;
  text.format(
      "its motor has %u poles by class 40 of the module, pole_pairs: %d is configured: speeds and ways are wrong "
      "by that",
      static_cast<unsigned>(poles_), pole_pairs_);
  return text;
}

}  // namespace nord_driver
