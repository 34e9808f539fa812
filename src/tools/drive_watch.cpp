#include "tools/drive_watch.h"

#include "profile/scaling.h"
#include "profile/status_word.h"
#include "tools/parameter_name.h"

namespace nord_driver::tools {

namespace {

constexpr std::uint16_t kMaxFrequency = 105, kCurrentFault = 700;

// What the drives know of it: of several series one may have a name for it.
std::string labelOf(const ParameterLink& link, const std::vector<catalogue::ParameterAddress>& addresses) {
  for (DriveIndex i = 0; i < addresses.size(); ++i) {
    const unsigned index = addresses[i].index == 0 ? 1u : addresses[i].index;
    const std::string name = catalogue::fullName(link.known(i).find(addresses[i].number), index);
    if (!name.empty()) return parameterName(addresses[i]) + " " + name;
  }
  return parameterName(addresses.front());
}

}  // namespace

DriveWatch::DriveWatch(ParameterLink& link, const std::vector<std::string>& parameters)
    : link_(link), drives_(link.driveCount()) {
  for (const std::string& parameter : parameters) {
    std::vector<catalogue::ParameterAddress> addresses;
    for (DriveIndex i = 0; i < drives_.size(); ++i) {
      addresses.push_back(findParameter(parameter, link.known(i)));
      const catalogue::ParameterAccess access = catalogue::accessTo(addresses.back(), link.known(i));
      if (!access.error.empty()) throw UsageError(access.error);
      drives_[i].parameters.push_back(addresses.back());
    }
    labels_.push_back(labelOf(link, addresses));
  }
}

std::vector<WatchedDrive> DriveWatch::look() {
  std::vector<WatchedDrive> seen;
  for (DriveIndex i = 0; i < drives_.size(); ++i) seen.push_back(look(i));
  return seen;
}

WatchedDrive DriveWatch::look(DriveIndex drive) {
  WatchedDrive seen;
  seen.name = link_.name(drive);
  seen.process_values = link_.identity(drive).process_values;
  seen.values.assign(labels_.size(), "not read");
  if (link_.snapshot(drive).online) {
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const ParameterAnswer answer = link_.read(drive, drives_[drive].parameters[i]);
      const unsigned index = drives_[drive].parameters[i].index == 0 ? 1u : drives_[drive].parameters[i].index;
      seen.values[i] = answer.success ? link_.known(drive).valueText(answer.entry, answer.raw, index) : answer.message;
    }
    seen.fault = faultOf(drive);
  }
  const std::uint8_t set = link_.snapshot(drive).parameter_set;
  const auto max_frequency = maxFrequency(drive, set);
  // Last, so that it is not older than what was read.
  const cycle::DriveSnapshot& now = link_.snapshot(drive);
  seen.online = now.online;
  seen.output = now.output;
  seen.input = now.input;
  if (!seen.online) seen.silence = link_.note(drive);
  if (max_frequency && seen.process_values > 0 && now.parameter_set == set) {
    seen.frequency = profile::fromActualValue1(now.input.actual_values[0], Hertz{*max_frequency}).value;
  }
  return seen;
}

std::optional<double> DriveWatch::maxFrequency(DriveIndex drive, std::uint8_t set) {
  auto& known = drives_[drive].max_frequency;
  if (set == 0 || set >= known.size() || link_.identity(drive).process_values == 0) return std::nullopt;
  if (known[set] || !link_.snapshot(drive).online) return known[set];
  catalogue::ParameterAddress address;
  address.number = kMaxFrequency;
  address.parameter_set = set;
  const ParameterAnswer answer = link_.read(drive, address);
  if (answer.success) known[set] = answer.value;
  return known[set];
}

std::string DriveWatch::faultOf(DriveIndex drive) {
  if (!link_.snapshot(drive).fault) return "none";
  catalogue::ParameterAddress address;
  address.number = kCurrentFault;
  address.index = 1;
  const ParameterAnswer answer = link_.read(drive, address);
  if (!answer.success) return "its number cannot be read: " + answer.message;
  const auto number = static_cast<std::uint16_t>(answer.raw & 0xFFFF);
  if (number == 0) return "none";
  return catalogue::FaultWords::label(number) + " " + link_.known(drive).faults().name(number);
}

}  // namespace nord_driver::tools
