// The position control of the simulated inverter: it arrives, holds, stops and starts like the velocity mode.

#include <gtest/gtest.h>

#include <cmath>

#include "sim/inverter/position_fixture.h"

namespace nord_driver::sim {
namespace {

using Words = std::array<Word, 3>;

constexpr double kArrived = 0.001;  // revolutions

/// Setpoints low and high in SW1 and SW2, the actual position in IW1 and IW2.
struct LowHigh : ::testing::Test {
  LowHigh() { axis.words({21, 22, 0}, {10, 15, 1}); }

  static Words target(std::int32_t thousandths) {
    const auto bits = static_cast<std::uint32_t>(thousandths);
    return {static_cast<Word>(bits & 0xFFFF), static_cast<Word>(bits >> 16), 0};
  }
  std::int32_t shown() const {
    const Words words = axis.actual();
    return static_cast<std::int32_t>(std::uint32_t{words[1]} << 16 | words[0]);
  }
  void enable(const Words& setpoints) {
    axis.send(0x047E, setpoints);
    axis.hold(0x047F, setpoints, 0.02);
  }

  Axis axis;
};

TEST_F(LowHigh, ArrivesWithinAThousandthAndSaysSo) {
  for (const std::int32_t wanted : {1, -1, 20'000, -33'000, 32'767, 32'768, -32'769, 0}) {
    SCOPED_TRACE(wanted);
    enable(target(wanted));
    axis.hold(0x047F, target(wanted), 6.0);
    EXPECT_NEAR(wanted * 0.001, axis.position(), kArrived);
    EXPECT_EQ(wanted, shown());
    EXPECT_TRUE(axis.reached());
    axis.hold(0x047F, target(wanted), 1.0);
    EXPECT_EQ(0.0, axis.motor.speed()) << "it does not hunt";
  }
}

// "The full position range of +/- 50000.000 revolutions": BU 0020 7.3.5.
TEST(PositionRange, ItsEndsAreReached) {
  for (const std::int32_t wanted : {50'000'000, -50'000'000}) {
    PosiconSettings settings;
    settings.position = wanted * 0.001 * 0.9999;
    Axis axis(Series::kSk5xxe, settings);
    axis.words({21, 22, 0}, {10, 15, 0});
    const auto words = LowHigh::target(wanted);
    axis.send(0x047E, words);
    axis.hold(0x047F, words, 4.0);
    EXPECT_NEAR(wanted * 0.001, axis.position(), kArrived);
    EXPECT_EQ(words[0], axis.actual()[0]);
    EXPECT_EQ(words[1], axis.actual()[1]);
    EXPECT_TRUE(axis.reached());
  }
}

TEST_F(LowHigh, AJamKeepsItFromArriving) {
  enable(target(10'000));
  axis.hold(0x047F, target(10'000), 0.4);
  axis.motor.setBlocked(true);
  axis.hold(0x047F, target(10'000), 2.0);
  EXPECT_FALSE(axis.reached());
  EXPECT_EQ(0.0, axis.motor.speed());
  axis.motor.setBlocked(false);
  axis.hold(0x047F, target(10'000), 3.0);
  EXPECT_NEAR(10.0, axis.position(), kArrived);
}

TEST_F(LowHigh, OnTheWayItIsNotReached) {
  enable(target(20'000));
  axis.hold(0x047F, target(20'000), 0.3);
  EXPECT_FALSE(axis.reached());
  EXPECT_GT(axis.motor.speed(), 1.0);
}

// P105 / P102 and P103: 100 Hz/s; at 50 Hz two pole pairs make 25 revolutions per second.
TEST_F(LowHigh, KeepsTopSpeedAndRamps) {
  enable(target(100'000));
  double fastest = 0.0, steepest = 0.0;
  for (double before = 0.0, t = 0.0; t < 8.0; t += 0.005) {
    axis.send(0x047F, target(100'000));
    const double speed = axis.motor.rotorFrequency();
    fastest = std::max(fastest, speed);
    if (t > 0.05) steepest = std::max(steepest, std::fabs(speed - before) / 0.005);
    before = speed;
  }
  EXPECT_NEAR(50.0, fastest, 1.0);
  EXPECT_LT(steepest, 120.0);
  EXPECT_NEAR(100.0, axis.position(), kArrived);
}

TEST_F(LowHigh, StopsByTheStopWordsAndStaysUntilEnabledAnew) {
  for (const Word stop : {Word{0x047E}, Word{0x047D}, Word{0x047B}}) {
    SCOPED_TRACE(toHexWord(stop));
    Axis one;
    one.words({21, 22, 0}, {10, 15, 0});
    one.send(0x047E, target(40'000));
    one.hold(0x047F, target(40'000), 0.8);
    EXPECT_GT(one.motor.speed(), 10.0);
    one.hold(stop, target(40'000), 20.0);
    const double rest = one.position();
    EXPECT_EQ(0.0, one.motor.speed());
    EXPECT_FALSE(one.reached());
    one.run(1.0);
    EXPECT_EQ(rest, one.position());
    if (stop != 0x047E) {
      one.hold(0x047F, target(40'000), 1.0);
      EXPECT_EQ(rest, one.position()) << "switch-on disabled until OFF1 was seen";
    }
    one.send(0x047E, target(40'000));
    one.hold(0x047F, target(40'000), 5.0);
    EXPECT_NEAR(40.0, one.position(), kArrived);
  }
}

TEST_F(LowHigh, AFaultLetsItCoastAndItStays) {
  enable(target(40'000));
  axis.hold(0x047F, target(40'000), 0.8);
  axis.model.trip(21, false);
  axis.hold(0x047F, target(40'000), 30.0);
  const double rest = axis.position();
  EXPECT_EQ(0.0, axis.motor.speed());
  axis.hold(0x04FF, target(40'000), 1.0);
  axis.hold(0x047F, target(40'000), 1.0);
  EXPECT_EQ(rest, axis.position()) << "acknowledged, not enabled";
}

TEST_F(LowHigh, WithoutP600TheWordsMoveNothing) {
  axis.preset(600, 0);
  enable(target(5'000));
  axis.hold(0x047F, target(5'000), 2.0);
  EXPECT_EQ(0.0, axis.position());
  EXPECT_EQ(0, shown());
}

TEST_F(LowHigh, TheTargetStaysWithinP615AndP616) {
  axis.preset(615, 3'000);
  axis.preset(616, -1'000);
  enable(target(5'000));
  axis.hold(0x047F, target(5'000), 4.0);
  EXPECT_NEAR(3.0, axis.position(), kArrived);
  axis.hold(0x047F, target(-5'000), 4.0);
  EXPECT_NEAR(-1.0, axis.position(), kArrived);
}

}  // namespace
}  // namespace nord_driver::sim
