// The writes of a day: counted before they are done, kept across runs, refused when they are used up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "state/eeprom_budget.h"
#include "support/temporary_folder.h"

namespace nord_driver::state {
namespace {

using std::chrono::hours;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const WallTime kNoon = WallTime{} + hours{24} * 20'780 + hours{12};  // 2026-11-23

class Budget : public ::testing::Test {
 protected:
  /// As a program that is started now would have it.
  EepromBudget budget(std::uint64_t per_day = 3) const { return {folder_.path("counts.yaml"), per_day}; }
  std::string refusal(WallTime now, std::uint32_t writes = 1) const {
    try {
      budget().reserve("left", writes, now);
    } catch (const BudgetUsedUp& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
};

TEST_F(Budget, SurvivesARestart) {
  budget().reserve("left", 1, kNoon);
  budget().reserve("left", 1, kNoon);
  budget().reserve("right", 1, kNoon);
  EXPECT_EQ(2u, budget().countOf("left").writes);
  EXPECT_EQ(2u, budget().countOf("left").total);
  EXPECT_EQ(1u, budget().countOf("right").writes);
  EXPECT_EQ(0u, budget().countOf("nobody").writes);
}

TEST_F(Budget, IsUsedUpWithASentenceOnHowToGoOn) {
  for (int i = 0; i < 3; ++i) EXPECT_EQ("", refusal(kNoon));
  EXPECT_EQ("its EEPROM has had 3 writes on 2026-11-23 (UTC), and eeprom_budget allows 3 a day (counted in " +
                folder_.path("counts.yaml") + "): raise eeprom_budget, or wait until 2026-11-24 00:00 UTC",
            refusal(kNoon));
  EXPECT_EQ(3u, budget().countOf("left").writes) << "what is refused does not count";
  EXPECT_NO_THROW(budget(4).reserve("left", 1, kNoon)) << "raised";
  EXPECT_NO_THROW(budget().reserve("right", 1, kNoon)) << "each drive has its own";
}

TEST_F(Budget, HasToHoldAllWritesOfAnAccess) {
  EXPECT_EQ("", refusal(kNoon));
  EXPECT_NE("", refusal(kNoon, 3));
  EXPECT_EQ("", refusal(kNoon, 2));
}

TEST_F(Budget, OfNoneGrantsNothing) {
  EXPECT_THROW(budget(0).reserve("left", 1, kNoon), BudgetUsedUp);
}

TEST_F(Budget, BeginsAnewAtMidnightAndKeepsTheTotal) {
  for (int i = 0; i < 3; ++i) budget().reserve("left", 1, kNoon);
  EXPECT_NE("", refusal(kNoon + hours{12} - std::chrono::seconds{1}));
  EXPECT_EQ("", refusal(kNoon + hours{12}));
  EXPECT_EQ(1u, budget().countOf("left").writes);
  EXPECT_EQ(4u, budget().countOf("left").total);
}

// A robot without a clock of its own starts in 1970 each time.
TEST_F(Budget, GainsNothingByAClockThatWasSetBack) {
  for (int i = 0; i < 3; ++i) budget().reserve("left", 1, kNoon);
  EXPECT_NE("", refusal(WallTime{}));
  EXPECT_NE("", refusal(kNoon));
}

TEST_F(Budget, TakesBackWhatWasNotDone) {
  const Reservation reservation = budget().reserve("left", 2, kNoon);
  budget().giveBack("left", reservation);
  EXPECT_EQ(0u, budget().countOf("left").writes);
  EXPECT_EQ(0u, budget().countOf("left").total);
  const Reservation yesterday = budget().reserve("left", 1, kNoon);
  budget().reserve("left", 1, kNoon + hours{24});
  budget().giveBack("left", yesterday);
  EXPECT_EQ(1u, budget().countOf("left").writes) << "today's stays";
  EXPECT_EQ(1u, budget().countOf("left").total);
}

TEST_F(Budget, CountsWhatWasDoneUnaskedPastItself) {
  budget().add("left", 5, kNoon);
  EXPECT_EQ(5u, budget().countOf("left").writes);
  EXPECT_NE("", refusal(kNoon));
}

// Counting from zero would forget what the EEPROM has had.
TEST_F(Budget, OfABrokenFileGrantsNothingAndLeavesTheFile) {
  folder_.write("counts.yaml", "schema: 1\ndri");
  try {
    budget().reserve("left", 1, kNoon);
    FAIL() << "granted";
  } catch (const StateError& error) {
    EXPECT_THAT(error.what(), AllOf(StartsWith(folder_.path("counts.yaml")), HasSubstr("expected drives:")));
  }
  EXPECT_EQ("schema: 1\ndri", folder_.read("counts.yaml"));
}

}  // namespace
}  // namespace nord_driver::state
