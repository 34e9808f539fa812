#include "transport/canopen/canopen_parameters.h"

#include "canopen/sdo_abort.h"
#include "transport/canopen/sdo_refusal.h"

namespace nord_driver {

using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterRequest;
using profile::ParameterShape;

bool CanopenParameters::submit(const ParameterRequest& request) noexcept {
  const bool idle = requests_.empty();
  if (!requests_.submit(request)) return false;
  if (idle) next();
  return true;
}

// The running request's turn. What no server need be asked for is answered here.
void CanopenParameters::next() noexcept {
  plain_ = false;
  ++sequence_;
  while (!requests_.empty()) {
    if (requests_.front().action == ParameterAction::kWriteRam) {
      requests_.refuse(ParameterReason::kNotSupported, "SDO has no write that spares the EEPROM");
    } else if (!parameterObject(drive_, requests_.front())) {
      requests_.refuse(ParameterReason::kNoSuchElement, "no sub-index reaches this array element");
    } else {
      return;
    }
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
      takeValue(answer);
      break;
    case canopen::SdoEnd::kAbortedByServer:
      if (fallBack(answer.abort_code)) return;
      [[fallthrough]];
    case canopen::SdoEnd::kAbortedByUs:
      requests_.refuse(reasonOfAbort(answer.abort_code, requests_.front()), abortSentence(answer.abort_code));
      break;
    case canopen::SdoEnd::kTimedOut:
      requests_.fail(ParameterOutcome::kTimeout);
      break;
  }
  next();
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

void CanopenParameters::takeValue(const canopen::SdoAnswer& answer) noexcept {
  const ParameterRequest& request = requests_.front();
  if (request.action != ParameterAction::kRead) return requests_.done(request.raw);
  if (const auto number = answer.number()) {
    // Whether a 16 bit word is signed only the parameter's own description knows.
    return requests_.done(static_cast<std::int32_t>(*number));
  }
  Sentence text;
  text.format("the SDO answer is %u bytes long, which no parameter's value is",
              static_cast<unsigned>(answer.data.size()));
  requests_.refuse(ParameterReason::kUnreadable, text);
}

void CanopenParameters::handleOffline() noexcept {
  under_way_ = false;
  requests_.failAll(ParameterOutcome::kOffline);
}

}  // namespace nord_driver
