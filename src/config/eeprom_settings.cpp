#include "config/eeprom_settings.h"

#include "config/setting_checks.h"

namespace nord_driver {

namespace {

constexpr std::int64_t kEndurance = 100'000;  // of an EEPROM, in all its life (BU 0020 7.5, BU 2700 6.5)

}  // namespace

EepromSettings readEepromSettings(const Settings& settings) {
  EepromSettings eeprom;
  eeprom.budget = static_cast<std::uint32_t>(integerOr(settings, "eeprom_budget", eeprom.budget, 0, kEndurance));
  eeprom.state_file = textOr(settings, "eeprom_state_file", "");
  if (!eeprom.state_file.empty() && (eeprom.state_file.front() != '/' || eeprom.state_file.back() == '/')) {
    throw wrongSetting(settings, "eeprom_state_file", "\"" + eeprom.state_file + "\"",
                       "the absolute path of a file: programs are started in different folders");
  }
  return eeprom;
}

}  // namespace nord_driver
