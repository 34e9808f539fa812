// The driver's configuration read from files: kinds, groups, and files laid over each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "nord_driver/tools/yaml_settings.h"

namespace nord_driver::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

YamlSettings settings(const char* text) {
  return YamlSettings{"", YAML::Load(text)};
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

TEST(YamlSettings, ReadsWhatIsThereAndNothingElse) {
  const YamlSettings all = settings("{rate: 100, on: true, name: left, wheels: [a, b], bus: {baud_rate: 500000}}");
  EXPECT_EQ(100.0, all.number("rate"));
  EXPECT_EQ(100, all.integer("rate"));
  EXPECT_EQ(true, all.boolean("on"));
  EXPECT_EQ("left", all.text("name"));
  EXPECT_THAT(all.texts("wheels").value(), ElementsAre("a", "b"));
  EXPECT_THAT(all.texts("name").value(), ElementsAre("left"));
  EXPECT_EQ(500'000, all.integer("bus/baud_rate"));
  EXPECT_EQ(500'000, all.group("bus")->integer("baud_rate"));
  EXPECT_EQ("bus/baud_rate", all.group("bus")->fullName("baud_rate"));
  EXPECT_THAT(all.keys(), ElementsAre("bus", "name", "on", "rate", "wheels"));
  EXPECT_FALSE(all.has("nothing"));
  EXPECT_FALSE(all.has("name/of/nothing"));
  EXPECT_FALSE(all.number("bus/nothing"));
  EXPECT_FALSE(all.group("nothing")->has("key"));
  EXPECT_THAT(all.keys(), ElementsAre("bus", "name", "on", "rate", "wheels")) << "asking adds nothing";
}

TEST(YamlSettings, AWrongKindIsRefusedWithKeyAndExpectation) {
  const YamlSettings all = settings("{rate: fast, bus: 3}");
  EXPECT_THAT(refusal([&] { all.number("rate"); }), HasSubstr("rate: fast is not valid, expected a number"));
  EXPECT_THAT(refusal([&] { all.group("bus"); }), HasSubstr("bus: expected a group"));
}

TEST(YamlSettings, ALaterFileIsLaidOverAnEarlierOne) {
  const std::string first = std::string(::testing::TempDir()) + "nord_first.yaml";
  const std::string second = std::string(::testing::TempDir()) + "nord_second.yaml";
  std::ofstream(first) << "bus: {device: a, baud_rate: 1}\n";
  std::ofstream(second) << "bus: {device: b}\n";
  const YamlSettings all{"", readYamlFiles({first, second})};
  EXPECT_EQ("b", all.text("bus/device"));
  EXPECT_EQ(1, all.integer("bus/baud_rate"));
  std::remove(first.c_str());
  std::remove(second.c_str());
  EXPECT_THAT(refusal([&] { readYamlFiles({first}); }), HasSubstr(first));
}

}  // namespace
}  // namespace nord_driver::tools
