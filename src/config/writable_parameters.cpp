#include "config/writable_parameters.h"

#include <cstdlib>

#include "config/setting_checks.h"
#include "config/setting_note.h"

namespace nord_driver {

namespace {

constexpr const char* kKey = "writable_parameters";
constexpr long kLastNumber = 999;  // P999; what is above are PNU of PROFIdrive and a module's own

}  // namespace

std::string WritableParameters::refusal(std::uint16_t number) const {
  if (allows(number)) return "";
  std::string allowed;
  for (const std::uint16_t each : *numbers_) allowed += (allowed.empty() ? "P" : ", P") + std::to_string(each);
  return "P" + std::to_string(number) + " may not be written: writable_parameters allows " +
         (allowed.empty() ? "none" : allowed);
}

WritableParameters readWritableParameters(const TreeSettings& settings) {
  noteSetting(settings, kKey, {"a list of parameter numbers", "", "", ""});
  const auto words = settings.words(kKey);
  if (!words) return {};
  std::set<std::uint16_t> numbers;
  for (const std::string& word : *words) {
    const std::string digits = !word.empty() && (word[0] == 'P' || word[0] == 'p') ? word.substr(1) : word;
    const long number = std::strtol(digits.c_str(), nullptr, 10);
    const bool only_digits = !digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos;
    if (!only_digits || number < 1 || number > kLastNumber) {
      throw wrongSetting(settings, kKey, "\"" + word + "\"", "numbers of parameters, 102 or P102, up to P999");
    }
    numbers.insert(static_cast<std::uint16_t>(number));
  }
  return WritableParameters{std::move(numbers)};
}

}  // namespace nord_driver
