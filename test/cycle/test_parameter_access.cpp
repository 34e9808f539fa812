// From the manual's numbers to a request: what cannot be meant is refused before the bus hears of it.
#include <gtest/gtest.h>

#include "cycle/parameter_access.h"

namespace nord_driver::cycle {
namespace {

std::string refusal(std::uint16_t number, std::uint8_t set, std::uint8_t index) {
  Request request;
  const profile::ParameterInfo* info = nullptr;
  return addressParameter({number, set, index}, profile::Series::kSk5xxe, request, info);
}

TEST(ParameterAccess, AnAddressOutsideThePossibleIsRefusedInWords) {
  EXPECT_EQ("", refusal(105, 4, 0));
  EXPECT_EQ("", refusal(700, 0, 3));
  EXPECT_EQ("parameter 1000 does not exist, expected 0 to 999", refusal(1000, 0, 0));
  EXPECT_EQ("parameter set 5 does not exist, expected 0 to 4", refusal(105, 5, 0));
}

// P102 [7] would write P102 itself. [-01] of a parameter that is printed without elements is harmless.
TEST(ParameterAccess, AnIndexOfAParameterWithoutAnArrayIsRefused) {
  EXPECT_EQ("P102 is no array, expected index 0, not 7", refusal(102, 1, 7));
  EXPECT_EQ("P509 is no array, expected index 0, not 2", refusal(509, 0, 2));
  EXPECT_EQ("", refusal(102, 1, 1));
  EXPECT_EQ("", refusal(420, 0, 7)) << "nobody knows whether P420 is one";
}

// A raw value is what the inverter stores: half of one is a mistake, and nobody knows which neighbour was meant.
TEST(ParameterAccess, ARawValueIsAWholeNumber) {
  Request request;
  ASSERT_EQ(nullptr, profile::findParameter(999, profile::Series::kSk5xxe));
  request.parameter.number = 999;
  EXPECT_EQ("", addValue({12.0, false, true}, nullptr, request));
  EXPECT_EQ(12, request.parameter.raw);
  EXPECT_EQ("the value 12.5 cannot be written to P999, expected a whole number of 32 bits",
            addValue({12.5, false, true}, nullptr, request));
  EXPECT_NE("", addValue({4e9, false, true}, nullptr, request));
}

}  // namespace
}  // namespace nord_driver::cycle
