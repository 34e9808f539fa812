// The invariants of what follows what: the wheels their commands, and what the driver tells of motion the wheels.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "campaign/invariant.h"
#include "campaign/recent_span.h"
#include "robot/odometry.h"

namespace nord_driver::test {

/// A wheel or single drive that is enabled turns as fast as commanded, and that way round: what TurnsOnlyAsCommanded
/// allows it does. One that has a slowest speed rests below it, which this does not tell from one that does not follow.
class FollowsItsCommand final : public Invariant {
 public:
  const char* name() const override { return "FollowsItsCommand"; }
  const char* sentence() const override { return "cmd_vel: wheels turn as commanded, along the ramps of the drives"; }
  std::optional<std::string> look(const Moment& moment) override;

 private:
  struct Track {
    RecentSpan wanted;  // Hz
    Span setpoint;      // Hz, where the driver's own ramp can be
    RecentSpan sent;    // Hz, the same
    Span speed;         // Hz, where the drive can be
  };

  std::vector<Track> tracks_;
  std::optional<Instant> last_;
};

/// Setpoint 1 of a drive that stays enabled never changes faster than the limits of acceleration say, up and down, whatever
/// has happened before: a stall of the host, a stop, a lost drive.
class SetpointWithinRamp final : public Invariant {
 public:
  const char* name() const override { return "SetpointWithinRamp"; }
  const char* sentence() const override {
    return "max_acceleration: acceleration is limited; ramps of stops follow it, too (doc/parameters.md)";
  }
  std::optional<std::string> look(const Moment& moment) override;
  void driverBegan() override { tracks_.clear(); }

 private:
  struct Track {
    Instant since{};    // the setpoint is this one
    double told = 0.0;  // Hz
    double full = 0.0;  // Hz
    bool turned = false;
  };

  std::vector<Track> tracks_;
};

/// Velocity and way of a joint, as told of a drive that answers, are those of its wheel.
class MotionToldAsItIs final : public Invariant {
 public:
  const char* name() const override { return "MotionToldAsItIs"; }
  const char* sentence() const override { return "joint_states: position and velocity from the actual values"; }
  std::optional<std::string> look(const Moment& moment) override;
  void driverBegan() override { tracks_.clear(); }

 private:
  struct Track {
    RecentSpan turned;        // Hz
    unsigned answered = 0;    // cycles in a row
    double way = 0.0;         // rad, since it answers
    double joint_from = 0.0;  // rad
    double fastest = 0.0;     // rad/s meanwhile
  };

  std::vector<Track> tracks_;
  std::optional<Instant> last_;
};

/// The pose goes as the joints of the wheels go.
class PoseAsTheWheels final : public Invariant {
 public:
  const char* name() const override { return "PoseAsTheWheels"; }
  const char* sentence() const override { return "odom: integrated from the wheels"; }
  std::optional<std::string> look(const Moment& moment) override;
  void driverBegan() override {
    joints_.clear();
    answered_ = 0;
  }

 private:
  unsigned answered_ = 0;  // cycles in a row in which all did
  robot::Pose2d pose_;
  std::vector<double> joints_;
};

}  // namespace nord_driver::test
