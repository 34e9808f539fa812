// How nord_param watch shows drives.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "tools/watch_table.h"

namespace nord_driver::tools {
namespace {

WatchedDrive left() {
  WatchedDrive drive;
  drive.name = "left";
  drive.online = true;
  drive.output.control_word = 0x047E;
  drive.output.setpoints[0] = -8192;
  drive.input.status_word = 0x0B31;
  drive.input.actual_values[0] = 4096;
  drive.frequency = 12.5;
  drive.fault = "none";
  drive.values = {"0.3 A"};
  return drive;
}

WatchedDrive right() {
  WatchedDrive drive;
  drive.name = "right";
  drive.silence = "no answer";
  drive.values = {"not read"};
  return drive;
}

TEST(WatchTable, HasAColumnForEachDrive) {
  EXPECT_EQ(
      "                left                right\n"
      "status word     0B31                does not answer: no answer\n"
      "state           ready to switch on\n"
      "parameter set   1\n"
      "control word    047E\n"
      "setpoint 1      -50.0 % (E000)\n"
      "actual value 1  25.0 % (1000)\n"
      "frequency       12.50 Hz\n"
      "fault           none\n"
      "P719 Current    0.3 A\n",
      watchTable({left(), right()}, {"P719 Current"}));
}

// Over class 2, and over DeviceNet as a guest.
TEST(WatchTable, LeavesOutProcessDataThatAreNotExchanged) {
  WatchedDrive drive = left();
  drive.process_values = 0;
  EXPECT_EQ(
      "               left\n"
      "status word    0B31\n"
      "state          ready to switch on\n"
      "parameter set  1\n"
      "fault          none\n",
      watchTable({drive}, {}));
}

TEST(WatchTable, SaysWhatIsNotKnown) {
  WatchedDrive drive = left();
  drive.frequency.reset();
  EXPECT_NE(std::string::npos, watchTable({drive}, {}).find("frequency       not known\n"));
}

// Over DeviceNet as a guest; over InterBus as one, only what is sent is not known.
TEST(WatchTable, ShowsNoProcessDataThatNobodyExchanges) {
  WatchedDrive drive = left();
  drive.commands_known = drive.words_known = false;
  drive.frequency.reset();
  EXPECT_EQ(
      "                left\n"
      "status word     not known\n"
      "state           ready to switch on\n"
      "parameter set   not known\n"
      "control word    not known\n"
      "setpoint 1      not known\n"
      "actual value 1  not known\n"
      "frequency       not known\n"
      "fault           none\n",
      watchTable({drive}, {}));
  EXPECT_EQ("    0.500 s  left  ready to switch on  SW1 not known  IW1 not known  frequency not known  fault none\n",
            watchLine(0.5, drive, {}));
  EXPECT_EQ(R"({"time": 0.5, "drive": "left", "online": true, "status_word": null, "state": "ready to switch on", )"
            R"("setpoints": [null], "actual_values": [null], "frequency": null, "fault": "none", "parameters": {}})"
            "\n",
            watchJson(0.5, drive, {}));
  drive.state_known = false;
  EXPECT_NE(std::string::npos, watchTable({drive}, {}).find("state           not known\n"));
  EXPECT_NE(std::string::npos, watchLine(0.5, drive, {}).find("left  state not known  SW1"));
  drive = left();
  drive.commands_known = false;
  EXPECT_EQ(
      "    0.500 s  left  0B31 ready to switch on  SW1 not known  IW1 25.0 % (1000)  frequency 12.50 Hz  fault none\n",
      watchLine(0.5, drive, {}));
}

TEST(WatchTable, IsALineWhereNobodyLooks) {
  EXPECT_EQ(
      "    0.500 s  left  0B31 ready to switch on  SW1 -50.0 % (E000)  IW1 25.0 % (1000)  frequency 12.50 Hz  fault "
      "none"
      "  P719 0.3 A\n",
      watchLine(0.5, left(), {"P719"}));
  EXPECT_EQ("    0.500 s  right  does not answer: no answer\n", watchLine(0.5, right(), {"P719"}));
}

TEST(WatchTable, IsAnObjectForPrograms) {
  const YAML::Node json = YAML::Load(watchJson(0.5, left(), {"P719"}));
  EXPECT_TRUE(json["online"].as<bool>());
  EXPECT_EQ(0x0B31, json["status_word"].as<int>());
  EXPECT_EQ(-50.0, json["setpoints"][0].as<double>());
  EXPECT_EQ(12.5, json["frequency"].as<double>());
  EXPECT_EQ("0.3 A", json["parameters"]["P719"].as<std::string>());
  EXPECT_FALSE(YAML::Load(watchJson(0.5, right(), {"P719"}))["online"].as<bool>());
}

}  // namespace
}  // namespace nord_driver::tools
