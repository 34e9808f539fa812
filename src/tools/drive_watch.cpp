#include "tools/drive_watch.h"

#include "profile/scaling.h"
#include "profile/status_word.h"
#include "tools/first_words.h"

namespace nord_driver::tools {

namespace {

constexpr std::uint16_t kMaxFrequency = 105, kCurrentFault = 700;

std::vector<const catalogue::DriveCatalogue*> knownOf(const ParameterLink& link) {
  std::vector<const catalogue::DriveCatalogue*> known;
  for (DriveIndex i = 0; i < link.driveCount(); ++i) known.push_back(&link.known(i));
  return known;
}

}  // namespace

DriveWatch::DriveWatch(ParameterLink& link, const std::vector<std::string>& parameters)
    : link_(link), list_(parameters, knownOf(link)), scales_(link.driveCount()) {}

std::vector<WatchedDrive> DriveWatch::look() {
  std::vector<WatchedDrive> seen;
  for (DriveIndex i = 0; i < scales_.size(); ++i) seen.push_back(look(i));
  return seen;
}

WatchedDrive DriveWatch::look(DriveIndex drive) {
  WatchedDrive seen;
  seen.name = link_.name(drive);
  const DriveIdentity identity = link_.identity(drive);
  seen.process_values = identity.process_values;
  seen.commands_known = identity.sends_words;
  seen.words_known = identity.tells_words;
  seen.values.assign(labels().size(), "not read");
  if (link_.snapshot(drive).online) {
    for (std::size_t i = 0; i < seen.values.size(); ++i) {
      const catalogue::ParameterAddress& address = list_.of(drive)[i];
      seen.values[i] = answerCell(address, link_.read(drive, address), link_.known(drive));
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
  seen.state_known = link_.isStateKnown(drive);
  if (!seen.online) seen.silence = link_.note(drive);
  if (max_frequency && seen.process_values > 0 && now.parameter_set == set) {
    seen.frequency = profile::fromActualValue1(now.input.actual_values[0], Hertz{*max_frequency}).value;
  }
  return seen;
}

std::optional<double> DriveWatch::maxFrequency(DriveIndex drive, std::uint8_t set) {
  auto& known = scales_[drive];
  const DriveIdentity identity = link_.identity(drive);
  if (set == 0 || set >= known.size() || identity.process_values == 0 || !identity.tells_words) return std::nullopt;
  if (!isFrequency(drive, set)) return std::nullopt;
  auto& max_frequency = known[set].max_frequency;
  if (max_frequency || !link_.snapshot(drive).online) return max_frequency;
  catalogue::ParameterAddress address;
  address.number = kMaxFrequency;
  address.parameter_set = set;
  const ParameterAnswer answer = link_.read(drive, address);
  if (answer.success) max_frequency = answer.value;
  return max_frequency;
}

bool DriveWatch::isFrequency(DriveIndex drive, std::uint8_t set) {
  if (!link_.positions(drive)) return true;
  auto& known = scales_[drive][set].is_frequency;
  if (known || !link_.snapshot(drive).online) return known.value_or(false);
  const profile::Series series = link_.known(drive).series();
  const ParameterAnswer answer = link_.read(drive, firstWordFunction(series, true, set));
  if (answer.success) known = saysFrequency(answer, series, true);
  return known.value_or(false);
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
