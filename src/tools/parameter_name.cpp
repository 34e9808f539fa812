#include "tools/parameter_name.h"

#include <cstdio>
#include <cstdlib>
#include <regex>

#include "profile/parameter_shape.h"

namespace nord_driver::tools {

using cycle::ParameterAddress;

namespace {

constexpr std::uint16_t kLastNumber = 999;
constexpr std::uint16_t kFirstInformation = 700, kLastInformation = 799;  // of the inverter
constexpr std::uint16_t kFirstOfModule = 170, kLastOfModule = 199;        // of the bus module (BU 0220 5.2)

// P152 and PNU 970 reset the inverter to its factory settings: no list of values has them, whatever a catalogue grows.
constexpr bool resets(std::uint16_t number) noexcept {
  return number == 152 || number == 970;
}

std::uint8_t small(const std::ssub_match& digits) {
  return digits.matched ? static_cast<std::uint8_t>(std::stoul(digits.str())) : std::uint8_t{0};
}

}  // namespace

ParameterAddress parseParameterName(const std::string& name) {
  static const std::regex kName(R"([Pp]?([0-9]{1,3})(?:\[-?([0-9]{1,2})\])?(?: set ([1-4]))?)");
  std::smatch match;
  if (!std::regex_match(name, match, kName)) {
    throw UsageError("\"" + name + "\" is no parameter, expected the manual's number: 105, P105 or P700[-01]");
  }
  ParameterAddress address;
  address.number = static_cast<std::uint16_t>(std::stoul(match[1].str()));
  address.index = small(match[2]);
  address.parameter_set = small(match[3]);
  if (match[2].matched && address.index == 0) {
    throw UsageError("\"" + name + "\": array elements are counted from [-01]; where a manual prints [0], too");
  }
  return address;
}

std::string parameterName(const ParameterAddress& address) {
  char text[32];
  std::snprintf(text, sizeof text, "P%03u", address.number);
  std::string name = text;
  if (address.index != 0) {
    std::snprintf(text, sizeof text, "[-%02u]", address.index);
    name += text;
  }
  if (address.parameter_set != 0) name += " set " + std::to_string(address.parameter_set);
  return name;
}

double parseValue(const std::string& text) {
  static const std::regex kNumber(R"([-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]{1,3})?)");
  if (!std::regex_match(text, kNumber)) throw UsageError("\"" + text + "\" is no number");
  return std::strtod(text.c_str(), nullptr);
}

std::vector<ParameterAddress> knownParameters(profile::Series series) {
  std::vector<ParameterAddress> all;
  for (std::uint16_t number = 0; number <= kLastNumber; ++number) {
    const profile::ParameterInfo* info = profile::findParameter(number, series);
    if (info == nullptr || resets(number)) continue;
    const bool array = profile::isArray(info->shape);
    const bool sets = profile::hasSets(info->shape);
    const int elements = array ? info->elements : 1;
    for (int element = 1; element <= elements; ++element) {
      for (int set = 1; set <= (sets ? 4 : 1); ++set) {
        ParameterAddress address;
        address.number = number;
        address.index = static_cast<std::uint8_t>(array ? element : 0);
        address.parameter_set = static_cast<std::uint8_t>(sets ? set : 0);
        all.push_back(address);
      }
    }
  }
  return all;
}

bool isSetting(const ParameterAddress& address) noexcept {
  const bool of_module = address.number >= kFirstOfModule && address.number <= kLastOfModule;
  return !of_module && (address.number < kFirstInformation || address.number > kLastInformation);
}

}  // namespace nord_driver::tools
