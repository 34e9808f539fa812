#include "transport/canopen/sdo_refusal.h"

#include "canopen/sdo_abort.h"

namespace nord_driver {

using profile::ParameterReason;

namespace {

struct AbortRow {
  std::uint32_t code;
  ParameterReason reason;
  const char* meaning;
};

// BU 0060 p. 62 (technology units, SK 5xxE) and BU 0260 p. 56 (SK CU4/TU4-CAO).
constexpr AbortRow kAborts[] = {
    {0x05030000, ParameterReason::kOther, "the SDO transfer lost its step (toggle bit)"},
    {0x05040000, ParameterReason::kOther, "the device gave the SDO transfer up: it waited too long"},
    {0x05040001, ParameterReason::kOther, "the device does not know the SDO command"},
    {0x05040005, ParameterReason::kDeviceFailure, "the device is out of memory"},
    {0x06010000, ParameterReason::kNotSupported, "the object does not allow this access"},
    {0x06010001, ParameterReason::kWriteOnly, "the object can only be written"},
    {0x06010002, ParameterReason::kReadOnly,
     "the parameter cannot be changed (it is read-only, or P509 does not select this bus)"},
    {0x06020000, ParameterReason::kNoSuchParameter, "the inverter has no parameter of this number"},
    {0x06040041, ParameterReason::kOther, "the object cannot be mapped into a PDO"},
    {0x06040042, ParameterReason::kOther, "the mapped objects are longer than a PDO"},
    {0x06040043, ParameterReason::kNotNow, "the value does not fit other settings of the device"},
    {0x06040047, ParameterReason::kDeviceFailure, "the device has an internal incompatibility"},
    {0x06060000, ParameterReason::kDeviceFailure, "a hardware fault of the device prevents it"},
    {0x06070010, ParameterReason::kWrongType, "the data type is wrong"},
    {0x06070012, ParameterReason::kWrongType, "the data type is wrong: the value is too long"},
    {0x06070013, ParameterReason::kWrongType, "the data type is wrong: the value is too short"},
    {0x06090011, ParameterReason::kNoSuchElement, "the sub-index is wrong"},
    {0x06090030, ParameterReason::kOutOfLimits, "the value is beyond the lower or upper limit"},
    {0x06090031, ParameterReason::kOutOfLimits, "the value is above the upper limit"},
    {0x06090032, ParameterReason::kOutOfLimits, "the value is below the lower limit"},
    {0x06090036, ParameterReason::kOutOfLimits, "the upper limit of the value is below its lower one"},
    {0x08000020, ParameterReason::kNotNow, "the device cannot take or give the value"},
    {0x08000021, ParameterReason::kNoRight, "the inverter is under local control: does P509 select CANopen?"},
    {0x08000022, ParameterReason::kNotNow, "the device's present state does not allow it"},
};

const AbortRow* find(std::uint32_t code) noexcept {
  for (const AbortRow& row : kAborts) {
    if (row.code == code) return &row;
  }
  return nullptr;
}

// What no manual of NORD lists CiA 301 may know.
const char* meaningOf(std::uint32_t code) noexcept {
  if (const AbortRow* row = find(code)) return row->meaning;
  const char* standard = canopen::abortMeaning(code);
  return standard != nullptr ? standard : "an abort code the manuals do not list";
}

}  // namespace

ParameterReason reasonOfAbort(std::uint32_t abort_code, const profile::ParameterRequest& request) noexcept {
  const AbortRow* row = find(abort_code);
  if (row == nullptr) return ParameterReason::kOther;
  const bool only_sets = request.shape == profile::ParameterShape::kPerSet;
  return row->reason == ParameterReason::kNoSuchElement && only_sets ? ParameterReason::kNotIndexed : row->reason;
}

Sentence abortSentence(std::uint32_t abort_code) noexcept {
  Sentence text;
  text.format("SDO abort %04X %04Xh, %s", abort_code >> 16, abort_code & 0xFFFFu, meaningOf(abort_code));
  return text;
}

}  // namespace nord_driver
