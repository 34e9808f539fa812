// Positions in the words of an InterBus subscriber with PPO type 2: BU 0070 6.1.3 to 6.1.6. 70.000 revolutions are
// 0001 1170h.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/interbus/ibs_ring.h"
#include "sim/interbus/ring_settings.h"

namespace nord_driver::sim {
namespace {

using ::testing::ElementsAre;

struct Axis {
  Axis(Series series, const std::vector<ParameterPreset>& parameters) : robot(config(series, parameters)), ring(robot) {
    ring.advance(now);
    run(1.0);
    ring.outputs()[0] = 0x047E;
    run(0.1);
  }
  static SimConfig config(Series series, const std::vector<ParameterPreset>& parameters) {
    SimConfig config = ringConfig(1);
    DriveConfig& drive = config.drives[0];
    drive.bus.as<IbsDriveConfig>().ppo_type = 2;
    drive.device.series = series;
    drive.parameters = parameters;
    drive.parameters.push_back({600, 0, 0, 1});
    drive.parameters.push_back({102, 0, 0, 50});
    drive.parameters.push_back({103, 0, 0, 50});
    return config;
  }
  void run(double span) { ring.advance(now += seconds(span)); }

  Instant now{std::chrono::hours{1}};
  RobotSim robot;
  IbsRing ring;
};

// "The 32 bit setpoint position is transferred as the second and third word", IW1 likewise: BU 0070 6.1.3, 6.1.5.
TEST(IbsPositions, TheFieldOfSk700e) {
  Axis axis{Series::kSk700e, {{546, 0, 0, 3}, {543, 0, 0, 6}}};
  axis.ring.outputs() = {0x047F, 0x0001, 0x1170, 0};
  axis.run(6.0);
  EXPECT_THAT(axis.ring.inputs(), ElementsAre(0x0B37, 0x0001, 0x1170, 0));
  EXPECT_NEAR(70.0, axis.robot.drive(0).position(), 0.0005);
}

TEST(IbsPositions, TwoWordsOfSk53xe) {
  Axis axis{Series::kSk5xxe, {{546, 0, 0, 21}, {547, 0, 0, 22}, {543, 0, 0, 10}, {544, 0, 0, 15}}};
  axis.ring.outputs() = {0x047F, 0x1170, 0x0001, 0};
  axis.run(6.0);
  EXPECT_THAT(axis.ring.inputs(), ElementsAre(0x0B37, 0x1170, 0x0001, 0));
  EXPECT_NEAR(70.0, axis.robot.drive(0).position(), 0.0005);
}

}  // namespace
}  // namespace nord_driver::sim
