// Seeded trouble on the line, with drives and a base on top of it: whatever goes wrong, nothing is enabled and nothing
// turns unasked; and what is shorter than drive_timeout stops nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint32_t kSequences = 200;
constexpr double kSpeed = 0.39269908169872414;  // 25 Hz
constexpr double kShaftSpeed = 2.0 * M_PI * 25.0 / 2.0;
constexpr double kStill = 0.1;

bool isEnabled(sim::DriveUnit& unit) {
  return unit.inverter().state() == sim::InverterState::kOperationEnabled;
}

/// Seeded as test/profibus/test_fault_sequences.cpp.
class Trouble {
 public:
  explicit Trouble(std::uint32_t seed) : random_{seed} {}

  unsigned below(unsigned limit) { return static_cast<unsigned>(random_() % limit); }

  /// Something goes wrong, until `end()`.
  void strike(SimulatedRobot& robot) {
    const std::size_t drive = below(2);
    sim::BusModule& slave = robot.unit(drive).module();
    switch (below(11)) {
      case 0:
        return robot.segment().loseAnswers(1 + below(12));
      case 1:
        return robot.segment().loseRequests(1 + below(12));
      case 2:
        return robot.segment().spoilAnswers(1 + below(12));
      case 3:
        return slave.setPowered(below(2) == 0);
      case 4:
        return slave.setMute(below(2) == 0);
      case 5:
        return slave.setInverterLink(below(2) == 0);
      case 6:
        return robot.unit(drive).setInverterPower(below(2) == 0);
      case 7:
        return robot.segment().setDevicePresent(below(2) == 0);
      case 8:
        return robot.segment().setAnswerTime(20 + below(400));
      case 9: {
        sim::Disturbance disturbance;
        disturbance.lose = 0.01 * below(3);
        disturbance.flip = 0.01 * below(3);
        disturbance.duplicate = 0.01 * below(3);
        disturbance.seed = below(1'000'000);
        return robot.segment().setDisturbance(disturbance);
      }
      default:
        return robot.segment().setDisturbance({});
    }
  }

  static void end(SimulatedRobot& robot) {
    robot.segment().setDisturbance({});
    robot.segment().setAnswerTime(32);
    robot.segment().loseAnswers(0);
    robot.segment().loseRequests(0);
    robot.segment().spoilAnswers(0);
    robot.segment().setDevicePresent(true);
    for (const std::size_t i : {0u, 1u}) {
      robot.unit(i).module().setPowered(true);
      robot.unit(i).module().setMute(false);
      robot.unit(i).module().setInverterLink(true);
      robot.unit(i).setInverterPower(true);
    }
  }

 private:
  std::mt19937 random_;
};

/// Steps under a command that goes on whatever happens, and looks at the motors after each.
class Watched {
 public:
  SimulatedRobot robot;

  void step() {
    robot.command(kSpeed);
    robot.step();
    if (asked_ && !robot.snapshot().base.enabled) {
      asked_ = false;  // from here on nothing may be enabled any more, and nothing may turn faster
      ++stops;
    }
    for (const std::size_t i : {0u, 1u}) {
      const double speed = std::abs(robot.unit(i).shaftSpeed());
      const bool enabled = isEnabled(robot.unit(i));
      if (!asked_) {
        EXPECT_FALSE(enabled && !was_enabled_[i]) << "drive " << i << " is enabled, and nobody asked";
        EXPECT_LE(speed, was_fast_[i] + kStill) << "drive " << i << " turns faster, and nobody asked";
      }
      EXPECT_LE(speed, 1.1 * kShaftSpeed) << "drive " << i;
      was_enabled_[i] = enabled;
      was_fast_[i] = asked_ ? speed : std::min(speed, std::max(was_fast_[i], kStill));
    }
  }
  void run(Duration span) {
    const Instant end = robot.transport().now() + span;
    while (robot.transport().now() < end && !testing::Test::HasFailure()) step();
  }
  /// The command is stale by then.
  bool enable() {
    robot.run(milliseconds{600});
    EXPECT_TRUE(robot.standsStill());
    asked_ = robot.ask(cycle::RequestKind::kEnable).success;
    return asked_;
  }
  bool runs() const { return asked_; }

  int stops = 0;

 private:
  bool asked_ = false;
  bool was_enabled_[2] = {};
  double was_fast_[2] = {};
};

TEST(FaultSequences, NothingIsEnabledAndNothingTurnsUnasked) {
  int stops = 0, survived = 0;
  for (std::uint32_t seed = 1; seed <= kSequences && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Trouble trouble{seed};
    Watched watched;
    // While it is idle, and from the first cycle on: it starts into the trouble.
    for (int i = 0; i < 6; ++i) {
      if (seed % 2 == 0) trouble.strike(watched.robot);
      const unsigned cycles = 1 + trouble.below(10);
      for (unsigned k = 0; k < cycles; ++k) watched.step();
    }
    Trouble::end(watched.robot);
    watched.run(seconds{3});
    ASSERT_TRUE(watched.robot.bringUp());
    watched.robot.run(milliseconds{600});
    watched.robot.ask(cycle::RequestKind::kAcknowledge);
    ASSERT_TRUE(watched.enable()) << watched.robot.completions().back().message.c_str();
    watched.run(seconds{2});
    // And while it drives.
    for (int i = 0; i < 6; ++i) {
      trouble.strike(watched.robot);
      const unsigned cycles = 1 + trouble.below(10);
      for (unsigned k = 0; k < cycles; ++k) watched.step();
    }
    Trouble::end(watched.robot);
    watched.run(seconds{3});
    // Without mains it coasts for as long as its inertia lasts.
    for (int i = 0; i < 30 && !watched.runs() && !watched.robot.standsStill(); ++i) watched.run(seconds{1});
    if (watched.runs()) {
      ++survived;
      continue;
    }
    EXPECT_TRUE(watched.robot.standsStill()) << "stopped, and it still turns";
    for (const std::size_t i : {0u, 1u}) {
      EXPECT_TRUE(watched.robot.snapshot().drives[i].online) << i;
      EXPECT_FALSE(isEnabled(watched.robot.unit(i))) << i;
      EXPECT_EQ(0x047E, watched.robot.controlWord(i)) << i;
    }
    stops += watched.stops;
  }
  // The test means nothing if the trouble never stopped a base, or stopped every one.
  EXPECT_GT(stops, 50);
  EXPECT_GT(survived, 5);
  RecordProperty("stops", std::to_string(stops));
  RecordProperty("survived", std::to_string(survived));
}

// Two cycles of nothing but silence, of one station or of the line, again and again: shorter than drive_timeout.
TEST(FaultSequences, LossesShorterThanDriveTimeoutStopNothing) {
  std::uint64_t retries = 0;
  for (std::uint32_t seed = 1; seed <= kSequences / 10 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Trouble trouble{seed};
    Watched watched;
    ASSERT_TRUE(watched.robot.bringUp());
    ASSERT_TRUE(watched.enable());
    watched.run(seconds{2});
    for (int i = 0; i < 30; ++i) {
      const unsigned cycles = 1 + trouble.below(2);
      const unsigned kind = trouble.below(4);
      const std::size_t drive = trouble.below(2);
      for (unsigned k = 0; k < cycles; ++k) {
        const unsigned telegrams = 1 + trouble.below(4);  // 4: both stations, with their repetitions
        if (kind == 0) watched.robot.segment().loseAnswers(telegrams);
        if (kind == 1) watched.robot.segment().loseRequests(telegrams);
        if (kind == 2) watched.robot.segment().spoilAnswers(telegrams);
        if (kind == 3) watched.robot.unit(drive).setMute(true);
        watched.step();
      }
      Trouble::end(watched.robot);
      const unsigned good = 1 + trouble.below(5);
      for (unsigned k = 0; k < good; ++k) watched.step();
      ASSERT_TRUE(watched.runs()) << "loss " << i << " of kind " << kind << ", " << cycles
                                  << " cycles: " << watched.robot.snapshot().base.text.c_str();
    }
    retries += watched.robot.transport().counters().value(bus_counter::kRetries);
    EXPECT_EQ("no rule broken", watched.robot.segment().referee().report());
  }
  EXPECT_GT(retries, 300u);
}

}  // namespace
}  // namespace nord_driver::test
