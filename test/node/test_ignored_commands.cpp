#include <gtest/gtest.h>

#include <limits>

#include "node/ignored_commands.h"

namespace nord_driver::node {
namespace {

using std::chrono::milliseconds;

TEST(IgnoredCommandsTest, CountsEachAndTellsOfThemOnceASecond) {
  IgnoredCommands ignored{2};
  const Instant begin{};  // also where the clock has just begun
  EXPECT_EQ(1u, ignored.addToBase(begin));
  EXPECT_EQ(std::nullopt, ignored.addToBase(begin + milliseconds{20}));
  EXPECT_EQ(std::nullopt, ignored.addToBase(begin + milliseconds{999}));
  EXPECT_EQ(4u, ignored.addToBase(begin + milliseconds{1000}));
  EXPECT_EQ(4u, ignored.ofBase());
}

TEST(IgnoredCommandsTest, ADriveIsToldOfWhateverIsSaidOfTheOthers) {
  IgnoredCommands ignored{2};
  const Instant now{};
  EXPECT_EQ(1u, ignored.addToBase(now));
  EXPECT_EQ(1u, ignored.add(1, now));
  EXPECT_EQ(std::nullopt, ignored.add(1, now));
  EXPECT_EQ(1u, ignored.add(0, now));
  EXPECT_EQ(1u, ignored.ofBase());
  EXPECT_EQ(1u, ignored.of(0));
  EXPECT_EQ(2u, ignored.of(1));
}

// An increment may be a number and still be no command.
TEST(IgnoredCommandsTest, WhatIsANumberIsNotToldToBeNone) {
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ("is not a number, or infinite", whyIgnored(value));
  }
  EXPECT_EQ("is 2e+06, expected -1e+06 to 1e+06 rad or m", whyIgnored(2e6));
  EXPECT_EQ("is -5e+07, expected -1e+06 to 1e+06 rad or m", whyIgnored(-5e7));
}

}  // namespace
}  // namespace nord_driver::node
