// The words of the parameter channel's labels and error numbers (BU 2700 6.5.1.1, BU 0020 7.5.1).
#include "profile/pkw.h"

namespace nord_driver::profile {

const char* orderText(std::uint8_t label) noexcept {
  static constexpr const char* kTexts[] = {
      "no order",
      "read",
      "write word",
      "write double word",
      "reserved order 4",
      "reserved order 5",
      "read array",
      "write array word",
      "write array double word",
      "read number of array elements",
      "reserved order 10",
      "write array double word to RAM",
      "write array word to RAM",
      "write double word to RAM",
      "write word to RAM",
  };
  return label < sizeof(kTexts) / sizeof(kTexts[0]) ? kTexts[label] : "unknown order";
}

const char* answerText(std::uint8_t label) noexcept {
  static constexpr const char* kTexts[] = {
      "no answer",
      "word",
      "double word",
      "reserved answer 3",
      "array word",
      "array double word",
      "number of array elements",
      "order cannot be executed",
  };
  return label < sizeof(kTexts) / sizeof(kTexts[0]) ? kTexts[label] : "unknown answer";
}

const char* pkwErrorText(std::uint16_t number) noexcept {
  switch (number) {
    case 0:
      return "the inverter has no parameter of this number";
    case 1:
      return "the parameter cannot be changed (it is read-only, or P509 does not select this bus)";
    case 2:
      return "the value is beyond the lower or upper limit";
    case 3:
      return "the sub-index is wrong";
    case 4:
      return "the parameter is no array";
    case 5:
      return "the data type is wrong";
    case 6:
      return "the parameter can only be reset (only 0 may be written)";
    case 7:
      return "the description element cannot be changed";
    case 9:
      return "there are no description data (acyclic: a READ came without a WRITE before it)";
    case 101:
    case 102:
      return "the addressed inverter does not exist";
    case 103:
      return "the addressed inverter exists, but another bus participant blocks the access";
    case 201:
      return "the order label of the last order is invalid";
    case 202:
      return "the internal answer label cannot be represented (try PPO 2 or acyclic access)";
    default:
      // A number of the bus, not of the inverter: 8000h and Error_Code_1 of DP-V1.
      if (number >= 0x8000) return "the bus module refuses the acyclic access (32768 and the DP-V1 error code)";
      return "an error number the manuals do not list";
  }
}

}  // namespace nord_driver::profile
