// Seeded trouble on a bus, with drives and a base on top of it: whatever goes wrong, nothing is enabled and nothing turns
// unasked; and what is shorter than drive_timeout stops nothing.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/drive_unit.h"
#include "support/dice.h"
#include "system/driven_robot.h"

namespace nord_driver::test {

/// Steps under a command that goes on whatever happens, and looks at the motors after each.
template <typename Robot>
class Watched {
 public:
  Robot robot;

  void step() {
    robot.command(kHalfSpeed);
    robot.step();
    if (asked_ && !robot.snapshot().base.enabled) {
      asked_ = false;  // from here on nothing may be enabled any more, and nothing may turn faster
      ++stops;
    }
    for (const std::size_t i : {0u, 1u}) {
      const double speed = std::abs(robot.unit(i).shaftSpeed());
      const bool enabled = isEnabled(i);
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
    robot.run(std::chrono::milliseconds{600});
    EXPECT_TRUE(robot.standsStill());
    asked_ = robot.ask(cycle::RequestKind::kEnable).success;
    return asked_;
  }
  bool runs() const { return asked_; }
  bool isEnabled(std::size_t drive) {
    return robot.unit(drive).inverter().state() == sim::InverterState::kOperationEnabled;
  }

  int stops = 0;

 private:
  static constexpr double kShaftSpeed = 2.0 * M_PI * 25.0 / 2.0;
  static constexpr double kStill = 0.1;

  bool asked_ = false;
  bool was_enabled_[2] = {};
  double was_fast_[2] = {};
};

/// `Trouble`: made of Dice; `strike(robot)`: something goes wrong, until `end(robot)`; `kBackWithin`: then the drives are
/// there again. `sequences` of them; of the bases that drove, more than `least_stops` were stopped by it and more than
/// `least_survived` not: the test means nothing if the trouble never stopped a base, or stopped every one.
template <typename Robot, typename Trouble>
void expectNothingUnasked(std::uint32_t sequences, int least_stops, int least_survived) {
  using std::chrono::milliseconds;
  using std::chrono::seconds;
  int stops = 0, survived = 0;
  for (std::uint32_t seed = 1; seed <= sequences && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Dice dice{seed};
    Watched<Robot> watched;
    // While it is idle, and from the first cycle on: it starts into the trouble.
    for (int i = 0; i < 6; ++i) {
      if (seed % 2 == 0) Trouble::strike(watched.robot, dice);
      const unsigned cycles = 1 + dice.below(10);
      for (unsigned k = 0; k < cycles; ++k) watched.step();
    }
    Trouble::end(watched.robot);
    watched.run(Trouble::kBackWithin);
    ASSERT_TRUE(watched.robot.bringUp());
    watched.robot.run(milliseconds{600});
    watched.robot.ask(cycle::RequestKind::kAcknowledge);
    ASSERT_TRUE(watched.enable()) << watched.robot.completions().back().message.c_str();
    watched.run(seconds{2});
    // And while it drives.
    for (int i = 0; i < 6; ++i) {
      Trouble::strike(watched.robot, dice);
      const unsigned cycles = 1 + dice.below(10);
      for (unsigned k = 0; k < cycles; ++k) watched.step();
    }
    Trouble::end(watched.robot);
    watched.run(Trouble::kBackWithin);
    // Without mains it coasts for as long as its inertia lasts.
    for (int i = 0; i < 30 && !watched.runs() && !watched.robot.standsStill(); ++i) watched.run(seconds{1});
    if (watched.runs()) {
      ++survived;
      continue;
    }
    EXPECT_TRUE(watched.robot.standsStill()) << "stopped, and it still turns";
    for (const std::size_t i : {0u, 1u}) {
      EXPECT_TRUE(watched.robot.snapshot().drives[i].online) << i;
      EXPECT_FALSE(watched.isEnabled(i)) << i;
      EXPECT_EQ(0x047E, watched.robot.controlWord(i)) << i;
    }
    stops += watched.stops;
  }
  EXPECT_GT(stops, least_stops);
  EXPECT_GT(survived, least_survived);
  testing::Test::RecordProperty("stops", std::to_string(stops));
  testing::Test::RecordProperty("survived", std::to_string(survived));
}

}  // namespace nord_driver::test
