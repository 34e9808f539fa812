// The words for errors of a bus are compiled into its engine: nothing is read or allocated on the cycle path. The files
// describe the same codes, and mean the same by them.
#include <gtest/gtest.h>

#include "catalogue/shipped.h"
#include "devicenet/error_codes.h"
#include "devicenet/explicit_message.h"
#include "profibus/record.h"
#include "profile/pkw.h"
#include "transport/canopen/emergency.h"
#include "transport/canopen/sdo_refusal.h"

namespace nord_driver::test {
namespace {

using catalogue::FaultCodes;
using catalogue::FaultEntry;

std::vector<const FaultEntry*> entriesOf(FaultCodes codes) {
  std::vector<const FaultEntry*> entries = catalogue::shippedFaults().all(codes);
  EXPECT_FALSE(entries.empty()) << toString(codes);
  return entries;
}

bool isListed(const Sentence& text) {
  return text.str().find("the manuals do not list") == std::string::npos;
}

TEST(ErrorCodesInFiles, OfTheParameterChannel) {
  for (std::uint16_t number = 0; number < 500; ++number) {
    EXPECT_EQ(isListed(profile::pkwErrorText(number)),
              catalogue::shippedFaults().find(FaultCodes::kPkw, number) != nullptr)
        << number;
  }
}

// An abort that stands for a number of the parameter channel is acted on as that is.
TEST(ErrorCodesInFiles, OfSdoAborts) {
  for (const FaultEntry* entry : entriesOf(FaultCodes::kSdoAbort)) {
    EXPECT_TRUE(isListed(abortSentence(entry->number))) << std::hex << entry->number;
    for (const std::uint32_t number : entry->stands_for) {
      EXPECT_EQ(profile::pkwReason(static_cast<std::uint16_t>(number)), reasonOfAbort(entry->number, {}))
          << std::hex << entry->number;
    }
  }
}

TEST(ErrorCodesInFiles, OfDpv1) {
  const auto meaningOf = [](unsigned code) {
    profibus::RecordError error;
    error.decode = 0x80;
    error.code1 = static_cast<std::uint8_t>(code);
    return std::string(profibus::meaningOf(error));
  };
  for (unsigned code = 0xA0; code <= 0xC3; ++code) {
    const FaultEntry* entry = catalogue::shippedFaults().find(FaultCodes::kDpv1, code);
    // What its class alone tells is no description.
    const bool described = meaningOf(code) != meaningOf(code | 0x0Fu);
    EXPECT_EQ(described, entry != nullptr) << std::hex << code << " " << meaningOf(code);
  }
}

TEST(ErrorCodesInFiles, OfDevicenet) {
  for (const FaultEntry* entry : entriesOf(FaultCodes::kDevicenetGeneral)) {
    EXPECT_NE(nullptr, devicenet::generalErrorMeaning(static_cast<std::uint8_t>(entry->number))) << entry->number;
  }
  for (unsigned code = 0; code < 256; ++code) {
    const bool compiled =
        devicenet::additionalErrorMeaning(devicenet::service::kAllocate, static_cast<std::uint8_t>(code)) != nullptr;
    EXPECT_EQ(compiled, catalogue::shippedFaults().find(FaultCodes::kDevicenetAllocate, code) != nullptr) << code;
  }
}

// Codes without numbers of their own come from object 603Fh (BU 0070 6.4.2), which is the file of DRIVECOM.
TEST(ErrorCodesInFiles, OfEmcy) {
  for (const profile::EmergencyInfo& row : profile::emergencyTable()) {
    EXPECT_TRUE(catalogue::shippedFaults().find(FaultCodes::kEmcy, row.code) != nullptr ||
                catalogue::shippedFaults().find(FaultCodes::kDrivecom, row.code) != nullptr)
        << std::hex << row.code;
  }
  for (const FaultEntry* entry : entriesOf(FaultCodes::kEmcy)) {
    EXPECT_NE(nullptr, profile::findEmergency(static_cast<std::uint16_t>(entry->number))) << std::hex << entry->number;
  }
}

}  // namespace
}  // namespace nord_driver::test
