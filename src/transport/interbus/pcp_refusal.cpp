#include "transport/interbus/pcp_refusal.h"

#include "interbus/pcp_error.h"

namespace nord_driver {

using profile::ParameterReason;

namespace {

ParameterReason reasonOfAccess(const interbus::PcpError& error) noexcept {
  switch (error.code) {
    case 2:
      return ParameterReason::kDeviceFailure;
    case 3:
      return ParameterReason::kReadOnly;
    case 5:
      if (error.additional == 0x11) return ParameterReason::kNoSuchElement;
      return error.additional == 0x12 || error.additional == 0x13 ? ParameterReason::kWrongType
                                                                  : ParameterReason::kOther;
    case 1:
    case 6:
    case 7:
      return ParameterReason::kNoSuchParameter;
    case 8:
      return ParameterReason::kWrongType;
    default:
      return ParameterReason::kOther;
  }
}

ParameterReason reasonOfDevice(unsigned additional) noexcept {
  if (additional >= 0x30 && additional <= 0x36) return ParameterReason::kOutOfLimits;
  switch (additional) {
    case 0x20:
    case 0x22:
    case 0x43:
      return ParameterReason::kNotNow;
    case 0x21:
      return ParameterReason::kNoRight;
    default:
      return ParameterReason::kOther;
  }
}

}  // namespace

ParameterReason reasonOfPcp(const interbus::PcpError& error, const profile::ParameterRequest& request) noexcept {
  ParameterReason reason = ParameterReason::kOther;
  if (isLost(error)) reason = ParameterReason::kNotNow;
  if (error.error_class == 6) reason = reasonOfAccess(error);
  if (error.error_class == 8 && error.code == 0) reason = reasonOfDevice(error.additional);
  const bool only_sets = request.shape == profile::ParameterShape::kPerSet;
  return reason == ParameterReason::kNoSuchElement && only_sets ? ParameterReason::kNotIndexed : reason;
}

Sentence pcpSentence(const interbus::PcpError& error) noexcept {
  Sentence text;
  text.format("PCP error %u/%u (additional code %04Xh), %s", unsigned{error.error_class}, unsigned{error.code},
              unsigned{error.additional}, interbus::pcpErrorMeaning(error));
  return text;
}

}  // namespace nord_driver
