#include "canopen/sdo_abort.h"

#include <array>
#include <cstdio>

namespace nord_driver::canopen {

namespace {

struct Meaning {
  std::uint32_t code;
  const char* text;
};

// CiA 301 table 22. NORD's modules send those of BU 0060 p. 62 and BU 0260 p. 56, all of them in this list.
constexpr std::array<Meaning, 31> kMeanings{{
    {sdo_abort::kToggleBit, "the toggle bit did not alternate"},
    {sdo_abort::kTimedOut, "no answer in time"},
    {sdo_abort::kCommand, "the command is unknown"},
    {sdo_abort::kBlockSize, "the block size is not 1 to 127"},
    {sdo_abort::kSequenceNumber, "the sequence number is wrong"},
    {sdo_abort::kCrc, "the check sum is wrong"},
    {sdo_abort::kMemory, "there is not enough memory"},
    {sdo_abort::kUnsupportedAccess, "the object does not support this access"},
    {sdo_abort::kWriteOnly, "the object is write-only"},
    {sdo_abort::kReadOnly, "the object is read-only"},
    {sdo_abort::kNoObject, "the object does not exist"},
    {0x06040041, "the object cannot be mapped into a PDO"},
    {0x06040042, "the mapped objects are longer than a PDO"},
    {0x06040043, "the parameters do not fit together"},
    {0x06040047, "the device is incompatible in itself"},
    {0x06060000, "the hardware failed"},
    {sdo_abort::kLength, "type or length do not fit the object"},
    {sdo_abort::kTooLong, "the data are too long for the object"},
    {sdo_abort::kTooShort, "the data are too short for the object"},
    {sdo_abort::kNoSubIndex, "the sub-index does not exist"},
    {sdo_abort::kValueRange, "the value is out of range"},
    {0x06090031, "the value is too high"},
    {0x06090032, "the value is too low"},
    {0x06090036, "the maximum is below the minimum"},
    {0x060A0023, "the resource is not available"},
    {sdo_abort::kGeneral, "general error"},
    {0x08000020, "the data cannot be transferred or stored"},
    {0x08000021, "the data cannot be transferred or stored because of local control"},
    {0x08000022, "the data cannot be transferred or stored in the present state of the device"},
    {0x08000023, "there is no object dictionary, or it cannot be made"},
    {0x08000024, "there are no data"},
}};

}  // namespace

const char* abortMeaning(std::uint32_t code) noexcept {
  for (const Meaning& meaning : kMeanings) {
    if (meaning.code == code) return meaning.text;
  }
  return nullptr;
}

std::string abortText(std::uint32_t code) {
  char number[16];
  std::snprintf(number, sizeof number, "%04X %04Xh", code >> 16, code & 0xFFFFu);
  const char* meaning = abortMeaning(code);
  return meaning == nullptr ? std::string{number} : std::string{number} + " (" + meaning + ")";
}

}  // namespace nord_driver::canopen
