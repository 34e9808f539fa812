// A bus cycle over a steered base: two wheels on the middle line, each with a drive that steers it.
#pragma once

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {

inline constexpr double kQuarter = 1.57079632679489662;

inline BaseConfig steeredBase() {
  BaseConfig config;
  config.kind = robot::BaseKind::kSteered;
  SteeredConfig steered;
  steered.wheels = {0, 1};
  steered.steering = {2, 3};
  steered.axles = {{0.5, 0.0, 0.1, -kQuarter, kQuarter}, {-0.5, 0.0, 0.1, -kQuarter, kQuarter}};
  steered.angle_tolerance = 0.05;
  config.steered = steered;
  return config;
}

/// Wheels 0 and 1 before and behind the middle, steered by drives 2 and 3, which stand at 0 whatever they are told.
class SteeredBench : public CycleBench {
 public:
  explicit SteeredBench(std::size_t velocity_window = 10) : SteeredBench{config(velocity_window)} {}
  explicit SteeredBench(const CycleConfig& config) : CycleBench{config} {
    for (const DriveIndex steering : {DriveIndex{2}, DriveIndex{3}}) {
      transport.of_drive[steering] = {{543, 1},  {544, 10}, {545, 15}, {546, 1},
                                      {547, 21}, {548, 22}, {480, 22}, {600, 1}};
      transport.inverters[steering].ramp = 0;
    }
    run(100);
  }
  static CycleConfig config(std::size_t velocity_window = 10) {
    CycleConfig config = CycleBench::config();
    config.cmd_vel_timeout = std::chrono::milliseconds{500};
    config.drives.resize(2);
    config.drives[0].name = "front";
    config.drives[1].name = "rear";
    for (const char* name : {"front_steering", "rear_steering"}) {
      DriveSetup setup = config.drives[0];
      setup.name = name;
      setup.position = PositionSetup{};
      setup.position->home = PositionBit{};
      setup.position->axis.scale.revolutions_per_unit = 100.0;
      setup.drive.position = setup.position->axis;
      config.drives.push_back(setup);
    }
    config.base = steeredBase();
    config.base->velocity_rolling_window_size = velocity_window;
    return config;
  }
  /// A command to the left, for as many cycles, heard in each of them.
  void driveSideways(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      TwistCommand command{{}, transport.time, true};
      command.twist.linear_y = 0.2;
      ports.commandBase(command);
      step();
    }
  }
};

}  // namespace nord_driver::cycle
