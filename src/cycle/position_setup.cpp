#include "cycle/position_setup.h"

#include <string>

#include "config/setting_checks.h"
#include "config/setting_choice.h"
#include "cycle/position_bit_setup.h"
#include "profile/process_data_order.h"

namespace nord_driver::cycle {

namespace {

constexpr double kTwoPi = 6.283185307179586476925;
constexpr double kMost = 1e6;               // rad, m, rad/s, m/s
constexpr double kDefaultTolerance = 0.01;  // revolutions of the count
constexpr double kDefaultStray = 0.25;      // the same: more than a load that settles when the brake opens

constexpr Choice<DriveMode> kModes[] = {{"velocity", DriveMode::kVelocity}, {"position", DriveMode::kPosition}};
constexpr Choice<profile::FieldOrder> kOrders[] = {{"high_first", profile::FieldOrder::kHighFirst},
                                                   {"low_first", profile::FieldOrder::kLowFirst}};

/// m for a revolution of the joint's shaft; none: the joint turns.
std::optional<double> readLead(const Settings& drive, const std::optional<robot::JointRange>& joint) {
  if (!drive.has("lead")) {
    if (joint && joint->is_prismatic) {
      throw missingSetting(drive, "lead", "m per revolution of the joint's shaft: the joint is prismatic");
    }
    return std::nullopt;
  }
  const double lead = requiredNumber(drive, "lead", 1e-6, 1e3, "m");
  if (joint && !joint->is_prismatic) {
    throw wrongSetting(drive, "lead", shortNumber(lead),
                       "no such key: in robot_description this joint turns, its positions are rad");
  }
  return lead;
}

/// The narrower of what is typed and what the robot's description says.
void readLimits(const Settings& drive, const char* unit, const std::optional<robot::JointRange>& joint,
                drive::PositionConfig& axis) {
  if (joint) {
    axis.lower = joint->lower;
    axis.upper = joint->upper;
  }
  if (drive.has("position/lower")) {
    const double lower = requiredNumber(drive, "position/lower", -kMost, kMost, unit);
    if (!axis.lower || lower > *axis.lower) axis.lower = lower;
  }
  if (drive.has("position/upper")) {
    const double upper = requiredNumber(drive, "position/upper", -kMost, kMost, unit);
    if (!axis.upper || upper < *axis.upper) axis.upper = upper;
  }
  if (axis.lower && axis.upper && *axis.lower >= *axis.upper) {
    throw wrongSetting(drive, "position/upper", shortNumber(*axis.upper),
                       "more than the lower limit, " + shortNumber(*axis.lower));
  }
}

}  // namespace

DriveMode readDriveMode(const Settings& drive) {
  return choiceOr(drive, "mode", DriveMode::kVelocity, kModes);
}

PositionSetup readPositionSetup(const Settings& drive, const PositionContext& context) {
  const profile::Series series = context.series;
  const profile::JointScaling& scaling = context.scaling;
  const auto& joint = context.joint;
  if (series == profile::Series::kSk1x0e || series == profile::Series::kSk300e) {
    // BU 0020 6.1.2 (SK 7x0E only), 7.3.5; BU 2700 6.4.4: SK 2xxE, and SK 530E and above.
    throw wrongSetting(drive, "mode", "\"position\"",
                       std::string("velocity: inverters ") + profile::toString(series) + " do not position");
  }
  PositionSetup setup;
  const auto lead = readLead(drive, joint);
  const char* const unit = lead ? "m" : "rad";
  const double unit_per_turn = lead ? *lead : kTwoPi;
  const double turns = numberOr(drive, "position/gear_ratio", scaling.gear_ratio, 1e-6, 1e6, "");
  setup.axis.unit_per_radian = unit_per_turn / kTwoPi;
  setup.axis.revolutions_per_motor_turn = turns / scaling.gear_ratio;
  setup.axis.scale.revolutions_per_unit = (scaling.inverted ? -turns : turns) / unit_per_turn;
  setup.axis.scale.offset = numberOr(drive, "position/offset", 0.0, -kMost, kMost, unit);
  if (drive.has("position/steps_per_revolution")) {
    setup.axis.scale.steps_per_revolution = requiredNumber(drive, "position/steps_per_revolution", 1.0, 1e6, "");
  }
  setup.axis.tolerance =
      numberOr(drive, "position/tolerance", kDefaultTolerance / turns * unit_per_turn, 0.0, kMost, unit);
  if (drive.has("position/speed")) {
    const double speed = requiredNumber(drive, "position/speed", 1e-6, kMost, lead ? "m/s" : "rad/s");
    setup.axis.speed = RadPerSec{speed / setup.axis.unit_per_radian};
  }
  readLimits(drive, unit, joint, setup.axis);
  const auto bits = integerOr(drive, "position/bits", 32, 16, 32);
  if (bits != 16 && bits != 32) throw wrongSetting(drive, "position/bits", std::to_string(bits), "16 or 32");
  setup.bits = static_cast<std::uint8_t>(bits);
  setup.order = choiceOr(drive, "position/word_order", profile::FieldOrder::kHighFirst, kOrders);
  setup.setpoint_mode = static_cast<std::int32_t>(integerOr(drive, "position/setpoint_mode", -1, -1, 100));
  setup.axis.stray = numberOr(drive, "position/stray", kDefaultStray / turns * unit_per_turn, 0.0, kMost, unit);
  readPositionBits(drive, series, setup);
  // Revolutions as the drive counts them: an offset of its own may be in it (BU 0510, BU 0710, not at hand).
  setup.axis.reset_to =
      numberOr(drive, "position/reset_to", 0.0, -profile::kMaxRevolutions, profile::kMaxRevolutions, "revolutions");
  setup.axis.homing_timeout = seconds(numberOr(drive, "position/homing_timeout", 60.0, 0.1, 3600.0, "s"));
  return setup;
}

void refusePositionKeys(const Settings& drive) {
  if (const auto lead = drive.number("lead")) {
    throw wrongSetting(drive, "lead", shortNumber(*lead), "mode: position beside it");
  }
}

void checkPositionCarried(const Settings& drive, const PositionSetup& setup, profile::Series series,
                          const DriveIdentity& identity) {
  // A profile of others (CiA 402, DRIVECOM, AC drive) takes setpoint 1 for a share of P105, and tells it as
  // a speed: steps of a position would turn the motor without an end.
  if (!identity.nord_profile) {
    throw wrongSetting(drive, "mode", "\"position\"",
                       "velocity: the profile of this drive carries a speed, no position");
  }
  // The field of SK 700E and 750E takes the places of setpoints 1 and 3 (BU 0020 7.3.1).
  const std::size_t needed = setup.bits == 16 ? 1 : profile::thirdBeforeSecond(series) ? 3 : 2;
  if (identity.process_values >= needed) return;
  throw wrongSetting(drive, "position/bits", std::to_string(setup.bits),
                     std::string("16, or a longer telegram (PPO type, assembly): ") + std::to_string(setup.bits) +
                         " bits need " + std::to_string(needed) + " setpoints and actual values, and the bus carries " +
                         std::to_string(identity.process_values));
}

}  // namespace nord_driver::cycle
