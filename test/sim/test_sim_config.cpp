#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "sim/canopen/can_config.h"
#include "sim/profibus/dp_stations.h"
#include "sim/sim_config.h"

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
  EXPECT_EQ("/tmp/x", config.bus.as<DpBusConfig>().device);
  EXPECT_EQ(93750u, config.bus.as<DpBusConfig>().baud_rate);
  ASSERT_EQ(2u, config.drives.size());
  EXPECT_EQ("left", config.drives[0].name);
  EXPECT_EQ(4, config.drives[1].address);
  EXPECT_TRUE(config.drives[1].inverted);
  EXPECT_EQ(3.0, config.drives[1].motor.slip);
  ASSERT_TRUE(config.body.has_value());
  EXPECT_EQ(std::vector<std::size_t>{0}, config.body->left);
  EXPECT_EQ(std::vector<std::size_t>{1}, config.body->right);
  EXPECT_TRUE(config.warnings.empty());

  RobotSim robot{config};
  DpStations stations{robot};
  EXPECT_EQ(700, robot.drive(0).parameters().value(105, 3));
  EXPECT_EQ(800, robot.drive(1).parameters().value(105, 3));
  EXPECT_EQ(500, robot.drive(1).parameters().value(105, 0));
  EXPECT_EQ(-1, robot.drive(1).parameters().value(513));
  EXPECT_EQ(0u, robot.drive(1).parameters().eepromWrites());
}

// As the driver reads it: x stands for any figure of the type, and a whole number may be written as a fraction.
TEST(SimConfig, TakesTheDriversWaysOfWriting) {
  const auto series = [](const std::string& written) {
    return readSimConfig(YAML::Load("drives: {a: {address: 3, series: " + written + "}}")).drives[0].device.series;
  };
  for (const char* written : {"SK 53xE", "sk5x5e", "SK 500E", "sk5xxe"}) EXPECT_EQ(Series::kSk5xxe, series(written));
  for (const char* written : {"SK 20xE", "sk2x5e", "SK 235E-750-340-A"}) EXPECT_EQ(Series::kSk2xxe, series(written));
  for (const char* written : {"SK 54xE", "sk545e"}) EXPECT_EQ(Series::kSk54xe, series(written));
  for (const char* written : {"SK 180E", "sk1x0e"}) EXPECT_EQ(Series::kSk1x0e, series(written));
  EXPECT_THROW(series("SK 55xE"), ConfigError);
  EXPECT_THROW(series("SK x00E"), ConfigError);

  const SimConfig config = readSimConfig(
      YAML::Load("{transport: canopen, bus: {bit_rate: 500000.0}, drives: {a: {address: 3.0, series: sk5xxe,"
                 " vendor_id: 4294967295.0, product_code: 0x4E, device_type: 4294967295}}}"));
  EXPECT_EQ(500000u, config.bus.as<CanBusConfig>().bit_rate);
  EXPECT_EQ(3, config.drives[0].address);
  const CanDriveConfig& can = config.drives[0].bus.as<CanDriveConfig>();
  EXPECT_EQ(4294967295u, can.identity.vendor);
  EXPECT_EQ(0x4Eu, can.identity.product);
  EXPECT_EQ(4294967295u, can.device_type.value_or(0));
  for (const char* wrong : {"4294967296.0", "2.5", ".nan", ".inf", "x", "[3]"}) {
    EXPECT_THROW(readSimConfig(YAML::Load(std::string("{transport: canopen, drives: {a: {address: 3, vendor_id: ") +
                                          wrong + "}}}")),
                 ConfigError)
        << wrong;
  }
  EXPECT_THROW(readSimConfig(YAML::Load("drives: {a: {address: 3.5}}")), ConfigError);
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

// One file serves driver and simulator: what only the driver uses is no slip.
TEST(SimConfig, KnowsTheKeysOfTheDriver) {
  const SimConfig config = readSimConfig(
      YAML::Load("drives: {a: {address: 3, monitor: [P719, P728], gsd: a.gsd, user_parameters: 80}, b: {address: 4, "
                 "follows: a}}"));
  EXPECT_THAT(config.warnings, testing::IsEmpty());
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
  DpStations stations{robot};
  EXPECT_EQ(18, robot.drive(0).parameters().value(707));
  EXPECT_EQ(nullptr, robot.drive(0).parameters().find(749));
  EXPECT_EQ(10, robot.drive(0).parameters().value(509));  // PROFIBUS, on this series
  EXPECT_EQ(4, robot.drive(1).parameters().value(546, 2, 1));
  EXPECT_EQ(4, robot.drive(1).parameters().value(509));
}

// Four drives move a mecanum body; without `body` the driver's own keys say the same.
TEST(SimConfig, ReadsAMecanumBody) {
  const std::string drives =
      "drives: {fl: {address: 3, joint: a}, rl: {address: 4, joint: b}, fr: {address: 5, joint: c}, rr: {address: 6, "
      "joint: d}}, ";
  for (const char* body : {"body: {kind: mecanum, left: [fl, rl], right: [fr, rr], wheel_radius: 0.1, "
                           "wheel_separation: 0.5, wheel_base: 0.7}",
                           "base_type: mecanum, left_wheel: [a, b], right_wheel: [c, d], wheel_radius: 0.1, "
                           "wheel_separation: 0.5, wheel_base: 0.7"}) {
    const SimConfig config = readSimConfig(YAML::Load("{" + drives + body + "}"));
    ASSERT_TRUE(config.body.has_value()) << body;
    EXPECT_EQ(BodyKind::kMecanum, config.body->kind);
    RobotSim robot{config};
    DpStations stations{robot};
    ASSERT_NE(nullptr, robot.body());
    // Front right and rear left forward, the other two backward, by their terminals: to the left.
    Instant now{seconds(1.0)};
    robot.advance(now);
    for (std::size_t i = 0; i < 4; ++i) robot.drive(i).inverter().setLocalControl(true, 0.0);
    robot.advance(now += std::chrono::milliseconds(500));  // charged, and ready to switch on
    for (const auto& [drive, hertz] : {std::pair{0, -10.0}, {1, 10.0}, {2, 10.0}, {3, -10.0}}) {
      robot.drive(static_cast<std::size_t>(drive)).inverter().setLocalControl(true, hertz);
    }
    robot.advance(now += seconds(2.0));
    EXPECT_GT(robot.body()->pose().y, 1.0);
    EXPECT_NEAR(0.0, robot.body()->pose().x, 1e-9);
    EXPECT_NEAR(0.0, robot.body()->pose().theta, 1e-9);
    // 10 Hz, two pole pairs, 0.1 m: 3.14 m/s without slip.
    EXPECT_GT(robot.body()->lateral(), 3.0);
    EXPECT_LT(robot.body()->lateral(), 3.14);
  }
}

// Where the bus is can be said for every kind of bus, in the file and by who reads it; the latter wins.
TEST(SimConfig, ReadsTheEndPointOfAnyBus) {
  const YAML::Node profibus = YAML::Load("{bus_end_point: /tmp/a, bus: {device: /tmp/x}, drives: {a: {address: 3}}}");
  EXPECT_EQ("/tmp/a", readSimConfig(profibus).bus.as<DpBusConfig>().device);
  EXPECT_EQ("/tmp/b", readSimConfig(profibus, "/tmp/b").bus.as<DpBusConfig>().device);
  EXPECT_EQ("/tmp/x", profibus["bus"]["device"].as<std::string>()) << "not touched";
  const YAML::Node canopen = YAML::Load("{transport: nord_driver/canopen, drives: {a: {address: 3}}}");
  EXPECT_EQ("virtual:nord_sim", readSimConfig(canopen).bus.as<CanBusConfig>().interface);
  EXPECT_EQ("can1", readSimConfig(canopen, "can1").bus.as<CanBusConfig>().interface);
}

// Drives behind one module share its address and differ in their place; what the module has is a group of its own.
TEST(SimConfig, ReadsModulesWithSlots) {
  const SimConfig config = readSimConfig(YAML::Load(
      "{bus: {baud_rate: 93750}, drives: {a: {address: 5, module: sk_cu4, inverter: 1, series: sk2xxe, ppo_type: 2}, "
      "b: {address: 5, module: sk_cu4, inverter: 3, series: sk2xxe, io_byte: true}, c: {address: 6, series: sk5xxe, "
      "module: sk_tu4}, d: {address: 7}, e: {address: 8, series: sk1x0e}}, modules: {front: {address: 6, inputs: 5, "
      "record_polls: 4, record_busy: 3, record_by_slot: true, record_plain_numbers: true, class2_connections: 2, "
      "parameters: {P151: 500}}}}"));
  EXPECT_TRUE(config.warnings.empty()) << config.warnings.front();
  RobotSim robot{config};
  DpStations stations{robot};
  ASSERT_EQ(3u, stations.modules().size());
  EXPECT_EQ(5, stations.module(0).address());
  EXPECT_EQ(Supply::kOwn, robot.drive(0).module().supply());
  EXPECT_EQ(Supply::kInverter, robot.drive(3).module().supply());
  EXPECT_EQ(&robot.drive(0).module(), &robot.drive(1).module());
  EXPECT_EQ(500, stations.module(1).parameters().value(151));
  EXPECT_EQ(6, stations.module(1).parameters().value(181));  // 93.75 kbit/s
  EXPECT_EQ(4u, stations.module(1).recordSettings().polls);
  EXPECT_EQ(3u, stations.module(1).recordSettings().busy);
  EXPECT_EQ(2u, stations.module(1).connections().settings().connections);
  EXPECT_TRUE(stations.module(1).recordSettings().by_slot);
  EXPECT_TRUE(stations.module(1).recordSettings().plain_numbers);
  // The control word comes over the system bus: P509 = 3, of an SK 5xxE 6 (BU 2700 7.2).
  EXPECT_EQ(3, robot.drive(0).parameters().value(509));
  EXPECT_EQ(6, robot.drive(2).parameters().value(509));
  EXPECT_EQ(4, robot.drive(3).parameters().value(509));
  EXPECT_EQ(3, robot.drive(4).parameters().value(509));
}

// A steered body by its own keys, and by those of the driver.
TEST(SimConfig, SteeredBody) {
  const auto bodyOf = [](const std::string& more) {
    return readSimConfig(YAML::Load("{drives: {fw: {address: 3, joint: fwj}, fs: {address: 4, joint: fsj}, "
                                    "rw: {address: 5, joint: rwj}, rs: {address: 6, joint: rsj}}, " +
                                    more + "}"))
        .body;
  };
  const auto own = bodyOf(
      "body: {kind: steered, wheel_radius: 0.1, front: {wheel: fw, steering: fs, x: 0.4, y: 0.1}, "
      "rear: {wheel: rw, steering: rs, x: -0.4}}");
  const auto of_driver = bodyOf(
      "base_type: steered, wheel_radius: 0.1, steered: {front: {wheel_joint: fwj, "
      "steering_joint: fsj, x: 0.4, y: 0.1}, rear: {wheel_joint: rwj, steering_joint: rsj, "
      "x: -0.4}, angle_tolerance: 0.05}");
  for (const auto& body : {own, of_driver}) {
    ASSERT_TRUE(body);
    EXPECT_EQ(BodyKind::kSteered, body->kind);
    EXPECT_EQ(0u, body->front.wheel);
    EXPECT_EQ(1u, body->front.steering);
    EXPECT_EQ(2u, body->rear.wheel);
    EXPECT_EQ(3u, body->rear.steering);
    EXPECT_EQ(0.4, body->front.x);
    EXPECT_EQ(0.1, body->front.y);
    EXPECT_EQ(-0.4, body->rear.x);
    EXPECT_EQ(0.1, body->wheel_radius);
  }
  EXPECT_FALSE(bodyOf("base_type: steered, steered: {front: {wheel_joint: fwj}}"));
}

TEST(SimConfig, ReadsAnEncoderAndItsAssumptions) {
  const SimConfig config = readSimConfig(YAML::Load(
      "drives: {lift: {address: 3, posicon: {encoder: incremental, position: 1.5, reference_switch: -2, "
      "reference_speed: 3.5, increments: 4096, older_increments: 1024, array_from_zero: true, torn_words: true, "
      "slip_fault: 146, functions: {reference_run: 1, reference_point: 2, teach_in: 3, quit_teach_in: 4, "
      "first_array_bit: 5, reset_position: 6, referenced: 7, position_reached: 8}}}}"));
  const PosiconSettings& posicon = config.drives[0].inverter.posicon;
  EXPECT_EQ(EncoderKind::kIncremental, posicon.encoder);
  EXPECT_EQ(1.5, posicon.position);
  EXPECT_EQ(-2.0, posicon.reference_switch);
  EXPECT_EQ(3.5, posicon.reference_speed);
  EXPECT_EQ(4096.0, posicon.increments);
  EXPECT_EQ(1024.0, posicon.older_increments);
  EXPECT_TRUE(posicon.array_from_zero);
  EXPECT_TRUE(posicon.torn_words);
  EXPECT_EQ(146, posicon.slip_fault);
  const PosiconInputs& inputs = posicon.inputs;
  EXPECT_EQ((std::vector<std::int32_t>{1, 2, 3, 4, 5, 6}),
            (std::vector<std::int32_t>{inputs.reference_run, inputs.reference_point, inputs.teach_in,
                                       inputs.quit_teach_in, inputs.first_array_bit, inputs.reset_position}));
  EXPECT_EQ(7, posicon.outputs.referenced);
  EXPECT_EQ(8, posicon.outputs.position_reached);
  EXPECT_TRUE(config.warnings.empty());
}

TEST(SimConfig, WarnsAboutUnknownKeysOfAnEncoder) {
  const SimConfig config =
      readSimConfig(YAML::Load("drives: {lift: {address: 3, posicon: {offset: 1, functions: {hom: 3}}}}"));
  EXPECT_THAT(config.warnings,
              testing::UnorderedElementsAre("drives/lift/posicon/offset is not known to the simulator and not used",
                                            "drives/lift/posicon/functions/hom is not known to the simulator and not "
                                            "used"));
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
  EXPECT_EQ("drives/a/posicon/encoder: resolver is not valid; expected absolute or incremental",
            refusal("drives: {a: {address: 3, posicon: {encoder: resolver}}}"));
  EXPECT_EQ("drives/a/posicon/position: 50001 is not valid; expected revolutions from -50000 to 50000",
            refusal("drives: {a: {address: 3, posicon: {position: 50001}}}"));
  EXPECT_EQ("drives/a/posicon/reference_speed: 0 is not valid; expected Hz, negative to the left, not 0",
            refusal("drives: {a: {address: 3, posicon: {reference_speed: 0}}}"));
  EXPECT_EQ("drives/a/posicon/functions/teach_in: -1 is not valid; expected a whole number from 0 to 255",
            refusal("drives: {a: {address: 3, posicon: {functions: {teach_in: -1}}}}"));
  EXPECT_THAT(refusal("drives: {a: {address: 3, series: sk800e}}"), testing::HasSubstr("drives/a/series: sk800e"));
  EXPECT_EQ("accepted", refusal("drives: {a: {address: 3, series: SK 205E-550-340}}")) << "as on the nameplate";
  EXPECT_THAT(refusal("drives: {a/b: {address: 3}}"), testing::HasSubstr("a/b is not valid; expected a name"));
  EXPECT_EQ("drives/a/parameters/P513: -1 is not valid; expected a number from -0.1 to 100",
            refusal("drives: {a: {address: 3, parameters: {P513: -1}}}"));
  EXPECT_THAT(refusal("drives: {a: {address: 3, parameters: {P999: 1}}}"), testing::HasSubstr("P999 is no parameter"));
  EXPECT_THAT(refusal("drives: {a: {address: 3, parameters: {P105: [1, 2]}}}"), testing::HasSubstr("a list of 4"));
  EXPECT_THAT(refusal("{drives: {a: {address: 3}}, body: {left: b, right: a, wheel_radius: 1, wheel_separation: 1}}"),
              testing::HasSubstr("body/left: b is not valid"));
  EXPECT_THAT(refusal("{drives: {a: {address: 3}}, body: {left: a}}"), testing::HasSubstr("body/right is missing"));
  EXPECT_THAT(refusal("{drives: {a: {address: 3}}, body: {kind: mecanum, left: a, right: a, wheel_radius: 1, "
                      "wheel_separation: 1}}"),
              testing::HasSubstr("body/wheel_base is missing"));
  EXPECT_THAT(refusal("{drives: {a: {address: 3}}, body: {kind: mecanum, left: a, right: a, wheel_radius: 1, "
                      "wheel_separation: 1, wheel_base: 1}}"),
              testing::HasSubstr("body/left: a is not valid; expected two of them"));
  EXPECT_THAT(refusal("{drives: {a: {address: 3}}, body: {kind: tricycle}}"),
              testing::HasSubstr("body/kind: tricycle is not valid; expected differential, mecanum or steered"));
  const std::string four = "drives: {a: {address: 3}, b: {address: 4}, c: {address: 5}, d: {address: 6}}, ";
  EXPECT_THAT(refusal("{" + four + "body: {kind: steered, wheel_radius: 0.1, front: {wheel: a, steering: b, x: 1}}}"),
              testing::HasSubstr("body: something is missing; a steered one has wheel_radius, front and rear"));
  EXPECT_THAT(refusal("{" + four +
                      "body: {kind: steered, wheel_radius: 0.1, front: {wheel: a, steering: e, x: 1}, "
                      "rear: {wheel: c, steering: d, x: -1}}}"),
              testing::HasSubstr("body/front/steering: e is not valid; expected the name of a drive"));
  EXPECT_THAT(refusal("{" + four +
                      "body: {kind: steered, wheel_radius: 0.1, front: {wheel: a, steering: b, x: 1}, "
                      "rear: {wheel: c, steering: d, x: 1}}}"),
              testing::HasSubstr("body/rear: {wheel: c, steering: d, x: 1} is not valid; expected another place"));
  EXPECT_EQ("drives/b/inverter: 1 is not valid; expected another one, drive a has it behind this module",
            refusal("drives: {a: {address: 3, series: sk2xxe}, b: {address: 3, series: sk2xxe}}"));
  EXPECT_EQ("drives/b/address: 3 is not valid; expected an address of its own; drive a has it",
            refusal("drives: {a: {address: 3, series: sk2xxe}, b: {address: 3}}"));
  EXPECT_EQ("drives/a/inverter: 5 is not valid; expected a whole number from 1 to 4",
            refusal("drives: {a: {address: 3, series: sk2xxe, inverter: 5}}"));
  EXPECT_EQ("drives/a/module: sk_tu3 is not valid; expected sk_cu4 or sk_tu4, the ones for this series",
            refusal("drives: {a: {address: 3, series: sk2xxe, module: sk_tu3}}"));
  EXPECT_EQ("drives/a/module: sk_tu4 is not valid; expected sk_tu1 or sk_tu2, the ones for this series",
            refusal("drives: {a: {address: 3, series: sk700e, module: sk_tu4}}"));
  EXPECT_THAT(refusal("{drives: {a: {address: 3}}, modules: {m: {address: 3}}}"),
              testing::HasSubstr("modules/m/address: 3 is not valid"));
  EXPECT_THAT(refusal("{drives: {a: {address: 3, series: sk2xxe}}, modules: {m: {address: 3, parameters: {P102: 1}}}}"),
              testing::HasSubstr("P102 is no parameter of the simulated module"));
}

}  // namespace
}  // namespace nord_driver::sim
