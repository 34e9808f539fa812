#include "nord_driver/transport/canopen_parameters.h"

#include "nord_driver/canopen/sdo_abort.h"
#include "nord_driver/profile/parameter_error.h"
#include "nord_driver/profile/pkw.h"

namespace nord_driver {

using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterRequest;
using profile::ParameterResult;
using profile::ParameterShape;

bool CanopenParameters::submit(const ParameterRequest& request) noexcept {
  if (waiting_.size() + results_.size() >= kCapacity) return false;
  waiting_.push_back(request);
  if (waiting_.size() == 1) next();
  return true;
}

// What no server need be asked for is answered here.
void CanopenParameters::next() noexcept {
  plain_ = false;
  ++sequence_;
  while (!waiting_.empty()) {
    const ParameterRequest& request = waiting_[0];
    std::uint16_t error = 0;
    if (!parameterObject(drive_, request)) {
      const bool number = request.number > 999;
      error = number ? profile::pkw_error::kInvalidNumber : profile::pkw_error::kWrongSubIndex;
    } else if (request.action == ParameterAction::kWriteRam) {
      error = profile::pkw_error::kInvalidOrder;
    } else {
      return;
    }
    ParameterResult result;
    result.id = request.id;
    result.outcome = ParameterOutcome::kRefused;
    result.error_number = error;
    results_.push_back(result);
    waiting_.eraseFront(1);
  }
}

std::optional<canopen::SdoRequest> CanopenParameters::pendingAccess() const noexcept {
  if (under_way_ || waiting_.empty()) return std::nullopt;
  const ParameterRequest& request = waiting_[0];
  ObjectAddress object = *parameterObject(drive_, request);
  if (plain_) object.sub_index = 0;
  if (request.action == ParameterAction::kRead) return canopen::sdoRead(accessId(), object.index, object.sub_index);
  // Values are 16 bits wide but for positions (BU 0050 p. 42).
  return canopen::sdoWrite(accessId(), object.index, object.sub_index, static_cast<std::uint32_t>(request.raw),
                           request.double_word ? 4 : 2);
}

void CanopenParameters::handleAnswer(const canopen::SdoAnswer& answer) noexcept {
  if (!under_way_ || waiting_.empty() || answer.id != accessId()) return;
  under_way_ = false;
  switch (answer.end) {
    case canopen::SdoEnd::kDone:
      return handleValue(answer);
    case canopen::SdoEnd::kAbortedByServer:
      if (fallBack(answer.abort_code)) return;
      return finish(ParameterOutcome::kRefused, 0, profile::errorNumberOfAbort(answer.abort_code, waiting_[0]));
    case canopen::SdoEnd::kAbortedByUs:
      return finish(ParameterOutcome::kRefused, 0, profile::errorNumberOfAbort(answer.abort_code, waiting_[0]));
    case canopen::SdoEnd::kTimedOut:
      return finish(ParameterOutcome::kTimeout, 0, 0);
  }
}

// As on PKW: a parameter without sets may be read without one, and so may the first element of what older firmware
// has as a plain parameter (P700: BU 0020 8).
bool CanopenParameters::fallBack(std::uint32_t abort_code) noexcept {
  const ParameterRequest& request = waiting_[0];
  if (plain_ || abort_code != canopen::sdo_abort::kNoSubIndex || request.action != ParameterAction::kRead) return false;
  const bool first = request.shape == ParameterShape::kPerSet || request.index == 1;
  if (request.shape == ParameterShape::kPlain || !first) return false;
  plain_ = true;
  ++sequence_;
  return true;
}

void CanopenParameters::handleValue(const canopen::SdoAnswer& answer) noexcept {
  const ParameterRequest& request = waiting_[0];
  if (request.action != ParameterAction::kRead) return finish(ParameterOutcome::kDone, request.raw, 0);
  const auto number = answer.number();
  if (!number) return finish(ParameterOutcome::kRefused, 0, profile::pkw_error::kNotRepresentable);
  // Whether a 16 bit word is signed only the parameter's own description knows.
  finish(ParameterOutcome::kDone, static_cast<std::int32_t>(*number), 0);
}

void CanopenParameters::finish(ParameterOutcome outcome, std::int32_t raw, std::uint16_t error_number) noexcept {
  ParameterResult result;
  result.id = waiting_[0].id;
  result.outcome = outcome;
  result.raw = raw;
  result.error_number = error_number;
  results_.push_back(result);
  waiting_.eraseFront(1);
  next();
}

void CanopenParameters::handleOffline() noexcept {
  under_way_ = false;
  while (!waiting_.empty()) finish(ParameterOutcome::kOffline, 0, 0);
}

std::optional<ParameterResult> CanopenParameters::pollResult() noexcept {
  if (results_.empty()) return std::nullopt;
  const ParameterResult result = results_[0];
  results_.eraseFront(1);
  return result;
}

}  // namespace nord_driver
