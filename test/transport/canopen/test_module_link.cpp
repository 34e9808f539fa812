#include <gtest/gtest.h>

#include "transport/canopen/module_link.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Instant kTold{seconds{100}};
constexpr Word kReady = 0x0B31, kRunning = 0x0B37;

class ModuleLinkTest : public ::testing::Test {
 protected:
  ModuleLinkTest() { link_.handleEmergency(0x5000, kTold); }

  /// A cycle of 10 ms with a PDO that has just come.
  void cycle(Word status, std::uint8_t actual_value = 0) {
    now_ += milliseconds{10};
    words(status, actual_value, now_);
  }
  void words(Word status, std::uint8_t actual_value, Instant at) {
    const FixedBytes<4> values{static_cast<std::uint8_t>(status & 0xFFu), static_cast<std::uint8_t>(status >> 8),
                               actual_value, 0};
    link_.handleBootUp(std::nullopt);
    link_.handleWords(status, values, at, now_);
  }
  void run(Duration span, Word status, std::uint8_t actual_value = 0) {
    for (const Instant end = now_ + span; now_ < end;) cycle(status, actual_value);
  }

  ModuleLink link_;
  Instant now_ = kTold;
};

TEST_F(ModuleLinkTest, AnEmergencyIsTakenBackByTheNext) {
  EXPECT_TRUE(link_.missing());
  link_.handleEmergency(0x0000, now_ + seconds{9});
  EXPECT_FALSE(link_.missing());
  link_.handleEmergency(0x2310, now_ + seconds{10});
  EXPECT_FALSE(link_.missing()) << "another fault";
}

TEST_F(ModuleLinkTest, GoodWordsForLongerThanAnEmergencyCanBeLateCount) {
  run(milliseconds{990}, kReady);
  EXPECT_TRUE(link_.missing());
  run(milliseconds{30}, kReady);
  EXPECT_FALSE(link_.missing());
}

// The inverter is off again and again: the second begins anew.
TEST_F(ModuleLinkTest, ZerosBetweenThemDoNotCount) {
  for (int i = 0; i < 5; ++i) {
    run(milliseconds{900}, kReady);
    cycle(0);
    ASSERT_TRUE(link_.missing());
  }
}

// An inverter that is being stopped and says for ever that it runs as it ran is not heard any more.
TEST_F(ModuleLinkTest, WordsThatNeverChangeWhileItShouldStopAreOldOnes) {
  run(seconds{30}, kRunning, 0x20);
  EXPECT_TRUE(link_.missing());
  cycle(kRunning, 0x1F);
  run(seconds{1}, kRunning, 0x1E);
  EXPECT_FALSE(link_.missing()) << "it gets slower";
}

// With event_time 0 the last PDO may be from long before.
TEST_F(ModuleLinkTest, WordsFromBeforeAreNone) {
  for (int i = 0; i < 300; ++i) {
    now_ += milliseconds{10};
    words(kReady, 0, kTold - milliseconds{1});
  }
  EXPECT_TRUE(link_.missing());
}

TEST_F(ModuleLinkTest, ABootUpAfterItCounts) {
  link_.handleBootUp(kTold - milliseconds{1});
  EXPECT_TRUE(link_.missing()) << "the one before";
  link_.handleBootUp(kTold);
  EXPECT_TRUE(link_.missing()) << "said in the start itself";
  link_.handleBootUp(kTold + milliseconds{1});
  EXPECT_FALSE(link_.missing());
}

TEST_F(ModuleLinkTest, EachEmergencyBeginsAnew) {
  run(milliseconds{900}, kReady);
  link_.handleEmergency(0x5000, now_);
  run(milliseconds{900}, kReady);
  EXPECT_TRUE(link_.missing());
}

}  // namespace
}  // namespace nord_driver
