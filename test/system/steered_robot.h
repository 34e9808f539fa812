// A base with two steered axles on whichever simulated bus, in simulated time.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/robot/body.h"
#include "support/map_settings.h"
#include "system/lift.h"

namespace nord_driver::test {

/// The drives: wheels and, behind each, what steers it.
inline constexpr DriveIndex kFront = 0, kFrontSteering = 1, kRear = 2, kRearSteering = 3;
inline constexpr std::size_t kSteeredDrives = 4;
constexpr bool isSteering(DriveIndex drive) {
  return drive % 2 == 1;
}

/// Setpoint 1 the speed it travels at, 2 and 3 the position; of the actual values the same (BU 2700 5.3).
constexpr LiftWords kSteeringWords{"SK 53xE, 23 and 24", "sk5xxe", sim::Series::kSk5xxe, {1, 23, 24}, {1, 10, 15}, 32};

struct SteeredOptions {
  double slip = 2.0;            ///< Hz at rated torque
  double steering_range = 1.6;  ///< rad, to either side
  double steering_ramp = 0.2;   ///< s, P102 and P103 of the steering drives
  double wheel_ramp = 0.7;      ///< s, those of the wheels
  bool limits = true;           ///< of the base's acceleration; false: the drives' ramps are the only ones
  /// Steering axes that may be asked for a reference run: bit 8 of the control word asks, bit 10 of the status word tells.
  bool homes = false;
  bool sync = false;  ///< over CANopen: each cycle's values are of one moment
};

/// Four SK 53xE: each axle has a driven wheel of 0.1 m (20:1, 100 % is 0.785 m/s) half a metre before or behind the
/// middle, and a steering axis of 100:1 with POSICON, at most 1.57 rad/s. `Bus`: the robot of that bus.
template <typename Bus>
class SteeredRobot : public Bus {
 public:
  SteeredRobot() : SteeredRobot(SteeredOptions{}) {}
  explicit SteeredRobot(const SteeredOptions& options) : Bus(busOptions(options)) {}

  /// The same command, renewed every cycle, with a part to the left.
  void go(double forward, double turning, double left, Duration span) {
    const Instant end = this->transport().now() + span;
    while (this->transport().now() < end) {
      say(forward, turning, left);
      this->step();
    }
  }
  void say(double forward, double turning, double left) {
    this->ports().commandBase({{forward, turning, left}, this->transport().now(), true});
  }

  const sim::Body& body() {
    if constexpr (std::is_same_v<Bus, InterbusRobot>) {
      return *this->gateway().robot().body();
    } else {
      return *busOf(*this).robot().body();
    }
  }
  /// rad, as it really is.
  double angle(DriveIndex steering) { return this->unit(steering).wheelAngle(); }
  /// No shaft turns.
  bool standsStill() {
    for (std::size_t i = 0; i < kSteeredDrives; ++i) {
      if (std::abs(this->unit(i).shaftSpeed()) >= 0.1) return false;
    }
    return true;
  }
  const cycle::DriveSnapshot& drive(DriveIndex index) { return this->snapshot().drives[index]; }
  const std::string& nameOf(DriveIndex index) const { return this->config().drives[index].name; }
  /// Which rules of its bus the driver broke.
  std::string report() {
    if constexpr (std::is_same_v<Bus, InterbusRobot>) {
      return this->referee();
    } else {
      return busOf(*this).referee().report();
    }
  }

 private:
  using Settings = std::map<std::string, MapSettings::Value>;
  static constexpr bool kIsProfibus = std::is_same_v<Bus, SimulatedRobot>;

  static std::string jointOf(DriveIndex drive) {
    const char* const names[] = {"front_wheel", "front_steering", "rear_wheel", "rear_steering"};
    return std::string{names[drive]} + "_joint";
  }
  static Settings nodeSettings(const SteeredOptions& options) {
    Settings values{{"base_type", std::string{"steered"}}, {"wheel_radius", 0.1}};
    for (const auto& [axle, x] : {std::pair{"front", 0.5}, std::pair{"rear", -0.5}}) {
      const std::string group = std::string{"steered/"} + axle + "/";
      values.insert({{group + "wheel_joint", std::string{axle} + "_wheel_joint"},
                     {group + "steering_joint", std::string{axle} + "_steering_joint"},
                     {group + "x", x},
                     {group + "y", 0.0}});
    }
    for (const std::string axis : {"linear/x", "linear/y", "angular/z"}) {
      if (!options.limits) break;
      values.insert({{axis + "/has_acceleration_limits", true}, {axis + "/max_acceleration", 0.5}});
    }
    return values;
  }
  static Settings driveSettings(const SteeredOptions& options, DriveIndex drive) {
    Settings values{{"joint", jointOf(drive)}, {"inverted", false}, {"gear_ratio", isSteering(drive) ? 100.0 : 20.0}};
    if (!isSteering(drive)) return values;
    values.insert({{"mode", std::string{"position"}},
                   {"position/lower", -options.steering_range},
                   {"position/upper", options.steering_range}});
    if (options.homes) {
      values.insert({{"position/home", std::string{"control_bit_8"}},
                     {"position/referenced", std::string{"status_bit_10"}},
                     {"position/homing_timeout", 20.0}});
    }
    // Three words each way.
    if constexpr (kIsProfibus || std::is_same_v<Bus, InterbusRobot>) {
      values["ppo_type"] = 2;
    } else if constexpr (std::is_same_v<Bus, DevicenetRobot>) {
      values["assembly"] = 101;
    } else {
      values["process_values"] = 3;
    }
    return values;
  }

  static void simulate(const SteeredOptions& options, sim::SimConfig& config) {
    config.body = sim::BodyConfig{};
    config.body->kind = sim::BodyKind::kSteered;
    config.body->wheel_radius = 0.1;
    config.body->front = {kFront, kFrontSteering, 0.5, 0.0};
    config.body->rear = {kRear, kRearSteering, -0.5, 0.0};
    for (DriveIndex i = 0; i < kSteeredDrives; ++i) {
      sim::DriveConfig& drive = config.drives[i];
      drive.joint = jointOf(i);
      drive.gear_ratio = isSteering(i) ? 100.0 : 20.0;
      drive.inverted = false;
      drive.motor.slip = options.slip;
      if (isSteering(i)) {
        const auto words = liftParameters(kSteeringWords);
        drive.parameters.insert(drive.parameters.end(), words.begin(), words.end());
        setThreeWords(drive);
        if (options.homes) setReferenceSwitch(drive);
      }
      const double seconds_long = isSteering(i) ? options.steering_ramp : options.wheel_ramp;
      const auto ramp = static_cast<std::int32_t>(std::lround(100.0 * seconds_long));
      for (unsigned set = 0; set < 4; ++set) {
        drive.parameters.push_back({102, set, 0, ramp});
        drive.parameters.push_back({103, set, 0, ramp});
      }
    }
  }
  static void setThreeWords(sim::DriveConfig& drive) {
    if constexpr (kIsProfibus) {
      drive.bus.as<sim::DpDriveConfig>().ppo_type = 2;
    } else if constexpr (std::is_same_v<Bus, DevicenetRobot>) {
      drive.bus.as<sim::DnDriveConfig>().assembly = 101;
    } else if constexpr (std::is_same_v<Bus, InterbusRobot>) {
      drive.bus.as<sim::IbsDriveConfig>().ppo_type = 2;
    }
  }
  /// Its switch is a tenth of a revolution of the wheel below the middle.
  static void setReferenceSwitch(sim::DriveConfig& drive) {
    drive.inverter.posicon.encoder = sim::EncoderKind::kIncremental;
    drive.inverter.posicon.reference_switch = -10.0;
    drive.inverter.posicon.reference_speed = -20.0;
    drive.parameters.push_back({480, 0, 10, 22});
    drive.parameters.push_back({481, 0, 8, 20});
  }

  static typename Bus::Options busOptions(const SteeredOptions& options) {
    typename Bus::Options bus;
    bus.base = false;  // not that of two wheels
    bus.node = nodeSettings(options);
    bus.simulate = [options](sim::SimConfig& config) { simulate(options, config); };
    for (DriveIndex i = 0; i < kSteeredDrives; ++i) {
      if constexpr (kIsProfibus) {
        bus.of_drive["single" + std::to_string(i)] = driveSettings(options, i);
      } else {
        bus.each.push_back(driveSettings(options, i));
      }
    }
    if constexpr (kIsProfibus) {
      bus.singles = kSteeredDrives;
    } else if constexpr (std::is_same_v<Bus, CanRobot>) {
      bus.nodes = kSteeredDrives;
      bus.bus = {{"sync", options.sync}};
    } else {
      bus.modules = kSteeredDrives;
    }
    if constexpr (std::is_same_v<Bus, DevicenetRobot>) bus.on_inverter = true;
    if constexpr (std::is_same_v<Bus, InterbusRobot>) bus.pcp = true;
    return bus;
  }
};

}  // namespace nord_driver::test
