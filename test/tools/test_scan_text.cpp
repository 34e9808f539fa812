// How nord_param scan tells who is on a bus.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "tools/scan_text.h"

namespace nord_driver::tools {
namespace {

ScanReport report() {
  ScanReport report;
  report.bus = "PROFIBUS";
  report.number_name = "station";
  report.stations = {{3, "SK TU1/2/3-PBR (7531h)", "sk5xxe", "", "parameterised by master 1"},
                     {126, "SK CU4/TU4-PBR (0BA8h)", "", "V1.3", ""}};
  return report;
}

TEST(ScanText, IsATable) {
  EXPECT_EQ(
      "PROFIBUS:\n"
      "  station  module                  series  version\n"
      "  3        SK TU1/2/3-PBR (7531h)  sk5xxe           parameterised by master 1\n"
      "  126      SK CU4/TU4-PBR (0BA8h)          V1.3\n",
      scanText(report()));
}

TEST(ScanText, SaysThatNobodyAnswered) {
  ScanReport nobody = report();
  nobody.stations.clear();
  EXPECT_EQ("PROFIBUS: nobody answered\n", scanText(nobody));
  nobody.trouble = "no such device";
  EXPECT_EQ("", scanText(nobody)) << "that is told as trouble";
}

TEST(ScanText, IsAnObjectForPrograms) {
  const YAML::Node json = YAML::Load(scanJson(report()));
  EXPECT_EQ("PROFIBUS", json["bus"].as<std::string>());
  EXPECT_EQ(126, json["stations"][1]["address"].as<int>());
  EXPECT_EQ("parameterised by master 1", json["stations"][0]["note"].as<std::string>());
  EXPECT_EQ("", json["trouble"].as<std::string>());
}

}  // namespace
}  // namespace nord_driver::tools
