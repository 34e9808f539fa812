// The fence around what users may write: read from the configuration, and what it says of a number outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "config/writable_parameters.h"
#include "config/yaml_settings.h"

namespace nord_driver {
namespace {

using ::testing::HasSubstr;

WritableParameters readFrom(const char* text) {
  return readWritableParameters(YamlSettings{"~", YAML::Load(text)});
}

std::string refusalOf(const char* text) {
  try {
    readFrom(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(WritableParameters, AreAllWhereNothingIsSaid) {
  EXPECT_TRUE(readFrom("{}").allows(105));
  EXPECT_EQ("", readFrom("{}").refusal(105));
}

TEST(WritableParameters, AreThoseOfTheListAndNoOther) {
  const WritableParameters writable = readFrom("{writable_parameters: [102, P103, p104]}");
  for (const std::uint16_t number : std::array<std::uint16_t, 3>{102, 103, 104})
    EXPECT_EQ("", writable.refusal(number)) << number;
  EXPECT_FALSE(writable.allows(105));
  EXPECT_EQ("P105 may not be written: writable_parameters allows P102, P103, P104", writable.refusal(105));
}

TEST(WritableParameters, AnEmptyListAllowsNone) {
  EXPECT_EQ("P102 may not be written: writable_parameters allows none",
            readFrom("{writable_parameters: []}").refusal(102));
}

TEST(WritableParameters, WhatIsNoNumberOfAParameterIsNamed) {
  EXPECT_EQ("~writable_parameters: \"P10x\" is not valid, expected numbers of parameters, 102 or P102, up to P999",
            refusalOf("{writable_parameters: [P10x]}"));
  for (const char* wrong : {"0", "1000", "-5", "P", "''", "65638"}) {
    EXPECT_THAT(refusalOf((std::string("{writable_parameters: [") + wrong + "]}").c_str()),
                HasSubstr("expected numbers of parameters"))
        << wrong;
  }
  EXPECT_EQ("", readFrom("{writable_parameters: 102}").refusal(102)) << "one alone";
  EXPECT_THAT(refusalOf("{writable_parameters: [1.5]}"), HasSubstr("~writable_parameters: 1.5"));
}

}  // namespace
}  // namespace nord_driver
