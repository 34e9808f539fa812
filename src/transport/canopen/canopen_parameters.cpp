#include "transport/canopen/canopen_parameters.h"

#include "canopen/sdo_abort.h"
#include "profile/parameter_error.h"
#include "profile/pkw.h"

namespace nord_driver {

using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterRequest;
using profile::ParameterResult;
using profile::ParameterShape;

bool CanopenParameters::submit(const ParameterRequest& request) noexcept {
  if (!requests_.submit(request)) return false;
  if (requests_.size() == 1) next();
  return true;
}

// What no server need be asked for is answered here.
void CanopenParameters::next() noexcept {
  plain_ = false;
  ++sequence_;
  while (!requests_.empty()) {
    const ParameterRequest& request = requests_.front();
    ParameterResult refused;
    refused.outcome = ParameterOutcome::kRefused;
    if (!parameterObject(drive_, request)) {
      const bool number = request.number > 999;
      refused.error_number = number ? profile::pkw_error::kInvalidNumber : profile::pkw_error::kWrongSubIndex;
    } else if (request.action == ParameterAction::kWriteRam) {
      refused.error_number = profile::pkw_error::kInvalidOrder;
    } else {
      return;
    }
    requests_.finish(refused);
  }
}

std::optional<canopen::SdoRequest> CanopenParameters::pendingAccess() const noexcept {
  if (under_way_ || requests_.empty()) return std::nullopt;
  const ParameterRequest& request = requests_.front();
  ObjectAddress object = *parameterObject(drive_, request);
  if (plain_) object.sub_index = 0;
  if (request.action == ParameterAction::kRead) return canopen::sdoRead(accessId(), object.index, object.sub_index);
  // Values are 16 bits wide but for positions (BU 0050 p. 42).
  return canopen::sdoWrite(accessId(), object.index, object.sub_index, static_cast<std::uint32_t>(request.raw),
                           request.double_word ? 4 : 2);
}

void CanopenParameters::handleAnswer(const canopen::SdoAnswer& answer) noexcept {
  if (!under_way_ || requests_.empty() || answer.id != accessId()) return;
  under_way_ = false;
  switch (answer.end) {
    case canopen::SdoEnd::kDone:
      return handleValue(answer);
    case canopen::SdoEnd::kAbortedByServer:
      if (fallBack(answer.abort_code)) return;
      [[fallthrough]];
    case canopen::SdoEnd::kAbortedByUs:
      return refuse(profile::errorNumberOfAbort(answer.abort_code, requests_.front()), answer.abort_code);
    case canopen::SdoEnd::kTimedOut:
      return finish(ParameterOutcome::kTimeout);
  }
}

// As on PKW: a parameter without sets may be read without one, and so may the first element of what older firmware
// has as a plain parameter (P700: BU 0020 8).
bool CanopenParameters::fallBack(std::uint32_t abort_code) noexcept {
  const ParameterRequest& request = requests_.front();
  if (plain_ || abort_code != canopen::sdo_abort::kNoSubIndex || request.action != ParameterAction::kRead) return false;
  const bool first = request.shape == ParameterShape::kPerSet || request.index == 1;
  if (request.shape == ParameterShape::kPlain || !first) return false;
  plain_ = true;
  ++sequence_;
  return true;
}

void CanopenParameters::handleValue(const canopen::SdoAnswer& answer) noexcept {
  const ParameterRequest& request = requests_.front();
  if (request.action != ParameterAction::kRead) return finish(ParameterOutcome::kDone, request.raw);
  const auto number = answer.number();
  if (!number) return refuse(profile::pkw_error::kNotRepresentable, 0);
  // Whether a 16 bit word is signed only the parameter's own description knows.
  finish(ParameterOutcome::kDone, static_cast<std::int32_t>(*number));
}

void CanopenParameters::finish(ParameterOutcome outcome, std::int32_t raw) noexcept {
  ParameterResult result;
  result.outcome = outcome;
  result.raw = raw;
  requests_.finish(result);
  next();
}

void CanopenParameters::refuse(std::uint16_t error_number, std::uint32_t abort_code) noexcept {
  ParameterResult result;
  result.outcome = ParameterOutcome::kRefused;
  result.error_number = error_number;
  result.abort_code = abort_code;
  requests_.finish(result);
  next();
}

void CanopenParameters::handleOffline() noexcept {
  under_way_ = false;
  while (!requests_.empty()) finish(ParameterOutcome::kOffline);
}

}  // namespace nord_driver
