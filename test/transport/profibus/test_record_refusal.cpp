// What an error code of DP-V1 means to the driver, and to people.
#include <gtest/gtest.h>

#include "transport/profibus/record_refusal.h"

namespace nord_driver {
namespace {

using profibus::RecordError;
using profile::ParameterReason;

TEST(RecordRefusal, TheReasonIsTheOneOfTheCode) {
  EXPECT_EQ(ParameterReason::kDeviceFailure, reasonOf(RecordError{0x80, 0xA2, 0}));
  EXPECT_EQ(ParameterReason::kNoRight, reasonOf(RecordError{0x80, 0xB6, 0}));
  EXPECT_EQ(ParameterReason::kNotNow, reasonOf(RecordError{0x80, 0xC2, 0}));
  EXPECT_EQ(ParameterReason::kOther, reasonOf(RecordError{0x00, 0xB6, 0})) << "another protocol's code";
}

// The record was refused, not the order in it. Else the session would take P560 for missing, and orders that spare the
// EEPROM for unknown.
TEST(RecordRefusal, NoCodeSpeaksOfTheParameter) {
  for (unsigned code = 0; code <= 0xFF; ++code) {
    const ParameterReason reason = reasonOf(RecordError{0x80, static_cast<std::uint8_t>(code), 0});
    EXPECT_NE(ParameterReason::kNoSuchParameter, reason) << code;
    EXPECT_NE(ParameterReason::kNotSupported, reason) << code;
    EXPECT_NE(ParameterReason::kNotIndexed, reason) << code;
    EXPECT_NE(ParameterReason::kNoInverter, reason) << code;
  }
}

TEST(RecordRefusal, TheSentenceBeginsWithTheCode) {
  EXPECT_EQ("DP-V1 error B0, invalid index (80 B0 00)", refusalText(RecordError{0x80, 0xB0, 0}).str());
  EXPECT_EQ("DP-V1 error B0, an error of another protocol than DP-V1 (00 B0 07)",
            refusalText(RecordError{0x00, 0xB0, 7}).str());
}

}  // namespace
}  // namespace nord_driver
