#include "transport/profibus/record_refusal.h"

namespace nord_driver {

using profile::ParameterReason;

// By class and reason in Error_Code_1 (DP-V1).
ParameterReason reasonOf(const profibus::RecordError& error) noexcept {
  if (!error.isOfDpv1()) return ParameterReason::kOther;
  switch (error.code1) {
    case 0xA0:  // read error
    case 0xA1:  // write error
    case 0xA2:  // module failure
      return ParameterReason::kDeviceFailure;
    case 0xB5:  // state conflict
    case 0xC0:  // read constraint conflict
    case 0xC1:  // write constraint conflict
    case 0xC2:  // resource busy
    case 0xC3:  // resource unavailable
      return ParameterReason::kNotNow;
    case 0xB6:  // access denied
      return ParameterReason::kNoRight;
    default:
      return ParameterReason::kOther;
  }
}

Sentence refusalText(const profibus::RecordError& error) noexcept {
  Sentence text;
  text.format("DP-V1 error %02X, %s (%02X %02X %02X)", unsigned{error.code1}, profibus::meaningOf(error),
              unsigned{error.decode}, unsigned{error.code1}, unsigned{error.code2});
  return text;
}

}  // namespace nord_driver
