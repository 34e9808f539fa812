#include <gtest/gtest.h>

#include "profile/parameter_error.h"
#include "profile/pkw.h"

namespace nord_driver::profile {
namespace {

ParameterRequest requestOf(ParameterShape shape) {
  ParameterRequest request;
  request.number = 102;
  request.shape = shape;
  return request;
}

std::uint16_t numberOf(std::uint32_t abort_code, ParameterShape shape = ParameterShape::kPlain) {
  return errorNumberOfAbort(abort_code, requestOf(shape));
}

// The same firmware answers on every bus: what PKW has a number for is that number (BU 0060 p. 62, BU 2700 6.5.1.1).
TEST(ParameterError, AbortCodesArePkwNumbersWhereTheyMeanTheSame) {
  EXPECT_EQ(0, numberOf(0x06020000)) << "no such object";
  EXPECT_EQ(1, numberOf(0x06010002)) << "read only";
  EXPECT_EQ(2, numberOf(0x06090030)) << "range";
  EXPECT_EQ(2, numberOf(0x06090031)) << "too high";
  EXPECT_EQ(2, numberOf(0x06090032)) << "too low";
  EXPECT_EQ(3, numberOf(0x06090011, ParameterShape::kArray)) << "sub-index";
  EXPECT_EQ(5, numberOf(0x06070010)) << "length";
}

// A parameter without sets answers a sub-index 1 with 0609 0011h; the parameter session then tries it without.
TEST(ParameterError, AMissingSetIsNoArray) {
  EXPECT_EQ(4, numberOf(0x06090011, ParameterShape::kPerSet));
}

// Never 201: that would make the parameter session believe that orders are missing which spare the EEPROM.
TEST(ParameterError, NoAbortPassesForAnInvalidOrder) {
  for (const std::uint32_t code : {0x05040001u, 0x06010000u, 0x06010001u, 0x08000021u, 0x12345678u}) {
    EXPECT_NE(pkw_error::kInvalidOrder, numberOf(code));
    EXPECT_LE(1000, numberOf(code));
  }
}

TEST(ParameterError, EveryNumberHasItsWords) {
  EXPECT_STREQ(pkwErrorText(2), parameterErrorText(2));
  EXPECT_STREQ("the inverter is under local control: does P509 select CANopen?",
               parameterErrorText(numberOf(0x08000021)));
  EXPECT_STREQ("the object can only be written", parameterErrorText(numberOf(0x06010001)));
  EXPECT_STREQ("an SDO abort code the manuals do not list", parameterErrorText(numberOf(0x12345678)));
}

}  // namespace
}  // namespace nord_driver::profile
