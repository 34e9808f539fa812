#include "profile/parameter_error.h"

#include "profile/pkw.h"

namespace nord_driver::profile {

namespace {

constexpr std::uint16_t kNotChangeable = 1, kLimits = 2, kWrongType = 5;
constexpr std::uint16_t kFirstOfCanopen = 1000;

struct AbortRow {
  std::uint32_t code;
  std::uint16_t number;
  const char* text;  // of the numbers from 1000 on
};

// BU 0060 p. 62 (technology units, SK 5xxE) and BU 0260 p. 56 (SK CU4/TU4-CAO).
constexpr AbortRow kAborts[] = {
    {0x05030000, 1001, "the SDO transfer lost its step (toggle bit)"},
    {0x05040000, 1002, "the device gave the SDO transfer up: it waited too long"},
    {0x05040001, 1003, "the device does not know the SDO command"},
    {0x05040005, 1004, "the device is out of memory"},
    {0x06010000, 1005, "the object does not allow this access"},
    {0x06010001, 1006, "the object can only be written"},
    {0x06010002, kNotChangeable, nullptr},
    {0x06020000, pkw_error::kInvalidNumber, nullptr},
    {0x06040041, 1007, "the object cannot be mapped into a PDO"},
    {0x06040042, 1008, "the mapped objects are longer than a PDO"},
    {0x06040043, 1009, "the value does not fit other settings of the device"},
    {0x06040047, 1010, "the device has an internal incompatibility"},
    {0x06060000, 1011, "a hardware fault of the device prevents it"},
    {0x06070010, kWrongType, nullptr},
    {0x06070012, kWrongType, nullptr},
    {0x06070013, kWrongType, nullptr},
    {0x06090011, pkw_error::kWrongSubIndex, nullptr},
    {0x06090030, kLimits, nullptr},
    {0x06090031, kLimits, nullptr},
    {0x06090032, kLimits, nullptr},
    {0x06090036, kLimits, nullptr},
    {0x08000020, 1012, "the device cannot take or give the value"},
    {0x08000021, 1013, "the inverter is under local control: does P509 select CANopen?"},
    {0x08000022, 1014, "the device's present state does not allow it"},
};
constexpr std::uint16_t kOtherAbort = 1099;

}  // namespace

const char* parameterErrorText(std::uint16_t number) noexcept {
  if (number < kFirstOfCanopen) return pkwErrorText(number);
  for (const AbortRow& row : kAborts) {
    if (row.number == number) return row.text;
  }
  return "an SDO abort code the manuals do not list";
}

std::uint16_t errorNumberOfAbort(std::uint32_t abort_code, const ParameterRequest& request) noexcept {
  for (const AbortRow& row : kAborts) {
    if (row.code != abort_code) continue;
    const bool only_sets = request.shape == ParameterShape::kPerSet;
    return row.number == pkw_error::kWrongSubIndex && only_sets ? pkw_error::kNoArray : row.number;
  }
  return kOtherAbort;
}

}  // namespace nord_driver::profile
