#include "cycle/drive_words.h"

#include <algorithm>
#include <cmath>

#include "cycle/bus_bit_function.h"
#include "cycle/commands.h"
#include "profile/scaling.h"

namespace nord_driver::cycle {

namespace {

std::int16_t toWord(double share) noexcept {
  constexpr double kTwice = 2.0;  // the range of a word (BU 0020 7.3.6)
  const double raw = std::round(std::clamp(share, -kTwice, kTwice) * profile::kHundredPercent);
  return static_cast<std::int16_t>(std::min(raw, 32767.0));  // 200 % is one step beyond it, -200 % is not
}

// Of P480, as read now: kUnknownFunction where it was not.
std::uint16_t functionOf(const SignalSetup& output, const DeviceData& device) noexcept {
  const std::size_t element = busBitElement(output).value_or(0);
  return element == 0 || element > device.bus_bit_functions.size() ? kUnknownFunction
                                                                   : device.bus_bit_functions[element - 1];
}

/// The bit has to stay low for its function in P480: SK 2xxE leaves the factory with "enable right" in [-01] (BU 0280 5.1.2).
bool isRefused(const SignalSetup& output, std::uint16_t function) noexcept {
  if (!busBitElement(output)) return false;
  return function == kUnknownFunction || !(isHarmless(function) || output.may_move);
}

}  // namespace

DriveWords::DriveWords(const WordSetup& setup, profile::Series series, std::size_t carried)
    : setup_(setup),
      series_(series),
      carried_(std::min(carried, profile::kMaxProcessValues)),
      withdrawn_(static_cast<std::size_t>(std::count_if(setup.signals.begin(), setup.signals.end(),
                                                        [](const SignalSetup& s) { return isOutput(s.source); }))) {
  for (const SignalSetup& signal : setup.signals) {
    if (isOutput(signal.source)) outputs_.push_back(signal);
  }
  told_.assign(outputs_.size(), 0);
}

void DriveWords::learn(const DeviceData& device) noexcept {
  for (std::size_t set = 0; set < known_.size(); ++set) {
    const auto& read = device.word_functions[set].setpoints;
    auto& known = known_[set].setpoints;
    std::transform(read.begin(), read.end(), known.begin(), known.begin(),
                   [](std::uint16_t now, std::uint16_t before) { return now == kUnknownFunction ? before : now; });
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
  learn(device);
  withdrawn_.update(state.stop, commands, now);
  putOutputs(output, state, device, commands, now);
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

bool DriveWords::isOn(const SignalSetup& signal, const BitCommand& command, Instant now) const noexcept {
  return command.given && command.on && (signal.hold || !isStale(command, setup_.release_after, now));
}

void DriveWords::putOutputs(profile::ProcessOutput& output, const State& state, const DeviceData& device,
                            const WordCommands& commands, Instant now) const noexcept {
  unsigned bus_bits = 0;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const SignalSetup& signal = outputs_[i];
    if (!isOn(signal, commands.outputs[i], now)) continue;
    if (signal.source == SignalSource::kModuleOutput) {
      output.module_outputs = static_cast<std::uint8_t>(output.module_outputs | 1u << (signal.number - 1u));
      continue;
    }
    const std::uint16_t function = functionOf(signal, device);
    const bool held_back = isRefused(signal, function) || state.in_doubt ||
                           (!isHarmless(function) && (state.stop.stopping || withdrawn_.has(i, mayEndStop(function))));
    if (held_back || output.control_word == 0) continue;
    if (signal.source == SignalSource::kControlBit) {
      output.control_word = static_cast<Word>(output.control_word | 1u << signal.number);
    } else {
      bus_bits |= 1u << signal.number;
    }
  }
  if (bus_bits == 0 || state.set < 1 || state.set > device.word_functions.size()) return;
  for (std::size_t place = 2; place <= carried_; ++place) {
    if (!carries(place, {false, profile::WordUse::kBusBits}, device.word_functions[state.set - 1u], series_)) continue;
    output.setpoints[place - 1] = static_cast<std::int16_t>(bus_bits);
  }
}

std::optional<Sentence> DriveWords::pollFinding(const char* drive, const DeviceData& device, bool in_doubt) noexcept {
  if (in_doubt) return std::nullopt;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const std::uint16_t function = functionOf(outputs_[i], device);
    if (!isRefused(outputs_[i], function) || told_[i] == function) continue;
    told_[i] = function;
    const unsigned element = *busBitElement(outputs_[i]);
    Sentence text;
    if (function == kUnknownFunction) {
      text.format("signal %s of drive %s stays off: P480[-%02u], what its bit does in the inverter, could not be read",
                  outputs_[i].name.c_str(), drive, element);
    } else {
      text.format(
          "signal %s of drive %s stays off: P480[-%02u] is %u (%s), which may move the motor past ~enable; set it to "
          "0, "
          "or may_move: true",
          outputs_[i].name.c_str(), drive, element, unsigned{function}, busBitName(function));
    }
    return text;
  }
  return std::nullopt;
}

}  // namespace nord_driver::cycle
