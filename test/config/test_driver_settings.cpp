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

}  // namespace
}  // namespace nord_driver
