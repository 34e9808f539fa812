// The transport's name and the list of drives, as the node and the programs read them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/driver_settings.h"
#include "config/yaml_settings.h"

namespace nord_driver {
namespace {

YamlSettings settings(const char* text) {
  return YamlSettings{"", YAML::Load(text)};
}

TEST(DriverSettings, ATransportWithoutAPackageIsOneOfThisPackage) {
  EXPECT_EQ("nord_driver/profibus_dp", readTransportName(settings("{}")));
  EXPECT_EQ("nord_driver/canopen", readTransportName(settings("{transport: canopen}")));
  EXPECT_EQ("my_package/my_card", readTransportName(settings("{transport: my_package/my_card}")));
  EXPECT_THROW(readTransportName(settings("{transport: 3}")), ConfigError);
}

TEST(DriverSettings, DrivesAreSortedByName) {
  const auto drives = readDriveList(settings("{drives: {right: {address: 4}, left: {address: 3}}}"));
  ASSERT_EQ(2u, drives.size());
  EXPECT_EQ("left", drives[0].name);
  EXPECT_EQ(3, drives[0].settings->integer("address"));
  EXPECT_EQ("drives/right/address", drives[1].settings->fullName("address"));
  EXPECT_TRUE(readDriveList(settings("{}")).empty());
  EXPECT_THROW(readDriveList(settings("{drives: {left: 3}}")), ConfigError);
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

// A file for rosparam in the root namespace, loaded below the node's name.
TEST(DriverSettings, AFileNestedOneLevelTooDeepIsToldSo) {
  EXPECT_EQ(
      "drives is missing, but there is nord_driver/drives: the file is nested one level too deep; take the line "
      "\"nord_driver:\" away and move what is below it to the left",
      refusal([] { readDriveList(settings("{nord_driver: {bus: {}, drives: {left: {address: 3}}}, type: x}")); }));
}

TEST(DriverSettings, ATransportNobodyHasIsToldTheNearest) {
  const std::vector<std::string> declared{"nord_driver/profibus_dp", "nord_driver/canopen", "my_package/my_card"};
  EXPECT_EQ(
      "transport: \"profibus\" is not valid, expected one of the declared transports: profibus_dp, canopen, "
      "my_package/my_card; did you mean profibus_dp?",
      unknownTransport(settings("{}"), "nord_driver/profibus", declared).what() + std::string{});
  EXPECT_EQ(
      "transport: \"modem\" is not valid, expected one of the declared transports: none (is the workspace's "
      "setup file sourced?)",
      unknownTransport(settings("{}"), "nord_driver/modem", std::vector<std::string>{}).what() + std::string{});
}

}  // namespace
}  // namespace nord_driver
