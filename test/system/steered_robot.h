// A base with two steered axles on a simulated segment, in simulated time.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cycle/cycle_config.h"
#include "sim/profibus/simulated_segment.h"
#include "sim/robot/body.h"
#include "support/map_settings.h"
#include "system/driven_robot.h"
#include "system/recording_link.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver::test {

/// Four SK 53xE: each axle has a driven wheel of 0.1 m (20:1, 100 % is 0.785 m/s) half a metre before or behind the
/// middle, and a steering axis of 100:1 with POSICON, at most 1.57 rad/s.
class SteeredRobot : public DrivenRobot {
 public:
  static constexpr DriveIndex kFront = 0, kFrontSteering = 1, kRear = 2, kRearSteering = 3;
  static constexpr std::size_t kDrives = 4;

  struct Options {
    double slip = 2.0;            ///< Hz at rated torque
    double steering_range = 1.6;  ///< rad, to either side
    double steering_ramp = 0.2;   ///< s, P102 and P103 of the steering drives
    std::map<std::string, MapSettings::Value> node;
  };

  SteeredRobot() : SteeredRobot(Options{}) {}
  explicit SteeredRobot(const Options& options) {
    const auto drives = driveSettings(options);
    std::map<std::string, MapSettings::Value> values = options.node;
    values.insert({{"cycle_rate", 100.0}, {"base_type", std::string{"steered"}}, {"wheel_radius", 0.1}});
    for (const auto& [axle, x] : {std::pair{"front", 0.5}, std::pair{"rear", -0.5}}) {
      const std::string group = std::string{"steered/"} + axle + "/";
      values.insert({{group + "wheel_joint", std::string{axle} + "_wheel_joint"},
                     {group + "steering_joint", std::string{axle} + "_steering_joint"},
                     {group + "x", x},
                     {group + "y", 0.0}});
    }
    for (const std::string axis : {"linear/x", "linear/y", "angular/z"}) {
      values.insert({{axis + "/has_acceleration_limits", true}, {axis + "/max_acceleration", 0.5}});
    }
    const cycle::CycleConfig config = cycle::readCycleConfig(MapSettings{"~", values}, drives);
    auto transport = std::make_unique<ProfibusDpTransport>([this, options](const link::SerialSettings&) {
      auto segment = std::make_unique<sim::SimulatedSegment>(simConfig(options));
      segment_ = segment.get();
      return std::make_unique<RecordingLink>(std::move(segment));
    });
    const std::map<std::string, MapSettings::Value> bus{
        {"device", std::string{"simulated"}}, {"baud_rate", 500'000}, {"slot_time", 0.0005}};
    transport->configure(MapSettings{"~bus/", bus}, drives, config.cycle_rate);
    start(config, std::move(transport), false);
  }

  /// The same command, renewed every cycle, with a part to the left.
  void go(double forward, double turning, double left, Duration span) {
    const Instant end = transport().now() + span;
    while (transport().now() < end) {
      say(forward, turning, left);
      step();
    }
  }
  void say(double forward, double turning, double left) {
    ports().commandBase({{forward, turning, left}, transport().now(), true});
  }

  static bool isSteering(DriveIndex drive) { return drive % 2 == 1; }
  sim::SimulatedSegment& segment() { return *segment_; }
  sim::DriveUnit& unit(std::size_t drive) { return segment_->drive(drive); }
  const sim::Body& body() { return *segment_->robot().body(); }
  /// rad, as it really is.
  double angle(DriveIndex steering) { return unit(steering).wheelAngle(); }
  /// No shaft turns.
  bool standsStill() {
    for (std::size_t i = 0; i < kDrives; ++i) {
      if (std::abs(unit(i).shaftSpeed()) >= 0.1) return false;
    }
    return true;
  }
  const cycle::DriveSnapshot& drive(DriveIndex index) { return snapshot().drives[index]; }

 private:
  static const char* nameOf(DriveIndex drive) {
    const char* const names[] = {"front", "front_steering", "rear", "rear_steering"};
    return names[drive];
  }
  static std::string jointOf(DriveIndex drive) {
    return std::string{nameOf(drive)} + (isSteering(drive) ? "_joint" : "_wheel_joint");
  }
  static std::vector<DriveSettings> driveSettings(const Options& options) {
    std::vector<DriveSettings> drives;
    for (DriveIndex i = 0; i < kDrives; ++i) {
      auto settings = std::make_shared<MapSettings>(std::string{"~drives/"} + nameOf(i) + "/");
      settings->set("address", static_cast<int>(3 + i)).set("ppo_type", isSteering(i) ? 2 : 1);
      settings->set("series", "sk5xxe").set("joint", jointOf(i).c_str()).set("pole_pairs", 2);
      settings->set("gear_ratio", isSteering(i) ? 100.0 : 20.0);
      if (isSteering(i)) {
        settings->set("mode", "position");
        settings->set("position/lower", -options.steering_range).set("position/upper", options.steering_range);
      }
      drives.push_back({nameOf(i), settings});
    }
    return drives;
  }
  static sim::SimConfig simConfig(const Options& options) {
    sim::SimConfig config;
    config.bus.as<sim::DpBusConfig>().baud_rate = 500'000;
    config.body = sim::BodyConfig{};
    config.body->kind = sim::BodyKind::kSteered;
    config.body->wheel_radius = 0.1;
    config.body->front = {kFront, kFrontSteering, 0.5, 0.0};
    config.body->rear = {kRear, kRearSteering, -0.5, 0.0};
    for (DriveIndex i = 0; i < kDrives; ++i) {
      sim::DriveConfig drive;
      drive.name = nameOf(i);
      drive.joint = jointOf(i);
      drive.address = static_cast<std::uint8_t>(3 + i);
      drive.gear_ratio = isSteering(i) ? 100.0 : 20.0;
      drive.motor.slip = options.slip;
      drive.bus.as<sim::DpDriveConfig>().ppo_type = isSteering(i) ? 2 : 1;
      const auto ramp = static_cast<std::int32_t>(std::lround(100.0 * (isSteering(i) ? options.steering_ramp : 0.7)));
      for (unsigned set = 0; set < 4; ++set) {
        for (const std::uint16_t number : {std::uint16_t{102}, std::uint16_t{103}})
          drive.parameters.push_back({number, set, 0, ramp});
        if (!isSteering(i)) continue;
        // Setpoint 1 the speed it travels at, 2 and 3 the position; of the actual values the same (BU 2700 5.3).
        const std::pair<std::uint16_t, std::int32_t> words[] = {{600, 2}, {546, 1},  {547, 23}, {548, 24},
                                                                {543, 1}, {544, 10}, {545, 15}};
        for (const auto& [number, value] : words) drive.parameters.push_back({number, set, 0, value});
      }
      config.drives.push_back(drive);
    }
    return config;
  }

  sim::SimulatedSegment* segment_ = nullptr;
};

}  // namespace nord_driver::test
