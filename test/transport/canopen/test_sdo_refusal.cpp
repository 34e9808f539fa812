// What an SDO abort code means to the driver, and to people.
#include <gtest/gtest.h>

#include "transport/canopen/sdo_refusal.h"

namespace nord_driver {
namespace {

using profile::ParameterReason;
using profile::ParameterShape;

ParameterReason reasonFor(std::uint32_t abort_code, ParameterShape shape = ParameterShape::kPlain) {
  profile::ParameterRequest request;
  request.number = 102;
  request.shape = shape;
  return reasonOfAbort(abort_code, request);
}

// BU 0060 p. 62.
TEST(SdoRefusal, TheReasonIsTheOneOfTheCode) {
  EXPECT_EQ(ParameterReason::kNoSuchParameter, reasonFor(0x06020000)) << "no such object";
  EXPECT_EQ(ParameterReason::kReadOnly, reasonFor(0x06010002));
  EXPECT_EQ(ParameterReason::kWriteOnly, reasonFor(0x06010001));
  EXPECT_EQ(ParameterReason::kOutOfLimits, reasonFor(0x06090030)) << "range";
  EXPECT_EQ(ParameterReason::kOutOfLimits, reasonFor(0x06090031)) << "too high";
  EXPECT_EQ(ParameterReason::kOutOfLimits, reasonFor(0x06090032)) << "too low";
  EXPECT_EQ(ParameterReason::kNoSuchElement, reasonFor(0x06090011, ParameterShape::kArray)) << "sub-index";
  EXPECT_EQ(ParameterReason::kWrongType, reasonFor(0x06070010)) << "length";
  EXPECT_EQ(ParameterReason::kNoRight, reasonFor(0x08000021)) << "local control";
  EXPECT_EQ(ParameterReason::kOther, reasonFor(0x12345678));
}

// A parameter without sets answers a sub-index 1 with 0609 0011h; the parameter session then tries it without.
TEST(SdoRefusal, AMissingSetIsAParameterWithoutSets) {
  EXPECT_EQ(ParameterReason::kNotIndexed, reasonFor(0x06090011, ParameterShape::kPerSet));
}

TEST(SdoRefusal, TheSentenceBeginsWithTheCode) {
  EXPECT_EQ("SDO abort 0609 0031h, the value is above the upper limit", abortSentence(0x06090031).str());
  EXPECT_EQ("SDO abort 0800 0021h, the inverter is under local control: does P509 select CANopen?",
            abortSentence(0x08000021).str());
  EXPECT_EQ("SDO abort 0800 0024h, there are no data", abortSentence(0x08000024).str()) << "of CiA 301 alone";
  EXPECT_EQ("SDO abort 1234 5678h, an abort code the manuals do not list", abortSentence(0x12345678).str());
}

}  // namespace
}  // namespace nord_driver
