#include "cycle/drive_words.h"

#include <algorithm>
#include <cmath>

#include "cycle/commands.h"
#include "profile/scaling.h"

namespace nord_driver::cycle {

namespace {

std::int16_t toWord(double share) noexcept {
  constexpr double kTwice = 2.0;  // the range of a word (BU 0020 7.3.6)
  const double raw = std::round(std::clamp(share, -kTwice, kTwice) * profile::kHundredPercent);
  return static_cast<std::int16_t>(std::clamp(raw, -32768.0, 32767.0));
}

}  // namespace

DriveWords::DriveWords(const WordSetup& setup, profile::Series series, std::size_t carried)
    : setup_(setup), series_(series), carried_(std::min(carried, profile::kMaxProcessValues)) {}

void DriveWords::learn(const DeviceData& device) noexcept {
  const auto keep = [](const auto& read, auto& known) {
    for (std::size_t i = 0; i < read.size(); ++i) {
      if (read[i] != kUnknownFunction) known[i] = read[i];
    }
  };
  for (std::size_t set = 0; set < known_.size(); ++set) {
    keep(device.word_functions[set].setpoints, known_[set].setpoints);
    keep(device.word_functions[set].actual_values, known_[set].actual_values);
  }
}

std::int16_t DriveWords::wordOf(const SetpointSetup& setpoint, const WordCommand& command, const State& state,
                                Instant now) const noexcept {
  const double nominal = setpoint.nominal ? *setpoint.nominal : state.max_frequency.value_or(Hertz{}).value;
  // Without P105 nobody can say what a frequency is: nothing added, and no limit lower than the drive's own.
  if (!(nominal > 0.0)) return setpoint.moves ? std::int16_t{0} : profile::kHundredPercent;
  const double limit = setpoint.limit.value_or(nominal);
  const bool fresh = !isStale(command, setpoint.timeout, now) && (state.follows || !setpoint.moves);
  const double wanted = fresh ? command.value : setpoint.neutral.value_or(limit);
  return toWord(std::clamp(wanted, setpoint.is_signed ? -limit : 0.0, limit) / nominal);
}

void DriveWords::put(profile::ProcessOutput& output, const State& state, const DeviceData& device,
                     const WordCommands& commands, Instant now) noexcept {
  if (empty()) return;
  learn(device);
  if (output.control_word == 0 || state.set < 1 || state.set > known_.size()) return;
  for (std::size_t i = 0; i < setup_.setpoints.size(); ++i) {
    const SetpointSetup& setpoint = setup_.setpoints[i];
    const WordFunctions& functions = setpoint.moves ? device.word_functions[state.set - 1u] : known_[state.set - 1u];
    if (setpoint.moves && state.in_doubt) continue;
    // Two words with one function get the same: 0 in the other could take it back.
    for (std::size_t place = 2; place <= carried_; ++place) {
      if (!carries(place, {false, setpoint.use}, functions, series_)) continue;
      output.setpoints[place - 1] = wordOf(setpoint, commands.setpoints[i], state, now);
    }
  }
}

}  // namespace nord_driver::cycle
