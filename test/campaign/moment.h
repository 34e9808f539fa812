// What an invariant may look at after each cycle: the truth of the simulator, what was asked of the driver, and what it
// says.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "campaign/recent_span.h"
#include "cycle/request.h"
#include "cycle/snapshot.h"
#include "nord_driver/core/time.h"
#include "sim/inverter/inverter_model.h"

namespace nord_driver::test {

constexpr double kWheelRadius = 0.1, kSeparation = 0.5;  ///< m, of all robots here

/// One inverter and its wheel, as they are.
struct DriveTruth {
  sim::InverterState state = sim::InverterState::kOff;
  double frequency = 0.0;     ///< Hz of the field, signed
  double wheel_speed = 0.0;   ///< rad/s at the joint
  std::int16_t setpoint = 0;  ///< setpoint 1 in force, of 16384
  bool bus_control = true;    ///< the words of the bus count
  double ramp = 25.0;         ///< Hz/s, by P103 of the set in force
  double rise = 25.0;         ///< Hz/s, by P102 of that set
  double full = 50.0;         ///< Hz, P105 of that set
  double slowest = 0.0;       ///< Hz, P104 of that set
  double along = 0.0;         ///< Hz, `frequency` in the sense of its joint
  double told = 0.0;          ///< Hz, `setpoint` in the sense of its joint
  double rotor = 0.0;         ///< Hz, the speed of the shaft
  /// Hz, in the sense of its joint, where its actual value is that of the shaft, not that of the field.
  std::optional<double> shaft_along;

  double actual() const noexcept { return shaft_along.value_or(along); }
  double position = 0.0;  ///< rad of the joint, as the inverter counts
  double zero = 0.0;      ///< revolutions of the shaft since the start, where its count is 0

  bool turnsByBus() const noexcept { return state == sim::InverterState::kOperationEnabled && bus_control; }
};

/// Drives that stand or fall together, and what their users want of them.
struct GroupWish {
  std::vector<DriveIndex> members;
  bool is_base = false;
  bool is_axis = false;  ///< one drive that goes to positions
  /// Enabling was asked for, or has succeeded; and nothing since has stopped it: no request, and nothing the driver told.
  bool asked = false;
  bool confirmed = false;  ///< the enabling was answered with success
  /// One of its drives was seen not to be enabled since then, whatever the driver tells: it has to be asked for again.
  bool interrupted = false;
};

/// What a user has sent to a drive that goes to positions, rad.
struct AskedMove {
  bool onward = false;  ///< an increment, else a target
  double value = 0.0;
};

/// What users want of a drive that goes to positions.
struct AxisWish {
  bool is_axis = false;
  bool homing = false;           ///< a reference run was asked for, and is not answered
  std::vector<AskedMove> asked;  ///< since the driver ran last, in order
};

/// How fast the driver itself changes the setpoint of a drive that is told speeds, Hz/s.
struct SetpointRamp {
  double slowest = kAtOnce;
  double fastest = kAtOnce;
  /// Where its slowest says nothing, the longest way from one command to another, or to zero. The setpoint is between the
  /// two meanwhile.
  Duration longest{};

  static constexpr double kAtOnce = 1e6;
};

/// One request, from when it was submitted to when it was answered.
struct Call {
  cycle::Request request;
  Instant submitted{};
  bool answered = false;
  std::vector<std::int32_t> held;  ///< of a parameter: every value it had since it was asked for
};

struct Moment {
  Instant began{};         ///< of the cycle
  Instant now{};           ///< after it
  unsigned at = 0;         ///< ms after the start
  bool driver_ran = true;  ///< false: it is held up, or ended
  bool judged = true;      ///< the invariants of reports hold: false, once the node has ended
  Duration period{};
  std::vector<DriveTruth> drives;
  std::vector<GroupWish> groups;
  std::vector<double> wanted;  ///< Hz, of each drive: the newest command that is not too old, 0 without one
  std::vector<bool> renewed;   ///< of each drive: that command was given for this cycle
  std::vector<SetpointRamp> setpoint_ramps;  ///< of each drive
  /// Hz, of each drive, where not empty: between which setpoints the one that is wanted may be, for a base whose axes
  /// go from one command to another each in its own time.
  std::vector<Span> between;
  std::vector<AxisWish> axes;  ///< of each drive
  std::vector<bool> cut;       ///< of each drive: the exchange with it is interrupted by what happens
  Duration reaction{};         ///< how long a stop may take to reach the inverters, as things are
  Duration noticed_within{};   ///< the same of one that begins with what an inverter does by itself
  Duration heard_within{};     ///< how old the setpoint of a drive that turns may be, as things are
  Duration told_within{};      ///< how old what the driver tells of a drive that answers may be, as things are
  /// One that stands at the address of a drive, and of which nobody knows, is "operation enabled" by the bus.
  bool twin_enabled = false;
  /// The same, where nothing was heard of the first drive itself: what is said of it is said of this one.
  bool stand_in_enabled = false;
  /// The first drive was not heard while it stood there: what the driver has read of that one may be read of this one,
  /// until the address falls silent.
  bool stand_in_believed = false;
  /// Where it is, rad: while it stands there, it answers in the name of the first drive.
  std::optional<double> twin_position;
  const cycle::CycleSnapshot* snapshot = nullptr;
  std::vector<cycle::Completion> answers;  ///< of this cycle
  const std::vector<Call>* calls = nullptr;
  bool odometry_reset = false;      ///< asked for, and answered in this cycle or later
  double full_wheel_speed = 7.854;  ///< rad/s
  bool reads_scale = false;         ///< P105 of each set is read, not typed: no speed can be told before

  Span wantedOf(std::size_t drive) const {
    return between.empty() ? Span{wanted[drive], wanted[drive]} : between[drive];
  }
};

}  // namespace nord_driver::test
