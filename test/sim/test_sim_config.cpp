#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "nord_driver/sim/robot_sim.h"
#include "nord_driver/sim/sim_config.h"

namespace nord_driver::sim {
namespace {

const char* const kRobot = R"(
bus: {device: /tmp/x, baud_rate: 93750, master_address: 1}
left_wheel: l_joint
right_wheel: [r_joint]
wheel_radius: 0.1
wheel_separation: 0.5
drives:
  left: {address: 3, series: sk5xxe, ppo_type: 1, joint: l_joint, gear_ratio: 20.0, pole_pairs: 2, max_frequency: 70.0}
  right: {address: 4, joint: r_joint, gear_ratio: 20, inverted: true, slip: 3, parameters: {P105: [50, 60, 70, 80], P513: -0.1}}
)";

// The driver's own file is a configuration of the simulator.
TEST(SimConfig, ReadsTheDriversFile) {
  const SimConfig config = readSimConfig(YAML::Load(kRobot));
  EXPECT_EQ("/tmp/x", config.device);
  EXPECT_EQ(93750u, config.baud_rate);
  ASSERT_EQ(2u, config.drives.size());
  EXPECT_EQ("left", config.drives[0].name);
  EXPECT_EQ(4, config.drives[1].slave.address);
  EXPECT_TRUE(config.drives[1].inverted);
  EXPECT_EQ(3.0, config.drives[1].motor.slip);
  ASSERT_TRUE(config.body.has_value());
  EXPECT_EQ(std::vector<std::size_t>{0}, config.body->left);
  EXPECT_EQ(std::vector<std::size_t>{1}, config.body->right);
  EXPECT_TRUE(config.warnings.empty());

  RobotSim robot{config};
  EXPECT_EQ(700, robot.drive(0).parameters().value(105, 3));
  EXPECT_EQ(800, robot.drive(1).parameters().value(105, 3));
  EXPECT_EQ(500, robot.drive(1).parameters().value(105, 0));
  EXPECT_EQ(-1, robot.drive(1).parameters().value(513));
  EXPECT_EQ(0u, robot.drive(1).parameters().eepromWrites());
}

// A second file is laid over the first: its body is the true one.
TEST(SimConfig, MergesFiles) {
  const YAML::Node merged =
      mergeYaml(YAML::Load(kRobot), YAML::Load("{body: {left: left, right: [right], wheel_radius: 0.11, "
                                               "wheel_separation: 0.52}, drives: {left: {slip: 4}}}"));
  const SimConfig config = readSimConfig(merged);
  EXPECT_EQ(0.11, config.body->wheel_radius);
  EXPECT_EQ(4.0, config.drives[0].motor.slip);
  EXPECT_EQ(20.0, config.drives[0].gear_ratio);
}

TEST(SimConfig, WarnsAboutUnknownKeys) {
  const SimConfig config = readSimConfig(YAML::Load("drives: {a: {address: 3, gear_ration: 20}}"));
  EXPECT_THAT(config.warnings, testing::ElementsAre(testing::HasSubstr("drives/a/gear_ration")));
}

// What differs between inverters of one interface is a key: firmware, known orders, width of answers.
TEST(SimConfig, ReadsWhatTheInverterCan) {
  const SimConfig config = readSimConfig(YAML::Load(
      "drives: {a: {address: 3, series: sk700e, firmware: 1.8, ram_orders: false, double_word_answers: false, "
      "automatic_acknowledgement_delay: 2, parameter_delay: 7}, b: {address: 4, series: sk54xe, parameters: {P546: [1, "
      "1, 1, 1, 4, 4, 4, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]}}}"));
  EXPECT_FALSE(config.drives[0].pkw.ram_orders);
  EXPECT_FALSE(config.drives[0].pkw.double_word_answers);
  EXPECT_EQ(7u, config.drives[0].pkw.delay);
  EXPECT_EQ(2.0, config.drives[0].inverter.automatic_acknowledgement_delay);
  RobotSim robot{config};
  EXPECT_EQ(18, robot.drive(0).parameters().value(707));
  EXPECT_EQ(nullptr, robot.drive(0).parameters().find(749));
  EXPECT_EQ(10, robot.drive(0).parameters().value(509));  // PROFIBUS, on this series
  EXPECT_EQ(4, robot.drive(1).parameters().value(546, 2, 1));
  EXPECT_EQ(4, robot.drive(1).parameters().value(509));
}

// Wrong configurations are refused in a sentence with key, value and expectation.
TEST(SimConfig, RefusesInWords) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      readSimConfig(YAML::Load(text));
      return "accepted";
    } catch (const ConfigError& error) {
      return error.what();
    }
  };
  EXPECT_EQ("drives: nothing is configured; expected a group with at least one drive", refusal("bus: {}"));
  EXPECT_EQ("drives/a/address is missing; expected a whole number from 1 to 126", refusal("drives: {a: {}}"));
  EXPECT_EQ("drives/a/address: 127 is not valid; expected a whole number from 1 to 126",
            refusal("drives: {a: {address: 127}}"));
  EXPECT_EQ("drives/b/address: 3 is not valid; expected an address of its own; drive a has it",
            refusal("drives: {a: {address: 3}, b: {address: 3}}"));
  EXPECT_EQ("drives/a/gear_ratio: 0 is not valid; expected a number greater than 0",
            refusal("drives: {a: {address: 3, gear_ratio: 0}}"));
  EXPECT_EQ("drives/a/gear_ratio: .nan is not valid; expected a number greater than 0",
            refusal("drives: {a: {address: 3, gear_ratio: .nan}}"));
  EXPECT_EQ("drives/a/ppo_type: many is not valid; expected a whole number from 1 to 4",
            refusal("drives: {a: {address: 3, ppo_type: many}}"));
  EXPECT_EQ("drives/a/inverted: 7 is not valid; expected true or false",
            refusal("drives: {a: {address: 3, inverted: 7}}"));
  EXPECT_THAT(refusal("drives: {a: {address: 3, series: sk200e}}"), testing::HasSubstr("drives/a/series: sk200e"));
  EXPECT_THAT(refusal("drives: {a/b: {address: 3}}"), testing::HasSubstr("a/b is not valid; expected a name"));
  EXPECT_EQ("drives/a/parameters/P513: -1 is not valid; expected a number from -0.1 to 100",
            refusal("drives: {a: {address: 3, parameters: {P513: -1}}}"));
  EXPECT_THAT(refusal("drives: {a: {address: 3, parameters: {P999: 1}}}"), testing::HasSubstr("P999 is no parameter"));
  EXPECT_THAT(refusal("drives: {a: {address: 3, parameters: {P105: [1, 2]}}}"), testing::HasSubstr("a list of 4"));
  EXPECT_THAT(refusal("{drives: {a: {address: 3}}, body: {left: b, right: a, wheel_radius: 1, wheel_separation: 1}}"),
              testing::HasSubstr("body/left: b is not valid"));
  EXPECT_THAT(refusal("{drives: {a: {address: 3}}, body: {left: a}}"), testing::HasSubstr("body/right is missing"));
}

}  // namespace
}  // namespace nord_driver::sim
