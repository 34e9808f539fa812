#include "transport/devicenet/state_probe.h"

#include "devicenet/error_codes.h"

namespace nord_driver {

using devicenet::ExplicitEnd;

std::optional<devicenet::ExplicitRequest> StateProbe::pendingRequest(Instant now) const noexcept {
  if (under_way_ || now < next_ || (!always_ && !absent_)) return std::nullopt;
  return devicenet::getAttribute(id(), devicenet::object_class::kControlSupervisor, inverter_,
                                 devicenet::supervisor_attribute::kState);
}

void StateProbe::handleAnswer(const devicenet::ExplicitAnswer& answer, Instant now) noexcept {
  if (!under_way_ || answer.id != id()) return;
  under_way_ = false;
  ++sequence_;
  next_ = now + kPause;
  switch (answer.end) {
    case ExplicitEnd::kDone:
      known_ = true;
      absent_ = false;
      state_.reset();
      if (!answer.data.empty()) state_ = answer.data[0];
      break;
    case ExplicitEnd::kRefused:
      // Any other refusal is about the object: who can tell that the object is missing need not be.
      known_ = true;
      absent_ = answer.general == devicenet::general_error::kResourceUnavailable;
      state_.reset();
      break;
    case ExplicitEnd::kTooLong:
      break;
    case ExplicitEnd::kTimedOut:
    case ExplicitEnd::kNotConnected:
      known_ = false;
      state_.reset();
      break;
  }
}

void StateProbe::handleAbsence() noexcept {
  known_ = true;
  absent_ = true;
  state_.reset();
}

void StateProbe::handleOffline() noexcept {
  under_way_ = false;
  ++sequence_;
  known_ = false;
  absent_ = false;
  state_.reset();
  next_ = {};
}

}  // namespace nord_driver
