#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::profile {

const char* toString(ParameterReason reason) noexcept {
  switch (reason) {
    case ParameterReason::kNone:
    case ParameterReason::kDriver:
      return "";
    case ParameterReason::kNoSuchParameter:
      return "the inverter has no parameter of this number";
    case ParameterReason::kNoSuchElement:
      return "the parameter has no such array element or parameter set";
    case ParameterReason::kNotIndexed:
      return "the parameter has neither array elements nor parameter sets";
    case ParameterReason::kOutOfLimits:
      return "the value is beyond the lower or upper limit";
    case ParameterReason::kWrongType:
      return "the data type is wrong";
    case ParameterReason::kReadOnly:
      return "the parameter is read-only";
    case ParameterReason::kWriteOnly:
      return "the parameter can only be written";
    case ParameterReason::kNotNow:
      return "the present state of the device does not allow it";
    case ParameterReason::kNoRight:
      return "somebody else has control of the device: does P509 select this bus?";
    case ParameterReason::kNotSupported:
      return "the device does not know this kind of access";
    case ParameterReason::kUnreadable:
      return "the answer cannot be carried this way";
    case ParameterReason::kNoInverter:
      return "the addressed inverter does not exist";
    case ParameterReason::kDeviceFailure:
      return "the device has failed inside";
    case ParameterReason::kOther:
      return "the reason is not known";
  }
  return "";
}

}  // namespace nord_driver::profile
