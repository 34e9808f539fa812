// What a configuration says of EEPROM writes.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "config/eeprom_settings.h"
#include "config/yaml_settings.h"

namespace nord_driver {
namespace {

EepromSettings read(const std::string& text) {
  const YAML::Node file = YAML::Load(text);
  return readEepromSettings(YamlSettings{"", file});
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(EepromSettings, HaveABudgetWhereNothingIsSaid) {
  EXPECT_EQ(1000u, read("{}").budget);
  EXPECT_EQ("", read("{}").state_file);
}

TEST(EepromSettings, TakeBudgetAndFile) {
  const EepromSettings eeprom = read("{eeprom_budget: 0, eeprom_state_file: /var/lib/robot/eeprom.yaml}");
  EXPECT_EQ(0u, eeprom.budget);
  EXPECT_EQ("/var/lib/robot/eeprom.yaml", eeprom.state_file);
}

TEST(EepromSettings, RefuseWhatMeansNothing) {
  EXPECT_NE("", refusal("{eeprom_budget: -1}"));
  EXPECT_NE("", refusal("{eeprom_budget: 100001}"));
  for (const char* file : {"counts.yaml", "~/counts.yaml", "/var/lib/robot/"}) {
    EXPECT_EQ("eeprom_state_file: \"" + std::string(file) +
                  "\" is not valid, expected the absolute path of a file: programs are started in different folders",
              refusal("{eeprom_state_file: " + std::string(file) + "}"));
  }
}

}  // namespace
}  // namespace nord_driver
