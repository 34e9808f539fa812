// What rosparam takes for a number of what people write: PyYAML's reading of YAML 1.1, which is narrower than that of most. What
// only PyYAML takes for one (1_000, 0b11, 1:30, .inf) is a text here.
#pragma once

#include <string>

namespace nord_driver {

/// "16", "-7", "0x10", "010" (octal). Not "08".
bool isYamlInteger(const std::string& text);

/// "0.5", "5.", ".5", "1.0e+6". A fraction has a point and an exponent a sign: "1e6", "1.0e6" and "-.5" are texts.
bool isYamlFraction(const std::string& text);

/// The number as rosparam takes it for one: "1000000", "0.001", "1.0e-20".
std::string yamlNumber(double value);

}  // namespace nord_driver
