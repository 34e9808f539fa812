// A moment of two wheels, made by hand: what tests of the invariants begin with.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "campaign/invariant.h"

namespace nord_driver::test {

/// Two wheels of a base that are enabled and told so, at rest; a cycle is 10 ms, a word takes 50 ms to reach them.
class TwoWheelsMoment : public ::testing::Test {
 protected:
  TwoWheelsMoment() : snapshot_(2) {
    moment_.now = Instant{std::chrono::seconds{1000}};
    moment_.period = std::chrono::milliseconds{10};
    moment_.reaction = moment_.noticed_within = moment_.heard_within = moment_.told_within =
        std::chrono::milliseconds{50};
    moment_.drives.resize(2);
    moment_.wanted.resize(2);
    moment_.renewed = {true, true};
    moment_.setpoint_ramps.resize(2);
    moment_.axes.resize(2);
    moment_.cut.resize(2);
    GroupWish base;
    base.members = {0, 1};
    base.is_base = base.asked = base.confirmed = true;
    moment_.groups.push_back(base);
    moment_.snapshot = &snapshot_;
    for (DriveTruth& drive : moment_.drives) drive.state = sim::InverterState::kOperationEnabled;
    for (cycle::DriveSnapshot& drive : snapshot_.drives) drive.online = drive.device.complete = true;
    snapshot_.base.enabled = snapshot_.base.known = true;
  }
  /// What it says after the next cycle; empty: nothing.
  std::string cycle(Invariant& invariant) {
    moment_.began = moment_.now;
    moment_.now += moment_.period;
    snapshot_.time = moment_.now;
    return invariant.look(moment_).value_or("");
  }
  void want(double hertz) { moment_.wanted = {hertz, hertz}; }

  Moment moment_;
  cycle::CycleSnapshot snapshot_;
};

}  // namespace nord_driver::test
