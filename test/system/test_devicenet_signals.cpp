// Signals and further setpoints over DeviceNet: SK 2xxE behind one SK CU4-DEV, assembly 102 with the module's byte.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/devicenet_robot.h"
#include "system/signals_of_a_drive.h"

namespace nord_driver::test {
namespace {

DevicenetRobot::Options withSignals() {
  DevicenetRobot::Options options;
  options.gateway_inverters = 2;
  options.assembly = 102;
  options.drives = signalSettings();
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) {
      for (const sim::ParameterPreset& preset : signalParameters()) drive.parameters.push_back(preset);
    }
  };
  return options;
}

TEST(DevicenetSignals, ALampFollowsItsTopicAndGoesOffByTimeOut) {
  DevicenetRobot robot{withSignals()};
  expectALampThatFollows(robot);
}

TEST(DevicenetSignals, ABitThatMayMoveStaysLow) {
  DevicenetRobot robot{withSignals()};
  expectNoBitThatMayMove(robot, 3);
}

TEST(DevicenetSignals, InputsAreSeen) {
  DevicenetRobot robot{withSignals()};
  expectInputs(robot);
}

TEST(DevicenetSignals, ATorqueLimitGoesToItsWord) {
  DevicenetRobot robot{withSignals()};
  expectATorqueLimit(robot);
}

// Assembly 101 has no byte of the module: refused at start, in words.
TEST(DevicenetSignals, AnAssemblyWithoutTheByteOfTheModuleHasNoLamp) {
  DevicenetRobot::Options options;
  options.assembly = 101;
  DevicenetRobot robot{options};
  MapSettings drive{"~drives/left/", {}};
  drive.set("signals/lamp/source", "module_output_1");
  const auto setup = cycle::readWordSetup(drive, profile::Series::kSk2xxe, std::chrono::milliseconds{500});
  EXPECT_THROW(cycle::checkWordsCarried(drive, setup, robot.transport().identity(0)), ConfigError);
}

}  // namespace
}  // namespace nord_driver::test
