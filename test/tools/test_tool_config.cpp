// What nord_param takes of the driver's configuration.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/tool_config.h"

namespace nord_driver::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kFile[] = R"(
transport: canopen
cycle_rate: 50.0
left_wheel: a
bus: {baud_rate: 500000}
drives:
  far:   {address: 9, series: sk5xxe, pole_pairs: 2}
  near:  {address: 7, inverter: 1, series: sk2xxe, pole_pairs: 2, joint: a}
  mate:  {address: 7, inverter: 2, series: sk2xxe, pole_pairs: 2}
)";

const EndPoint kDevice{"device", "serial device", "/dev/ttyUSB0"};
const EndPoint kInterface{"interface", "CAN interface", "can0"};

std::vector<std::string> namesOf(const ToolConfig& config) {
  std::vector<std::string> names;
  for (const DriveSettings& drive : config.drives) names.push_back(drive.name);
  return names;
}

template <typename Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

// Inverters behind one bus module share its telegrams; the others of the bus are not talked to.
TEST(ToolConfig, TakesTheDriveAndItsStation) {
  const YAML::Node file = YAML::Load(kFile);
  EXPECT_THAT(namesOf(readToolConfig(file, "mate")), ElementsAre("mate", "near"));
  EXPECT_THAT(namesOf(readToolConfig(file, "far")), ElementsAre("far"));
  EXPECT_THAT(namesOf(readToolConfig(file, kInterface)), ElementsAre("far", "mate", "near"));
}

// A driver asks every address at its start; a program that reads one parameter would wait for that each time.
TEST(ToolConfig, TakesNoScanOfTheBus) {
  YAML::Node file = YAML::Load(kFile);
  file["bus"]["scan"] = true;
  const ToolConfig config = readToolConfig(file, "far");
  EXPECT_FALSE(config.bus->has("scan"));
  EXPECT_EQ(500000, config.bus->integer("baud_rate"));
}

// These first, in the order they were asked for, and after them whoever shares their telegrams.
TEST(ToolConfig, TakesSeveralDrivesAndTheirStations) {
  const YAML::Node file = YAML::Load(kFile);
  const auto asked = [&file](const std::vector<std::string>& names) { return readToolConfig(file, names); };
  EXPECT_THAT(namesOf(asked({"near", "far"})), ElementsAre("near", "far", "mate"));
  EXPECT_EQ(2u, asked({"near", "far"}).asked);
  EXPECT_EQ(1u, asked({"near"}).asked);
  EXPECT_EQ("drive \"far\" is named twice", refusal([&] { asked({"far", "near", "far"}); }));
}

// Words and references in a ring follow from the places before them, whoever is asked for; no drive's words are written.
TEST(ToolConfig, TakesTheWholeInterbusRing) {
  const YAML::Node file = YAML::Load(
      "{transport: interbus, drives: {left: {address: 1, series: sk5xxe, pole_pairs: 2},"
      " right: {address: 2, series: sk5xxe, pole_pairs: 2}, lift: {address: 3, series: sk5xxe, pole_pairs: 2}}}");
  const ToolConfig right = readToolConfig(file, "right");
  EXPECT_THAT(namesOf(right), ElementsAre("right", "left", "lift"));
  EXPECT_EQ(1u, right.asked);
  EXPECT_FALSE(right.reaches_others);
  EXPECT_THAT(namesOf(readToolConfig(file, std::vector<std::string>{"right", "lift"})),
              ElementsAre("right", "lift", "left"));
  EXPECT_TRUE(readToolConfig(YAML::Load(kFile), "mate").reaches_others) << "they are behind one module";
}

// The base's sizes may be in a URDF, which is not there.
TEST(ToolConfig, NeedsNothingOfTheBase) {
  const ToolConfig config = readToolConfig(YAML::Load(kFile), "near");
  EXPECT_EQ("nord_driver/canopen", config.transport);
  EXPECT_DOUBLE_EQ(50.0, config.cycle.cycle_rate);
  EXPECT_EQ(profile::Series::kSk2xxe, config.cycle.drives.front().series);
  EXPECT_FALSE(config.cycle.base);
  EXPECT_EQ(500'000, config.bus->integer("baud_rate"));
  EXPECT_GE(config.cycle.drives.front().drive.drive_timeout, std::chrono::seconds{1});
}

// Setpoints of a drive are judged by the file's time, as the driver judges them.
TEST(ToolConfig, JudgesSetpointsByTheFilesTimeout) {
  YAML::Node file = YAML::Load(kFile);
  file["drives"]["far"]["setpoints"] = YAML::Load("{boost: {function: frequency_addition, limit: 10.0, timeout: 0.8}}");
  EXPECT_THAT(refusal([&] { readToolConfig(file, "far"); }),
              HasSubstr("drives/far/setpoints/boost/timeout: 0.8 is not valid"));
  file["cmd_vel_timeout"] = 1.0;
  EXPECT_EQ("accepted", refusal([&] { readToolConfig(file, "far"); }));
  EXPECT_EQ(std::chrono::seconds{1}, readToolConfig(file, "far").cycle.cmd_vel_timeout);
}

TEST(ToolConfig, TheTransportIsProfibusWhenNoneIsNamed) {
  YAML::Node file = YAML::Load(kFile);
  file.remove("transport");
  EXPECT_EQ("nord_driver/profibus_dp", readToolConfig(file, kDevice).transport);
}

TEST(ToolConfig, NamesWhatIsWrong) {
  YAML::Node file = YAML::Load(kFile);
  EXPECT_EQ("drive \"lift\" is not in the configuration, expected one of far, mate, near",
            refusal([&] { readToolConfig(file, "lift"); }));
  file["drives"]["far"]["series"] = "sk9";
  EXPECT_THAT(refusal([&] { readToolConfig(file, "far"); }), HasSubstr("drives/far/series"));
  EXPECT_EQ("accepted", refusal([&] { readToolConfig(file, "near"); }));
  file["transport"] = 5;
  EXPECT_THAT(refusal([&] { readToolConfig(file, "near"); }), HasSubstr("transport: 5 is not valid"));
  EXPECT_THAT(refusal([] { readToolConfig(YAML::Load("{bus: {}}"), "left"); }),
              HasSubstr("expected one that has drives"));
  EXPECT_EQ("bus: 5 is not valid, expected a group of keys and values", refusal([] {
              readToolConfig(YAML::Load("{bus: 5, drives: {left: {series: sk5xxe, pole_pairs: 2}}}"), kDevice);
            }));
  EXPECT_THAT(refusal([] { readToolConfig(YAML::Load("{drives: {2nd: {}}}"), kDevice); }),
              StartsWith("drives/2nd: \"2nd\" is not valid, expected a name of letters"));
  EXPECT_THAT(refusal([] { readToolConfig(YAML::Load("{bus: {}}"), kDevice); }), HasSubstr("drives is missing"));
}

/// `file` with this on the command line and a bus that is found there, or why not.
std::string portOf(const char* file, const BusPort& port, const EndPoint& end_point) {
  YAML::Node node = YAML::Load(file);
  try {
    choosePort(node, port, end_point);
  } catch (const UsageError& error) {
    return error.what();
  }
  return YAML::Dump(node["bus"]);
}

TEST(ToolConfig, ThePortOfTheCommandLineReplacesTheFiles) {
  EXPECT_EQ("{device: b}", portOf("bus: {device: a}", {"b", "", ""}, kDevice));
  EXPECT_EQ("{device: b}", portOf("bus: {device: a}", {"", "", "b"}, kDevice));
  EXPECT_EQ("{device: a}", portOf("bus: {device: a}", {}, kDevice));
  EXPECT_EQ("device: b", portOf("bus: ~", {"b", "", ""}, kDevice));
  EXPECT_EQ("{interface: can1}", portOf("{transport: canopen, bus: {interface: can0}}", {"", "can1", ""}, kInterface));
  EXPECT_EQ("{interface: can1}", portOf("{transport: canopen, bus: {interface: can0}}", {"", "", "can1"}, kInterface));
}

// A transport of any kind says itself where its bus is.
TEST(ToolConfig, TheBusOptionFitsEveryTransport) {
  const EndPoint gateway{"gateway", "Modbus/TCP server", "192.168.0.10:502"};
  EXPECT_EQ("{gateway: 10.0.0.1:502}",
            portOf("{transport: a/b, bus: {gateway: x}}", {"", "", "10.0.0.1:502"}, gateway));
  EXPECT_EQ("gateway: y", portOf("{transport: a/b, bus_end_point: y}", {}, gateway));
  EXPECT_EQ("gateway: z", portOf("{transport: a/b, bus_end_point: y}", {"", "", "z"}, gateway));
}

// Else a write would go to another inverter than the one on the bus of the command line.
TEST(ToolConfig, TheBusOptionReplacesASecondWayToTheBusThatThereIs) {
  const EndPoint gateway{"gateway", "Modbus/TCP server", "192.168.0.10:502", "diagnosis"};
  const char* const file = "{transport: a/b, bus: {gateway: x, diagnosis: x}}";
  EXPECT_EQ("{gateway: z, diagnosis: z}", portOf(file, {"", "", "z"}, gateway));
  EXPECT_EQ("{gateway: x, diagnosis: x}", portOf(file, {}, gateway));
  EXPECT_EQ("{gateway: x, diagnosis: y}",
            portOf("{transport: a/b, bus: {gateway: x, diagnosis: y}}", {"", "", "x"}, gateway))
      << "the bus of the file";
  EXPECT_EQ("{gateway: z}", portOf("{transport: a/b, bus: {gateway: x}}", {"", "", "z"}, gateway));
}

// The node's reader, which check-config runs, puts bus_end_point above the key of the bus.
TEST(ToolConfig, ThePortOfTheCommandLineReplacesTheFilesBusEndPoint) {
  const auto chosen = [](const char* file, const BusPort& port) {
    YAML::Node node = YAML::Load(file);
    choosePort(node, port, kDevice);
    return node["bus_end_point"] ? node["bus_end_point"].Scalar() : "absent";
  };
  EXPECT_EQ("b", chosen("{bus_end_point: a, bus: {device: c}}", {"", "", "b"}));
  EXPECT_EQ("b", chosen("bus_end_point: a", {"b", "", ""}));
  EXPECT_EQ("a", chosen("bus_end_point: a", {}));
  EXPECT_EQ("absent", chosen("bus: {device: a}", {"", "", "b"})) << "the file has no such key";
  EXPECT_EQ("bus_end_point: 5 is not valid, expected a text", refusal([&] {
              chosen("bus_end_point: 5", {"", "", "b"});
            }));
}

// What would be ignored looks taken.
TEST(ToolConfig, ThePortOfAnotherTransportIsRefused) {
  EXPECT_EQ("--device does not fit the transport canopen, expected --interface",
            portOf("{transport: canopen, bus: {interface: can0}}", {"/dev/ttyUSB0", "", ""}, kInterface));
  EXPECT_EQ("--device does not fit the transport canopen, expected --interface",
            portOf("transport: nord_driver/canopen", {"/dev/ttyUSB0", "can0", ""}, kInterface));
  EXPECT_EQ("--interface does not fit the transport profibus_dp, expected --device",
            portOf("bus: {device: a}", {"", "can0", ""}, kDevice));
  EXPECT_EQ("--bus and --device both say where the bus is, expected one of them",
            portOf("bus: {device: a}", {"b", "", "c"}, kDevice));
  EXPECT_EQ("--device does not fit the transport my_package/my_card, expected --bus",
            portOf("transport: my_package/my_card", {"a", "", ""}, {"card", "card", "1"}));
  EXPECT_EQ("--bus does not fit the transport my_package/my_card, expected none: it opens nothing",
            portOf("transport: my_package/my_card", {"", "", "a"}, {}));
}

// To look at the drives nothing is opened, so that what would be opened need not be known.
TEST(ToolConfig, ToLookAtThemTheDrivesNeedNoPort) {
  YAML::Node file = YAML::Load(kFile);
  EXPECT_EQ("can0", readToolConfig(file, kInterface).bus->text("interface"));
  EXPECT_FALSE(readToolConfig(file, "far").bus->has("interface"));
  EXPECT_TRUE(readToolConfig(file, kDevice).bus->has("device"));
  file["bus"]["device"] = "a";
  EXPECT_EQ("a", readToolConfig(file, kDevice).bus->text("device"));
  EXPECT_THAT(readToolConfig(file, EndPoint{}).bus->keys(), ElementsAre("baud_rate", "device"));
}

}  // namespace
}  // namespace nord_driver::tools
