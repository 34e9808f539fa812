#include "node/device_warnings.h"

#include <array>
#include <cstdint>
#include <optional>

#include "config/setting_checks.h"
#include "profile/cycle_parameters.h"

namespace nord_driver::node {

namespace {

constexpr std::uint16_t kEnableRight = 1, kEnableLeft = 2;  // of the digital inputs, P420 (BU 0280 5.1.2)

std::string ofSet(std::size_t index) {
  return " of parameter set " + std::to_string(index + 1);
}

template <typename Value>
bool allUnknown(const std::array<std::optional<Value>, 4>& values) {
  for (const auto& value : values) {
    if (value) return false;
  }
  return true;
}

std::string element(std::size_t index) {
  return std::string(index < 9 ? " [-0" : " [-") + std::to_string(index + 1) + "]";
}

void warnOfFunctions(const std::array<std::optional<std::uint16_t>, 4>& functions, std::uint16_t number,
                     profile::Series series, const char* value, std::vector<std::string>& warnings) {
  const profile::CycleParameter* info = profile::findCycleParameter(number, series);
  const bool is_array = info != nullptr && info->shape == profile::ParameterShape::kArrayPerSet;
  for (std::size_t set = 0; set < functions.size(); ++set) {
    if (!functions[set] || *functions[set] == cycle::kFrequencyFunction) continue;
    warnings.push_back("P" + std::to_string(number) + (is_array ? element(0) : "") + ofSet(set) + " is " +
                       std::to_string(*functions[set]) + ", so that " + value +
                       " is not the frequency: not enabled in this set before it is " +
                       std::to_string(cycle::kFrequencyFunction));
  }
}

void warnOfUnknown(const cycle::DeviceData& device, std::vector<std::string>& warnings) {
  std::string names;
  const auto add = [&names](bool unknown, const char* name) {
    if (unknown) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  add(allUnknown(device.min_frequency), "P104 (above 0 the motor turns at setpoint 0)");
  add(allUnknown(device.actual_value_1_function), "P543 (what actual value 1 is)");
  add(allUnknown(device.setpoint_1_function), "P546 (what setpoint 1 is)");
  if (!names.empty()) warnings.push_back("could not be read, look at the inverter itself: " + names);
}

}  // namespace

std::vector<std::string> deviceWarnings(const cycle::DeviceData& device, profile::Series series) {
  std::vector<std::string> warnings;
  if (!device.complete) return warnings;
  for (std::size_t set = 0; set < device.min_frequency.size(); ++set) {
    const auto& frequency = device.min_frequency[set];
    if (!frequency || *frequency <= 0.0) continue;
    warnings.push_back("P104" + ofSet(set) + " is " + shortNumber(*frequency) +
                       " Hz: enabled, the motor turns at that with setpoint 0; set it to 0");
  }
  warnOfFunctions(device.actual_value_1_function, 543, series, "actual value 1", warnings);
  warnOfFunctions(device.setpoint_1_function, 546, series, "setpoint 1", warnings);
  for (std::size_t i = 0; i < device.bus_bit_functions.size(); ++i) {
    const std::uint16_t function = device.bus_bit_functions[i];
    if (function != kEnableRight && function != kEnableLeft) continue;
    warnings.push_back("P480" + element(i) + " = " + std::to_string(function) +
                       (function == kEnableRight ? " (enable right)" : " (enable left)") +
                       ": a bus I/O bit can start the motor past this driver; set it to 0");
  }
  warnOfUnknown(device, warnings);
  return warnings;
}

}  // namespace nord_driver::node
