#include "commissioning/asked_drive.h"

#include <algorithm>
#include <cmath>

#include "config/driver_settings.h"
#include "cycle/word_places.h"
#include "robot/base_kinematics.h"

namespace nord_driver::commissioning {

namespace {

/// The faster direction of an axis, in its unit; 0 where it has no limit.
double fastest(const robot::SpeedLimits& limits) {
  return limits.has_velocity_limits ? std::max(limits.max_velocity, -limits.minVelocity()) : 0.0;
}

void raiseTo(AskedDrive& drive, double frequency, const std::string& key) {
  if (frequency <= drive.top_frequency) return;
  drive.top_frequency = frequency;
  drive.top_of = key;
}

double hertz(double joint_speed, const cycle::DriveSetup& setup) {
  return std::abs(profile::toHertz(RadPerSec{joint_speed}, setup.drive.joint).value);
}

void askForBase(const cycle::CycleConfig& config, std::vector<AskedDrive>& drives) {
  const cycle::BaseConfig& base = *config.base;
  const auto kinematics = base.kinematics();
  const std::vector<DriveIndex> wheels = base.wheels();
  const auto ask = [&](const robot::SpeedLimits& limits, const robot::Twist2d& unit, const std::string& key) {
    const robot::WheelSpeeds speeds = kinematics->wheels(kinematics->possible(unit));
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      raiseTo(drives[wheels[i]], hertz(speeds[i] * fastest(limits), config.drives[wheels[i]]), key);
    }
  };
  ask(base.limits.linear_x, {1.0, 0.0, 0.0}, "linear/x/max_velocity");
  ask(base.limits.angular_z, {0.0, 1.0, 0.0}, "angular/z/max_velocity");
  ask(base.limits.linear_y, {0.0, 0.0, 1.0}, "linear/y/max_velocity");
  for (const DriveIndex wheel : wheels) drives[wheel].of_base = true;
}

}  // namespace

std::vector<AskedDrive> askedDrives(const cycle::CycleConfig& config, const std::vector<DriveIdentity>& identities,
                                    const std::string& transport, bool looks_on) {
  std::vector<AskedDrive> drives;
  for (std::size_t i = 0; i < config.drives.size(); ++i) {
    const cycle::DriveSetup& setup = config.drives[i];
    AskedDrive drive;
    drive.name = setup.name;
    drive.series = setup.series;
    drive.transport = shortTransportName(transport);
    drive.identity = identities[i];
    drive.looks_on = looks_on;
    drive.period = toSeconds(config.period());
    drive.allows_minimum_frequency = setup.drive.allow_minimum_frequency;
    drive.typed_max_frequency = setup.typed_max_frequency;
    drive.follows = !setup.follows.empty();
    drive.rated_current = setup.rated_current;
    drive.words = cycle::driveNeeds(setup, identities[i].process_values, looks_on);
    if (setup.position) {
      drive.position_bits = cycle::askedBits(*setup.position, setup.series);
      drive.counted_per_motor_turn = setup.position->axis.revolutions_per_motor_turn;
    }
    for (const cycle::SignalSetup& signal : setup.words.signals) {
      const auto bit = cycle::busBitElement(signal);
      if (bit && signal.may_move) drive.may_move_bits.push_back(*bit);
    }
    raiseTo(drive, hertz(fastest(setup.limits), setup), "drives/" + setup.name + "/max_velocity");
    drives.push_back(drive);
  }
  if (config.base) askForBase(config, drives);
  return drives;
}

}  // namespace nord_driver::commissioning
