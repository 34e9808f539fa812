// nord_param check-config as a user runs it: on the files of config/templates, and on files that are wrong. No bus is
// opened and no ROS master asked for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tools/program.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class CheckConfig : public ::testing::Test {
 protected:
  CheckConfig() { ::setenv("ROS_MASTER_URI", "http://127.0.0.1:1", 1); }  // nobody there
  ~CheckConfig() override { ::unlink(file_.c_str()); }

  static Ended check(std::vector<std::string> words) {
    words.insert(words.begin(), {NORD_PARAM_PROGRAM, "check-config"});
    return runProgram(words);
  }
  Ended checkText(const std::string& text, std::vector<std::string> words = {}) {
    std::ofstream(file_) << text;
    words.insert(words.begin(), file_);
    return check(words);
  }

  const std::string file_ = ::testing::TempDir() + "check_config_" + std::to_string(::getpid()) + ".yaml";
};

constexpr char kConveyor[] = R"(bus: {device: /dev/ttyUSB0}
drives:
  belt: {address: 3, series: sk5xxe, joint: belt_joint, gear_ratio: 20.0, pole_pairs: 2, max_velocity: 6.0}
  door: {address: 4, series: sk5xxe, joint: door_joint, gear_ratio: 10.0, pole_pairs: 2, max_frequency: 25.0}
)";

/// What the simulator has to say of a file, which is its own, too; on a bus that nobody else has.
std::string complaintsOfTheSimulator(const std::string& file, const std::string& place) {
  std::string bus = runProgram({NORD_SIM_PROGRAM, "--config", file, "--place"}).output;
  if (bus.rfind("virtual:", 0) == 0) bus += "_" + std::to_string(::getpid());
  if (bus.rfind("/", 0) == 0) bus = place;
  if (bus.rfind("127.0.0.1:", 0) == 0) bus = "127.0.0.1:0";
  const Ended ended = runProgram({NORD_SIM_PROGRAM, "--config", file, "--bus", bus, "--duration", "0.01"});
  return ended.errors + (ended.code == 0 ? "" : "it ended with " + std::to_string(ended.code));
}

// By the same limit on each bus that knows how long its drives run on.
TEST_F(CheckConfig, WarnsOfDrivesThatRunOnForLong) {
  const std::string drive = "drives: {belt: {address: 5, series: sk2xxe, joint: a, gear_ratio: 1, pole_pairs: 2}}\n";
  const std::string device_net =
      checkText("transport: devicenet\nbus: {interface: can0, bit_rate: 500000, expected_packet_rate: 65}\n" + drive)
          .output;
  EXPECT_THAT(device_net,
              HasSubstr("warning: bus: a drive runs on for 260 s when this computer dies (DeviceNet time-out "
                        "of 260 s"));
  const std::string profibus = checkText("bus: {device: /dev/ttyUSB0, watchdog: 60}\n" + drive).output;
  EXPECT_THAT(profibus,
              HasSubstr("warning: bus: a drive runs on for 60 s when this computer dies (PROFIBUS watchdog of 60 "
                        "s)"));
  const std::string canopen = checkText(
                                  "transport: canopen\nbus: {interface: can0}\ndrives: {belt: {address: 5, series: "
                                  "sk5xxe, joint: a, gear_ratio: 1, "
                                  "pole_pairs: 2, guard_time: 1, life_time_factor: 4}}\n")
                                  .output;
  EXPECT_THAT(canopen, HasSubstr("warning: bus: a drive runs on for 4 s when this computer dies (node guarding, 4 s)"));
}

// As rosparam reads the file for the node.
TEST_F(CheckConfig, ResolvesMergeKeys) {
  const Ended merged = checkText(
      "bus: {device: /dev/ttyUSB0}\n"
      "drives:\n"
      "  belt: &drive {address: 3, series: sk5xxe, joint: belt_joint, gear_ratio: 20.0, pole_pairs: 2, max_velocity: "
      "6.0}\n"
      "  door: {<<: *drive, address: 4, joint: door_joint}\n");
  EXPECT_EQ(0, merged.code) << merged.errors;
  EXPECT_THAT(merged.output, HasSubstr("door"));
  EXPECT_THAT(merged.output + merged.errors, Not(HasSubstr("<<")));
  const Ended wrong = checkText("bus: {device: /dev/ttyUSB0}\ndrives:\n  belt: {<<: 5, address: 3}\n");
  EXPECT_EQ(1, wrong.code);
  EXPECT_THAT(wrong.output + wrong.errors,
              HasSubstr("line 3: <<: \"5\" is not valid, expected a group or a list of groups, whose keys are taken"));
}

// As every other command takes it.
TEST_F(CheckConfig, TakesTheFileByItsOption) {
  const Ended by_word = checkText(kConveyor);
  ASSERT_EQ(0, by_word.code) << by_word.errors;
  const Ended by_option = check({"--config", file_});
  EXPECT_EQ(0, by_option.code) << by_option.errors;
  EXPECT_EQ(by_word.output, by_option.output);
  const Ended none = check({});
  EXPECT_EQ(2, none.code);
  EXPECT_THAT(none.errors, HasSubstr("FILE is missing, expected the driver's YAML file, or --config with it"));
}

// What a user copies is fine as it is, and says which lines are to be changed.
TEST_F(CheckConfig, EveryTemplateIsAcceptedWithoutAWarning) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(NORD_CONFIG_FOLDER) + "/templates")) {
    SCOPED_TRACE(entry.path());
    ++files;
    const Ended ended = check({entry.path()});
    EXPECT_EQ(0, ended.code) << ended.errors;
    EXPECT_THAT(ended.output, EndsWith("\nfine\n"));
    EXPECT_THAT(ended.output, Not(HasSubstr(", no limits"))) << "every machine has its limits";
    EXPECT_EQ("", complaintsOfTheSimulator(entry.path(), file_ + "_bus"));
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_THAT(text, AllOf(HasSubstr("  # CHANGE  "), HasSubstr("nameplate"), HasSubstr("NORD CON"),
                            HasSubstr("simulate.launch")));
  }
  EXPECT_GE(files, 9u);
}

TEST_F(CheckConfig, LooksUpWhatIsToBeMonitored) {
  const std::string text = kConveyor;
  const auto with = [&](const std::string& list) {
    std::string changed = text;
    return changed.replace(changed.find("max_velocity: 6.0"), 17, "monitor: " + list);
  };
  EXPECT_EQ(0, checkText(with("[P746, \"P700[-01]\"]")).code);
  const Ended unknown = checkText(with("[P746, Nonsense]"));
  EXPECT_EQ(1, unknown.code);
  EXPECT_THAT(unknown.output, HasSubstr("drives/belt/monitor: \"Nonsense\" is not valid"));
  const Ended raw = checkText(with("[719]"));
  EXPECT_EQ(0, raw.code);
  EXPECT_THAT(raw.output, HasSubstr("drives/belt/monitor: P719 is not in the catalogue"));
}

// As the node does, which ends with the same sentence.
TEST_F(CheckConfig, ReadsTheUsersFilesOfParameters) {
  const std::string own = file_ + "_own.yaml";
  const std::string text = std::string("parameter_files: [") + own + "]\n" + kConveyor;
  std::ofstream(own) << "devices: [sk5xxe]\nparameters:\n  - {number: 105, name: Top frequency}\n";
  EXPECT_EQ(0, checkText(text).code);
  std::ofstream(own) << "devices: [sk5xxe]\nparameters:\n  - {number: 105, units: Hz}\n";
  const Ended wrong = checkText(text);
  EXPECT_EQ(1, wrong.code);
  EXPECT_THAT(wrong.output + wrong.errors,
              HasSubstr("parameter_files: " + own + ":3: number 105: units is not a key of this file"));
  ::unlink(own.c_str());
}

TEST_F(CheckConfig, DrawsWhatItUnderstood) {
  const Ended ended = check({std::string(NORD_CONFIG_FOLDER) + "/templates/skid_steer_profibus_cu4.yaml"});
  EXPECT_THAT(
      ended.output,
      EndsWith("/skid_steer_profibus_cu4.yaml\n"
               "|- bus: profibus_dp at /dev/ttyUSB0, 100 cycles/s, baud_rate 500000, master_address 1, watchdog 0.2\n"
               "|  |- PROFIBUS station 3, parameters: PKW\n"
               "|  |  |- inverter 1: front_left, sk2xxe, 2 pole pairs, gear ratio 20: 7.85 rad/s at "
               "front_left_wheel_joint\n"
               "|  |  |- inverter 2: front_right, sk2xxe, 2 pole pairs, gear ratio 20, inverted: 7.85 rad/s at "
               "front_right_wheel_joint\n"
               "|  |  |- inverter 3: rear_left, sk2xxe, 2 pole pairs, gear ratio 20: 7.85 rad/s at "
               "rear_left_wheel_joint\n"
               "|  |  `- inverter 4: rear_right, sk2xxe, 2 pole pairs, gear ratio 20, inverted: 7.85 rad/s at "
               "rear_right_wheel_joint\n"
               "|  `- when this computer dies: PROFIBUS watchdog of 0.2 s: the inverter trips E10.2 and the motor "
               "coasts\n"
               "|- base, skid steer\n"
               "|  |- left: front_left, rear_left\n"
               "|  |- right: front_right, rear_right\n"
               "|  |- wheel radius 0.1 m, separation 0.5 m x 1.5\n"
               "|  |- straight on: 0.785 m/s, limits: 0.5 m/s, 0.2 m/s^2 (64 % of what the drives can)\n"
               "|  `- on the spot: 2.09 rad/s, limits: 1 rad/s, 0.5 rad/s^2 (48 % of what the drives can)\n"
               "`- speeds are those of 100 %: with P105 = 50 Hz, as from the factory; the driver reads it from the "
               "drive\n"
               "fine\n"));
}

TEST_F(CheckConfig, SingleDrivesHaveTheirOwnLimits) {
  const Ended ended = checkText(kConveyor);
  EXPECT_EQ(0, ended.code) << ended.errors;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("belt, sk5xxe, 2 pole pairs, gear ratio 20: 7.85 rad/s at belt_joint"),
                    HasSubstr("~belt/command, limits: 6 rad/s\n"), HasSubstr("gear ratio 10: 7.85 rad/s at door_joint"),
                    HasSubstr("~door/command, no limits"), HasSubstr("no base"),
                    HasSubstr("max_frequency of door 25 Hz, else with P105 = 50 Hz")));
}

// It has no command of its own.
TEST_F(CheckConfig, AFollowerFollows) {
  const std::string text =
      "bus: {device: /dev/ttyUSB0}\n"
      "drives:\n"
      "  front: {address: 3, series: sk5xxe, joint: front_joint, pole_pairs: 2, max_velocity: 6.0}\n"
      "  rear: {address: 4, series: sk5xxe, joint: rear_joint, pole_pairs: 2, follows: front}\n";
  const Ended ended = checkText(text);
  EXPECT_EQ(0, ended.code) << ended.output;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("~front/command, limits: 6 rad/s\n"),
                    HasSubstr("rad/s at rear_joint\n|  |     `- follows front\n"), Not(HasSubstr("~rear/command"))));
  const YAML::Node drives = YAML::Load(checkText(text, {"--json"}).output)["modules"];
  EXPECT_EQ("front", drives[1]["drives"][0]["follows"].as<std::string>());
  EXPECT_FALSE(drives[0]["drives"][0]["follows"]);
  std::string limited = text;
  limited.replace(limited.find("follows:"), 0, "max_velocity: 6.0, ");
  EXPECT_THAT(checkText(limited).output,
              HasSubstr(":4: error: drives/rear/max_velocity: 6 is not valid, expected none: this drive follows"));
}

// DeviceNet's assembly 20 has no reverse: mounted the other way round, a wheel has no forward.
TEST_F(CheckConfig, WarnsOfABaseThatNeverDrivesForward) {
  const std::string text =
      "transport: devicenet\n"
      "bus: {interface: can0, bit_rate: 500000}\n"
      "left_wheel: left_joint\n"
      "right_wheel: right_joint\n"
      "wheel_separation: 0.5\n"
      "wheel_radius: 0.1\n"
      "drives:\n"
      "  left: {address: 5, series: sk2xxe, assembly: 20, joint: left_joint, gear_ratio: 20.0, pole_pairs: 2}\n"
      "  right: {address: 6, series: sk2xxe, assembly: 20, joint: right_joint, gear_ratio: 20.0, pole_pairs: 2,\n"
      "          inverted: true}\n";
  const char* const warning = "warning: drives/right/inverted: true keeps the base from ever driving forward";
  const Ended never = checkText(text);
  EXPECT_EQ(0, never.code);
  EXPECT_THAT(never.output, AllOf(HasSubstr(":10: "), HasSubstr(warning), HasSubstr("straight on: 0 m/s")));
  std::string one_way = text;
  one_way.replace(one_way.find("inverted: true"), 14, "inverted: false");
  std::string both_ways = text;
  for (int i = 0; i < 2; ++i) both_ways.replace(both_ways.find("assembly: 20"), 12, "assembly: 21");
  for (const std::string& good : {one_way, both_ways}) {
    EXPECT_THAT(checkText(good).output, AllOf(HasSubstr("straight on: 0.785 m/s"), Not(HasSubstr(warning))));
  }
}

// Accepted, it could never be enabled: the words would be asked for by turns.
TEST_F(CheckConfig, RefusesMoreFunctionsThanTheTelegramHasWords) {
  const std::string text =
      "transport: canopen\n"
      "bus: {interface: can0}\n"
      "drives:\n"
      "  lift: {address: 3, series: sk5xxe, process_values: 3, joint: lift_joint, pole_pairs: 2,\n"
      "         setpoints: {grip: {function: torque_limit}, power: {function: current_limit}},\n"
      "         signals: {horn: {source: bus_in_bit_0}}}\n";
  const Ended ended = checkText(text);
  EXPECT_EQ(1, ended.code);
  EXPECT_THAT(ended.output, HasSubstr(":4: error: drives/lift: 3 functions of setpoints are needed"));
  EXPECT_THAT(checkText(text + "read_only: true\n").output, EndsWith("\nfine\n")) << "who looks on sends none of them";
}

TEST_F(CheckConfig, NamesEveryErrorAndWarningWithItsLine) {
  const Ended ended = checkText(
      "bus:\n"
      "  device: /dev/ttyUSB0\n"
      "  baud_rat: 500000\n"
      "drives:\n"
      "  left: {address: 3, series: sk5xxe, joint: left, pole_pairs: 2}\n"
      "  right:\n"
      "    address: 4\n"
      "    series: sk5xxf\n"
      "    pole_pairs: 2\n"
      "  lift: {address: 5, series: sk5xxe}\n");
  EXPECT_EQ(1, ended.code);
  EXPECT_THAT(ended.output, AllOf(HasSubstr(file_ + ":8: error: drives/right/series: \"sk5xxf\" is not valid"),
                                  HasSubstr(file_ + ":10: error: drives/lift/pole_pairs is missing"),
                                  EndsWith("\nrefused: 2 errors\n")));
  const Ended warned = checkText("cycle_rat: 50\n" + std::string(kConveyor));
  EXPECT_EQ(0, warned.code);
  EXPECT_THAT(warned.output, AllOf(HasSubstr(file_ + ":1: warning: cycle_rat is not known and is ignored; did you mean "
                                                     "cycle_rate?\n"),
                                   EndsWith("\nfine, 1 warning\n")));
}

TEST_F(CheckConfig, WhatTheBusRefusesIsNamedBesideWhatTheBaseDoes) {
  const Ended ended =
      checkText("left_wheel: nobody\nright_wheel: belt_joint\n" + std::string(kConveyor), {"--bus", ""});
  EXPECT_EQ(1, ended.code);
  EXPECT_THAT(ended.output, HasSubstr(":1: error: left_wheel: \"nobody\" is not valid"));
  const Ended both = checkText(
      "left_wheel: nobody\nright_wheel: belt_joint\nbus: {device: /dev/ttyUSB0, baud_rate: 12345}\n"
      "drives: {belt: {address: 3, series: sk5xxe, joint: belt_joint, pole_pairs: 2}}\n");
  EXPECT_THAT(both.output, AllOf(HasSubstr(":1: error: left_wheel"), HasSubstr(":3: error: bus/baud_rate"),
                                 HasSubstr("refused: 2 errors")));
}

TEST_F(CheckConfig, TheBusOptionIsAboveAllTheFileSays) {
  const std::string text = "bus_end_point: /dev/ttyUSB1\n" + std::string(kConveyor);
  EXPECT_THAT(checkText(text).output, HasSubstr("profibus_dp at /dev/ttyUSB1,"));
  EXPECT_THAT(checkText(text, {"--bus", "/dev/ttyUSB2"}).output, HasSubstr("profibus_dp at /dev/ttyUSB2,"));
  EXPECT_THAT(checkText(text, {"--device", "/dev/ttyUSB2"}).output, HasSubstr("profibus_dp at /dev/ttyUSB2,"));
}

// What rosparam ends with, and what only it evaluates, is refused in the file as a whole, before anybody asks for the key.
TEST_F(CheckConfig, NamesAValueOfNoKindWithItsLine) {
  const Ended ended = checkText("cmd_vel_timeout: rad(pi/2)\n" + std::string(kConveyor));
  EXPECT_EQ(1, ended.code);
  EXPECT_EQ(file_ + "\n" + file_ +
                ":1: error: cmd_vel_timeout: rad(pi/2) is not valid, expected one number in the brackets: write the "
                "number\nrefused: 1 error\n",
            ended.output);
  const Ended too_long =
      checkText("cmd_vel_timeout: 0.5\nbase_frame: 2147483648\n" + std::string(kConveyor), {"--json"});
  EXPECT_EQ(1, too_long.code);
  EXPECT_EQ(2, YAML::Load(too_long.output)["errors"][0]["line"].as<int>());
  const Ended angle = checkText("cmd_vel_timeout: deg(45)\n" + std::string(kConveyor));
  EXPECT_EQ(0, angle.code) << angle.output;
}

TEST_F(CheckConfig, TellsProgramsTheSameAsJson) {
  const Ended ended = checkText(kConveyor, {"--json"});
  EXPECT_EQ(0, ended.code) << ended.errors;
  const YAML::Node json = YAML::Load(ended.output);  // JSON is YAML
  EXPECT_TRUE(json["accepted"].as<bool>());
  EXPECT_EQ("profibus_dp", json["transport"].as<std::string>());
  EXPECT_EQ("/dev/ttyUSB0", json["where"].as<std::string>());
  const YAML::Node belt = json["modules"][0]["drives"][0];
  EXPECT_EQ("belt", belt["name"].as<std::string>());
  EXPECT_NEAR(7.854, belt["max_velocity"].as<double>(), 1e-3);
  EXPECT_EQ(-6.0, belt["limits"]["min_velocity"].as<double>());
  EXPECT_EQ("velocity", belt["mode"].as<std::string>());
  EXPECT_FALSE(belt["targets"]);
  EXPECT_FALSE(json["base"]);
  const Ended refused = checkText("drives: {}\n", {"--json"});
  EXPECT_EQ(1, refused.code);
  EXPECT_FALSE(YAML::Load(refused.output)["accepted"].as<bool>());
}

constexpr const char* kLift =
    "bus: {device: /dev/ttyUSB0}\n"
    "drives:\n"
    "  lift: {address: 3, series: sk5xxe, ppo_type: 2, joint: lift_joint, pole_pairs: 2, mode: position, lead: 0.2,\n"
    "         position: {lower: -0.5}}\n";

// 1500 rpm, 0.2 m each: beside its limits in m a speed in rad/s would tell nobody what it can do.
TEST_F(CheckConfig, ThePrismaticJointOfADriveThatPositionsIsToldInMetres) {
  EXPECT_THAT(checkText(kLift).output, HasSubstr("gear ratio 1: 5 m/s at lift_joint"));
}

TEST_F(CheckConfig, TellsProgramsTheTargetsOfADriveThatPositions) {
  const Ended ended = checkText(kLift, {"--json"});
  EXPECT_EQ(0, ended.code) << ended.errors;
  const YAML::Node lift = YAML::Load(ended.output)["modules"][0]["drives"][0];
  EXPECT_EQ("position", lift["mode"].as<std::string>());
  EXPECT_NEAR(5.0, lift["max_velocity"].as<double>(), 1e-9);
  EXPECT_EQ("words", lift["targets"]["by"].as<std::string>());
  EXPECT_EQ("m", lift["targets"]["unit"].as<std::string>());
  EXPECT_EQ(-0.5, lift["targets"]["lower"].as<double>());
  EXPECT_FALSE(lift["targets"]["upper"]) << "none";
}

TEST_F(CheckConfig, AFileThatIsNoneIsWrongUsageAndOneThatIsNoYamlRefused) {
  const Ended missing = check({"/nowhere.yaml"});
  EXPECT_EQ(2, missing.code);
  EXPECT_THAT(missing.errors, HasSubstr("/nowhere.yaml: there is no such file"));
  EXPECT_THAT(runProgram({NORD_PARAM_PROGRAM, "check-config", "/tmp"}).errors,
              HasSubstr("/tmp: it is no ordinary file"));
  EXPECT_THAT(missing.output, IsEmpty());
  EXPECT_EQ(2, check({}).code);
  const Ended broken = checkText("bus: {device: /dev/ttyUSB0\ndrives: 3\n");
  EXPECT_EQ(1, broken.code);
  EXPECT_THAT(broken.output, AllOf(HasSubstr(file_ + ":2: error: "), HasSubstr("expected a readable YAML file")));
  EXPECT_THAT(checkText("transport: canopn\n").output, HasSubstr("did you mean canopen?"));
}

// The sizes that are not typed in.
TEST_F(CheckConfig, TakesTheUrdf) {
  const std::string urdf = file_ + ".urdf";
  std::ofstream(urdf)
      << "<robot name=\"r\"><link name=\"base_link\"/>"
         "<link name=\"l\"><collision><geometry><sphere radius=\"0.2\"/></geometry></collision></link>"
         "<link name=\"r\"><collision><geometry><sphere radius=\"0.2\"/></geometry></collision></link>"
         "<joint name=\"belt_joint\" type=\"continuous\"><parent link=\"base_link\"/><child link=\"l\"/>"
         "<origin xyz=\"0 0.4 0\"/><axis xyz=\"0 1 0\"/></joint>"
         "<joint name=\"door_joint\" type=\"continuous\"><parent link=\"base_link\"/><child link=\"r\"/>"
         "<origin xyz=\"0 -0.4 0\"/><axis xyz=\"0 1 0\"/></joint></robot>";
  std::string base = "left_wheel: belt_joint\nright_wheel: door_joint\n" + std::string(kConveyor);
  base.erase(base.find(", max_velocity: 6.0"), std::string(", max_velocity: 6.0").size());
  EXPECT_THAT(checkText(base).output, HasSubstr("wheel_separation is missing"));
  EXPECT_THAT(checkText(base, {"--urdf", urdf}).output, HasSubstr("wheel radius 0.2 m, separation 0.8 m"));
  EXPECT_EQ(2, checkText(base, {"--urdf", "/nowhere.urdf"}).code);
  EXPECT_THAT(checkText(base, {"--urdf", "/tmp"}).errors, HasSubstr("--urdf /tmp: it is a folder"));
  std::ofstream{urdf} << "";
  EXPECT_THAT(checkText(base, {"--urdf", urdf}).errors, HasSubstr("--urdf " + urdf + ": it is empty"));
  ::unlink(urdf.c_str());
}

}  // namespace
}  // namespace nord_driver::test
