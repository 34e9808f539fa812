// A refusal is one sentence: which key, which value, what was expected.
#include <gtest/gtest.h>

#include <limits>

#include "config/setting_checks.h"
#include "support/map_settings.h"

namespace nord_driver {
namespace {

using test::MapSettings;

template <typename Read>
std::string refusal(Read read) {
  try {
    read();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SettingChecks, ANumberIsItsValueOrTheFallback) {
  const MapSettings settings{"~bus/", {{"watchdog", 0.25}, {"rate", 5}}};
  EXPECT_DOUBLE_EQ(0.25, numberOr(settings, "watchdog", 1.0, 0.0, 10.0, "s"));
  EXPECT_DOUBLE_EQ(5.0, numberOr(settings, "rate", 1.0, 0.0, 10.0, "s")) << "a whole number is a number";
  EXPECT_DOUBLE_EQ(1.0, numberOr(settings, "other", 1.0, 0.0, 10.0, "s"));
  EXPECT_DOUBLE_EQ(0.25, requiredNumber(settings, "watchdog", 0.25, 0.25, "s")) << "both ends belong to the range";
}

TEST(SettingChecks, ANumberOutsideItsRangeIsRefusedWithItsUnit) {
  MapSettings settings{"~bus/", {{"watchdog", 0.005}}};
  const auto read = [&] { numberOr(settings, "watchdog", 0.2, 0.01, 650.0, "s"); };
  EXPECT_EQ("~bus/watchdog: 0.005 is not valid, expected a number from 0.01 to 650 s", refusal(read));
  settings.set("watchdog", 651.0);
  EXPECT_EQ("~bus/watchdog: 651 is not valid, expected a number from 0.01 to 650 s", refusal(read));
}

TEST(SettingChecks, NanAndInfinityAreNoNumbers) {
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()}) {
    const MapSettings settings{"~", {{"x", value}}};
    EXPECT_NE("accepted", refusal([&] { numberOr(settings, "x", 0.0, -1e300, 1e300, ""); })) << value;
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_NE("accepted", refusal([&] { requiredNumber(settings, "x", -infinity, infinity, ""); })) << value;
  }
}

TEST(SettingChecks, WholeNumbersHaveBothEndsInTheirRange) {
  MapSettings settings{"~drives/left/", {{"address", 125}}};
  EXPECT_EQ(125, requiredInteger(settings, "address", 0, 125));
  EXPECT_EQ(7, integerOr(settings, "other", 7, 0, 125));
  settings.set("address", 126);
  EXPECT_EQ("~drives/left/address: 126 is not valid, expected a whole number from 0 to 125",
            refusal([&] { requiredInteger(settings, "address", 0, 125); }));
  settings.set("address", -1);
  EXPECT_EQ("~drives/left/address: -1 is not valid, expected a whole number from 0 to 125",
            refusal([&] { integerOr(settings, "address", 3, 0, 125); }));
}

TEST(SettingChecks, WhatIsMissingIsNamedWithWhatIsExpected) {
  const MapSettings settings{"~bus/", {{"empty", std::string{}}}};
  EXPECT_EQ("~bus/a is missing: expected a number from 0 to 1 m",
            refusal([&] { requiredNumber(settings, "a", 0.0, 1.0, "m"); }));
  EXPECT_EQ("~bus/b is missing: expected a whole number from 0 to 1",
            refusal([&] { requiredInteger(settings, "b", 0, 1); }));
  EXPECT_EQ("~bus/c is missing: expected a device", refusal([&] { requiredText(settings, "c", "a device"); }));
  EXPECT_EQ("~bus/empty: \"\" is not valid, expected a device",
            refusal([&] { requiredText(settings, "empty", "a device"); }));
}

// With a slip of the pen in a key that must be there, both are said: what is missing, and what was given.
TEST(SettingChecks, WhatIsMissingIsNamedWithTheKeyThatLooksLikeIt) {
  const MapSettings settings{"~bus/", {{"devcie", std::string{"/dev/ttyUSB0"}}, {"adress", 3}, {"baud_rate", 500000}}};
  EXPECT_EQ("~bus/device is missing: expected a device; did you mean it by ~bus/devcie?",
            refusal([&] { requiredText(settings, "device", "a device"); }));
  EXPECT_EQ("~bus/address is missing: expected a whole number from 0 to 125; did you mean it by ~bus/adress?",
            refusal([&] { requiredInteger(settings, "address", 0, 125); }));
  EXPECT_EQ("~bus/series is missing: expected a series",
            refusal([&] { requiredText(settings, "series", "a series"); }));
}

TEST(SettingChecks, NumbersArePrintedAsPeopleWriteThem) {
  EXPECT_EQ("0.2", shortNumber(0.2));
  EXPECT_EQ("20", shortNumber(20.0));
  EXPECT_EQ("-0.1", shortNumber(-0.1));
}

TEST(SettingChecks, TimesThatAreCountedInMilliseconds) {
  using std::chrono::milliseconds;
  MapSettings settings{"~bus/", {}};
  const auto read = [&] {
    return wholeMillisecondsOr(settings, "pause", milliseconds{20}, milliseconds{10}, milliseconds{500},
                               "0.1 s: it counts them");
  };
  EXPECT_EQ(milliseconds{20}, read());
  settings.set("pause", 0.123);
  EXPECT_EQ(milliseconds{123}, read());
  settings.set("pause", 0.0125);
  EXPECT_EQ("~bus/pause: 0.0125 is not valid, expected whole milliseconds, such as 0.1 s: it counts them",
            refusal(read));
  settings.set("pause", 0.6);
  EXPECT_EQ("~bus/pause: 0.6 is not valid, expected a number from 0.01 to 0.5 s", refusal(read));
}

}  // namespace
}  // namespace nord_driver
