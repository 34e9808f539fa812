#include "config/yaml_number.h"

#include <cstdio>
#include <regex>

namespace nord_driver {
namespace {

constexpr std::size_t kLongest = 1000;  // characters: std::regex takes stack for each of them

}  // namespace

bool isYamlInteger(const std::string& text) {
  static const std::regex kIntegers("[-+]?(0[0-7]*|[1-9][0-9]*|0x[0-9a-fA-F]+)");
  return text.size() <= kLongest && std::regex_match(text, kIntegers);
}

bool isYamlFraction(const std::string& text) {
  static const std::regex kFractions(R"([-+]?[0-9]+\.[0-9]*([eE][-+][0-9]+)?|\.[0-9]+([eE][-+][0-9]+)?)");
  return text.size() <= kLongest && std::regex_match(text, kFractions);
}

std::string yamlNumber(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.15g", value);
  std::string number = text;
  const std::size_t exponent = number.find('e');
  if (exponent != std::string::npos && number.find('.') == std::string::npos) number.insert(exponent, ".0");
  return number;
}

}  // namespace nord_driver
