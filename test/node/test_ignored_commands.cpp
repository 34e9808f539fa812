#include <gtest/gtest.h>

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

}  // namespace
}  // namespace nord_driver::node
