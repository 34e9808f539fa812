// A drive that is told the elements of its array: what is high when, and what an axis that goes elsewhere is stopped by.
#include <gtest/gtest.h>

#include "drive/drive.h"
#include "drive/path_guard.h"

namespace nord_driver::drive {
namespace {

constexpr Duration kCycle = seconds(0.01);

TEST(PathGuardTest, KnowsTheWay) {
  PathGuard path;
  EXPECT_FALSE(path.isLeft(1e9, 0.1)) << "nobody has sent it anywhere";
  path.hold(2.0);
  EXPECT_FALSE(path.isLeft(2.09, 0.1));
  EXPECT_TRUE(path.isLeft(2.11, 0.1));
  EXPECT_TRUE(path.isLeft(1.89, 0.1));
  path.goTo(2.0, -1.0, 0.0);
  EXPECT_FALSE(path.isLeft(-1.09, 0.1));
  EXPECT_TRUE(path.isLeft(-1.11, 0.1));
  EXPECT_TRUE(path.isLeft(2.11, 0.1)) << "the wrong way";
  path.goTo(2.0, -1.0, -0.5);
  EXPECT_FALSE(path.isLeft(2.55, 0.1)) << "it has to turn round first";
  EXPECT_TRUE(path.isLeft(2.61, 0.1));
  path.forget();
  EXPECT_FALSE(path.isLeft(2.61, 0.1));
}

/// SK 53xE: frequency, bus I/O in bits; the position in words 2 and 3. 1 rad is a revolution of the count.
class ElementTarget : public ::testing::Test {
 protected:
  static DriveConfig config() {
    DriveConfig result;
    result.joint.gear_ratio = 1.0;
    result.max_frequency[0] = Hertz{50.0};
    PositionConfig position;
    position.lower = -10.0;
    position.upper = 20.0;
    position.tolerance = 0.005;
    position.by_element = true;
    position.stray = 0.25;
    result.position = position;
    return result;
  }
  ElementTarget() {
    drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 17, 0}, {1, 10, 15}, 3));
  }
  Word cycle(Word status_word, std::int32_t steps) {
    const profile::ProcessOutput output = drive_.pollOutput(now_);
    EXPECT_EQ(0, output.setpoints[1]);
    EXPECT_EQ(0, output.setpoints[2]);
    sent_element_ = report().position.element;
    now_ += kCycle;
    profile::ProcessInput input;
    input.status_word = status_word;
    input.actual_values = {0, toSigned(static_cast<Word>(steps & 0xFFFF)),
                           toSigned(static_cast<Word>(static_cast<std::uint32_t>(steps) >> 16))};
    drive_.handleInput(input, true, now_);
    return output.control_word;
  }
  void enable(std::int32_t steps) {
    for (int i = 0; i < 6; ++i) cycle(0x0B31, steps);
    drive_.requestEnable(now_);
    cycle(0x0B31, steps);
    cycle(0x0B37, steps);
    ASSERT_EQ(Phase::kEnabled, report().phase);
  }
  const DriveReport& report() const { return drive_.report(); }

  Drive drive_{config()};
  std::uint8_t sent_element_ = 0;
  Instant now_{std::chrono::hours{1}};
};

TEST_F(ElementTarget, IsHighOnlyWhileItIsEnabled) {
  EXPECT_EQ(TargetRefusal::kNotEnabled, drive_.setElement(3, 5.0));
  enable(1'000);
  EXPECT_EQ(0, sent_element_);
  ASSERT_EQ(TargetRefusal::kNone, drive_.setElement(3, 5.0));
  cycle(0x0A37, 1'050);
  EXPECT_EQ(3, sent_element_);
  EXPECT_EQ(5.0, report().position.target);
  for (std::int32_t at = 1'100; at < 5'000; at += 200) cycle(0x0A37, at);
  cycle(0x0B37, 4'998);
  EXPECT_TRUE(report().position.reached);
  EXPECT_EQ(3, sent_element_) << "it is held there by its bits";
  for (const bool quick : {false, true}) {
    quick ? drive_.requestQuickStop(now_) : drive_.requestShutdown(now_);
    cycle(0x0A37, 5'000);
    EXPECT_EQ(0, sent_element_);
    cycle(quick ? 0x0B50 : 0x0B31, 5'000);
    cycle(0x0B31, 5'000);
    enable(5'000);
    cycle(0x0B37, 5'000);
    EXPECT_EQ(0, sent_element_) << "forgotten";
    ASSERT_EQ(TargetRefusal::kNone, drive_.setElement(3, 5.0));
    cycle(0x0B37, 5'000);
    EXPECT_EQ(3, sent_element_);
  }
}

TEST_F(ElementTarget, IsRefusedBeyondTheLimits) {
  enable(0);
  EXPECT_EQ(TargetRefusal::kAboveLimit, drive_.setElement(3, 20.001));
  EXPECT_EQ(TargetRefusal::kBelowLimit, drive_.setElement(3, -10.001));
  EXPECT_EQ(TargetRefusal::kElementsOnly, drive_.setPosition(1.0));
  EXPECT_EQ(TargetRefusal::kElementsOnly, drive_.movePosition(1.0));
  cycle(0x0B37, 0);
  EXPECT_EQ(0, sent_element_);
}

TEST_F(ElementTarget, WithoutOneItHasToStay) {
  enable(1'000);
  cycle(0x0A37, 1'200);
  EXPECT_EQ(Phase::kEnabled, report().phase) << "a load that settles";
  cycle(0x0A37, 1'260);
  EXPECT_EQ(StopCause::kStrayed, report().stop_cause);
  EXPECT_EQ(0x047E, cycle(0x0A37, 1'300));
}

TEST_F(ElementTarget, ItStaysBetweenWhereItWasAndTheElement) {
  const auto expectStopped = [&](std::int32_t steps, const char* why) {
    cycle(0x0A37, steps);
    EXPECT_EQ(StopCause::kStrayed, report().stop_cause) << why;
    EXPECT_EQ(0x047E, cycle(0x0A37, steps));
    EXPECT_EQ(0, sent_element_) << why;
    cycle(0x0B31, steps);
  };
  enable(1'000);
  ASSERT_EQ(TargetRefusal::kNone, drive_.setElement(3, 2.0));
  expectStopped(740, "the wrong way");
  enable(1'000);
  ASSERT_EQ(TargetRefusal::kNone, drive_.setElement(3, 1.2));
  for (std::int32_t at = 1'000; at <= 1'440; at += 20) cycle(0x0A37, at);
  EXPECT_EQ(StopCause::kNone, report().stop_cause);
  expectStopped(1'460, "beyond it");
  enable(1'000);
  ASSERT_EQ(TargetRefusal::kNone, drive_.setElement(3, 1.2));
  for (std::int32_t at = 1'000; at <= 1'200; at += 20) cycle(0x0A37, at);
  cycle(0x0B37, 1'200);
  ASSERT_TRUE(report().position.reached);
  expectStopped(940, "where it has arrived it stays");
}

}  // namespace
}  // namespace nord_driver::drive
