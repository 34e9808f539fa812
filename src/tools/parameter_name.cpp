#include "tools/parameter_name.h"

#include <cstdio>
#include <regex>

#include "profile/parameter_shape.h"

namespace nord_driver::tools {

using catalogue::ParameterAddress;

namespace {

constexpr std::uint16_t kFirstInformation = 700, kLastInformation = 799;  // of the inverter
constexpr std::uint16_t kFirstOfModule = 170, kLastOfModule = 199;        // of the bus module (BU 0220 5.2)

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

ParameterAddress findParameter(const std::string& text, const catalogue::DriveCatalogue& known) {
  static const std::regex kNamed(R"(([^\[\]]*[^\[\] ])((?:\[-?[0-9]{1,2}\])?(?: set [1-4])?))");
  // What is meant as a number is judged as one.
  static const std::regex kNumbered(R"([-+]?[Pp]?[0-9].*|[Pp]|)");
  std::smatch match;
  if (std::regex_match(text, kNumbered) || !std::regex_match(text, match, kNamed)) return parseParameterName(text);
  std::string name = match[1], rest = match[2];
  // "set 3" at the end may have been taken for a part of the name.
  static const std::regex kSet(R"((.*[^ ]) +(set [1-4]))");
  if (std::smatch with_set; std::regex_match(name, with_set, kSet)) {
    rest = " " + with_set[2].str();
    name = with_set[1].str();
  }
  const catalogue::Lookup found = known.look(name);
  if (found.entry == nullptr) throw UsageError(found.error);
  return parseParameterName(std::to_string(found.entry->number) + rest);
}

std::vector<ParameterAddress> knownParameters(const catalogue::DriveCatalogue& known) {
  std::vector<ParameterAddress> all;
  for (const catalogue::ParameterEntry* entry : known.all()) {
    if (catalogue::resetsDevice(entry->number)) continue;
    const profile::ParameterShape shape = entry->shape();
    const bool array = profile::isArray(shape);
    const bool sets = profile::hasSets(shape);
    const unsigned elements = array ? entry->elements.value_or(1) : 1;
    for (unsigned element = 1; element <= elements; ++element) {
      for (unsigned set = 1; set <= (sets ? 4u : 1u); ++set) {
        ParameterAddress address;
        address.number = entry->number;
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
