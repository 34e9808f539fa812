// From the newest velocity command to the wheels and steering angles of a steered base, and from those to its pose.
#pragma once

#include <optional>

#include "cycle/base_config.h"
#include "cycle/commands.h"
#include "cycle/minimum_speeds.h"
#include "nord_driver/core/time.h"
#include "robot/odometry.h"
#include "robot/steered_kinematics.h"
#include "robot/twist_limiter.h"
#include "robot/wheel_speeds.h"

namespace nord_driver::cycle {

/// What the drives of a steered base can do in this cycle, front axle first.
struct SteeredDrives {
  robot::WheelSpeeds max_speeds;  ///< rad/s, what 100 % of the setpoint means at each wheel
  /// rad, of each axle, measured; NaN where a steering drive does not tell where it stands: no angle, no motion.
  robot::SteeringAngles angles;
  MinimumSpeeds minimum;
  bool wheels_turn = false;  ///< one of them was not seen near standstill: none is steered across the way it rolls
  double wheel_speed = 0.0;  ///< of the fastest one, a share of its 100 %
};

/// What a steered base waits for.
enum class SteeredWait : std::uint8_t {
  kNothing,
  kAngles,      ///< the wheels do not yet stand, or not where the motion asks: the base stands, or gets slower
  kNoAngle,     ///< the motion has no angle in the steering range, not even a wider curve: the base stands
  kWiderCurve,  ///< the motion needs an angle outside the steering range: it drives the curve at the end of the range
  kNoPosition,  ///< a steering drive does not tell where it stands
};

/// One base. While it stands, and its wheels were seen to, they are steered first; it drives off once each of them is within the tolerance.
/// While it drives, the path changes only as fast as the steering axes follow: a step along the limits is taken when
/// all wheels stand near enough to the angles it asks for; else the base goes on as it is, and gets slower where that
/// lasts or a wheel is out of tolerance. A wheel that has to be turned about (a new direction, the end of a range) lets
/// the base come to a stop, to which it goes on until the command lets no wheel turn the other way round any more.
///
/// Each wheel turns with the part of the motion that lies along where it really stands.
class SteeredMotion {
 public:
  /// Throws std::invalid_argument in words. `config.steered` is there.
  SteeredMotion(const BaseConfig& config, Duration cmd_vel_timeout);

  /// The setpoint for this cycle. `driving`: the drives follow setpoints now; `follow`: the command may be followed
  /// (otherwise the base ramps to zero along the deceleration limit, its wheels as they stand). A base that is not
  /// driving, or is commanded to stand while its wheels are steered at standstill, keeps them where they are.
  robot::SteeredSetpoint poll(const TwistCommand& command, bool driving, bool follow, const SteeredDrives& drives,
                              Instant now, Duration dt) noexcept;
  SteeredWait waitsFor() const noexcept { return waits_for_; }
  /// A motion has been commanded since the drives follow: the angles of the setpoint are targets. Until then each axis holds the
  /// place it was enabled at by itself, and is stopped when it leaves it (`position/stray`).
  bool commandsAngles() const noexcept { return commands_angles_; }
  /// It rests although a velocity is commanded, for `MinimumSpeeds`.
  bool belowMinimum() const noexcept { return below_minimum_; }
  /// The command is beyond 100 % of the setpoint of a wheel: it is scaled down. Of a joint's own limit it does not tell.
  bool beyondFull() const noexcept { return beyond_full_; }
  /// The last setpoint was made from the command; false: the base rests, or comes to rest, without one.
  bool obeys() const noexcept { return obeys_ && !below_minimum_; }
  /// The velocity behind the last setpoint (what `cmd_vel_out` tells).
  const robot::Twist2d& limited() const noexcept { return limited_; }

  /// The wheels turn with these speeds and stand at these angles now, `dt` after the last call.
  void handleMeasured(const robot::WheelSpeeds& wheels, const robot::SteeringAngles& angles, Duration dt) noexcept;
  /// A drive is away: its way cannot be seen. The pose stays; the next sample starts anew.
  void handleGap() noexcept { odometry_.rebase(); }
  void resetOdometry() noexcept { odometry_.reset(); }

  const robot::Odometry& odometry() const noexcept { return odometry_; }

 private:
  enum class Step : std::uint8_t { kGo, kHold, kBrake, kTurnAbout };

  robot::Twist2d targetOf(const TwistCommand& command, bool obey, const robot::WheelSpeeds& limits,
                          const SteeredDrives& drives) noexcept;
  /// Steers at standstill; true: the base may drive off.
  bool readyToDriveOff(const robot::Twist2d& target, const SteeredDrives& drives, Duration dt) noexcept;
  /// Commanded to stand, the wheels still get slower.
  bool rollsOut(const SteeredDrives& drives, Duration dt) noexcept;
  robot::TwistLimiter stepped(const robot::Twist2d& target, const SteeredDrives& drives, Duration dt) const noexcept;
  void step(const robot::Twist2d& target, const SteeredDrives& drives, Instant now, Duration dt) noexcept;
  Step stepTo(const robot::Twist2d& next, const robot::SteeringAngles& wanted,
              const robot::SteeringAngles& angles) const noexcept;
  /// A wheel would turn the other way round on the path of the target.
  bool anyReverses(const robot::Twist2d& target, const robot::SteeringAngles& angles) const noexcept;
  robot::SteeredSetpoint rest() noexcept;
  robot::SteeredSetpoint setpoint(const SteeredDrives& drives, const robot::WheelSpeeds& limits, bool braking) noexcept;

  robot::SteeredKinematics kinematics_;
  robot::WheelSpeeds joint_limits_;
  robot::TwistLimiter limiter_;
  robot::Odometry odometry_;
  Duration timeout_;
  double tolerance_;
  bool open_loop_;

  robot::Twist2d limited_;
  robot::SteeringAngles steered_;  // commanded last
  bool was_blind_ = false;         // an angle was not known
  bool steers_ = false;            // they may be far from where the wheels stand: steered at standstill
  bool commands_angles_ = false;
  bool drives_ = false;  // the wheels were commanded to turn
  bool obeys_ = false;
  bool below_minimum_ = false;
  bool beyond_full_ = false;
  SteeredWait waits_for_ = SteeredWait::kNothing;
  std::optional<Instant> holding_since_;
  bool turns_about_ = false;  // it comes to a stop for a wheel that is to reverse
  struct Rolling {
    double slowest = 0.0;
    Duration lasts{};  // as a ramp counts it: a cycle that comes late has seen nothing of the time before
  };
  std::optional<Rolling> rolling_;  // at rest by its setpoint, and driving
};

}  // namespace nord_driver::cycle
