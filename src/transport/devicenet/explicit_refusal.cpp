#include "transport/devicenet/explicit_refusal.h"

#include "devicenet/error_codes.h"
#include "devicenet/explicit_message.h"

namespace nord_driver {

using profile::ParameterReason;

namespace {

// BU 0280 lists none but 02h (4.1.2); the others are those of DeviceNet.
ParameterReason reasonOf(std::uint8_t general) noexcept {
  switch (general) {
    case 0x02:
      return ParameterReason::kNoInverter;
    case 0x03:
    case 0x09:
    case 0x1D:
    case 0x20:
      return ParameterReason::kOutOfLimits;
    case 0x05:
    case 0x14:
      return ParameterReason::kNoSuchParameter;
    case 0x08:
      return ParameterReason::kNotSupported;
    case 0x0B:
    case 0x0C:
    case 0x10:
      return ParameterReason::kNotNow;
    case 0x0E:
      return ParameterReason::kReadOnly;
    case 0x0F:
      return ParameterReason::kNoRight;
    case 0x11:
      return ParameterReason::kUnreadable;
    case 0x13:
    case 0x15:
      return ParameterReason::kWrongType;
    case 0x16:
      return ParameterReason::kNoSuchElement;
    case 0x19:
    case 0x23:
      return ParameterReason::kDeviceFailure;
    default:
      return ParameterReason::kOther;
  }
}

}  // namespace

ParameterReason reasonOfError(std::uint8_t general, const profile::ParameterRequest& request) noexcept {
  const ParameterReason reason = reasonOf(general);
  const bool only_sets = request.shape == profile::ParameterShape::kPerSet;
  return reason == ParameterReason::kNoSuchElement && only_sets ? ParameterReason::kNotIndexed : reason;
}

Sentence errorSentence(std::uint8_t general, std::uint8_t additional) noexcept {
  const char* meaning = devicenet::generalErrorMeaning(general);
  if (general == devicenet::general_error::kResourceUnavailable) {
    meaning = "a resource is unavailable: the inverter behind the module is missing or off";
  }
  if (meaning == nullptr) meaning = "a code that is reserved";
  Sentence text;
  if (additional == devicenet::kNoAdditionalCode) {
    text.format("DeviceNet error %02Xh, %s", unsigned{general}, meaning);
  } else {
    text.format("DeviceNet error %02Xh (additional code %02Xh), %s", unsigned{general}, unsigned{additional}, meaning);
  }
  return text;
}

}  // namespace nord_driver
