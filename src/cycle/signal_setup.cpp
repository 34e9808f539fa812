#include "cycle/signal_setup.h"

#include <algorithm>

#include "config/setting_checks.h"
#include "config/setting_choice.h"
#include "config/setting_groups.h"
#include "config/setting_note.h"
#include "profile/cycle_parameters.h"
#include "profile/word_function.h"

namespace nord_driver::cycle {

using profile::Series;
using profile::WordUse;

namespace {

struct SourceKind {
  const char* word;  ///< before the number
  SignalSource source;
  std::uint8_t first, last;
};

constexpr SourceKind kSources[] = {
    {"bus_in_bit_", SignalSource::kBusInBit, 0, 7},
    {"control_bit_", SignalSource::kControlBit, 8, 9},
    {"module_output_", SignalSource::kModuleOutput, 1, 2},
    {"bus_out_bit_", SignalSource::kBusOutBit, 0, 7},
    {"status_bit_", SignalSource::kStatusBit, 10, 10},  // 11 and 12 are the direction
    {"status_bit_", SignalSource::kStatusBit, 13, 13},
    {"digital_input_", SignalSource::kDigitalInput, 1, 12},
    {"relay_", SignalSource::kRelay, 1, 4},
    {"module_input_", SignalSource::kModuleInput, 1, 4},
    {"analog_input_", SignalSource::kAnalogInput, 1, 2},
};

constexpr const char* kAllSources =
    "bus_in_bit_0 to 7, control_bit_8, control_bit_9, module_output_1, module_output_2, bus_out_bit_0 to 7, "
    "status_bit_10, status_bit_13, digital_input_1.., relay_1.., module_input_1 to 4, analog_input_1, analog_input_2";

bool isOldSeries(Series series) noexcept {
  return series == Series::kSk300e || series == Series::kSk700e || series == Series::kSk750e;
}

// What a series has no bit for is told at start, not by a signal that never changes.
bool has(const SignalSetup& signal, Series series) noexcept {
  switch (signal.source) {
    case SignalSource::kStatusBit:  // BU 0020 7.3.4: 13 in the older series is a relay of POSICON
      return signal.number == 10 || series != Series::kSk300e;
    case SignalSource::kControlBit: {
      const auto* const bits = profile::findCycleParameter(480, series);
      return bits != nullptr && bits->elements >= *busBitElement(signal);
    }
    case SignalSource::kDigitalInput:
    case SignalSource::kRelay:
      return digitalIoBit(signal, series).has_value();
    case SignalSource::kAnalogInput:
      return profile::actualValueCode(series, WordUse::kAnalogInput1).has_value();
    case SignalSource::kBusInBit:
    case SignalSource::kModuleOutput:
    case SignalSource::kBusOutBit:
    case SignalSource::kModuleInput:
      return true;
  }
  return false;
}

std::optional<SignalSetup> parse(const std::string& word) {
  for (const SourceKind& kind : kSources) {
    for (unsigned number = kind.first; number <= kind.last; ++number) {
      if (word != kind.word + std::to_string(number)) continue;
      SignalSetup signal;
      signal.source = kind.source;
      signal.number = static_cast<std::uint8_t>(number);
      return signal;
    }
  }
  return std::nullopt;
}

void readOutput(const Settings& drive, const std::string& group, SignalSetup& signal) {
  constexpr Choice<bool> kOnTimeout[] = {{"release", false}, {"hold", true}};
  signal.hold = choiceOr(drive, group + "on_timeout", false, kOnTimeout);
  signal.may_move = booleanOr(drive, group + "may_move", false);
  if (signal.may_move && signal.source == SignalSource::kModuleOutput) {
    throw wrongSetting(drive, group + "may_move", "true", "false: an output of the bus module switches no inverter");
  }
  if (signal.may_move && signal.hold) {
    throw wrongSetting(drive, group + "on_timeout", "\"hold\"",
                       "release, because with may_move it may be what turns the motor");
  }
}

SignalSetup readSignal(const Settings& drive, const std::string& name, Series series) {
  const std::string group = "signals/" + name + "/";
  noteSetting(drive, group + "source", {std::string("one of ") + kAllSources, "", "", ""});
  const std::string word = requiredText(drive, group + "source", std::string("one of ") + kAllSources);
  auto signal = parse(word);
  if (!signal) {
    throw wrongSetting(drive, group + "source", "\"" + word + "\"", std::string("one of ") + kAllSources);
  }
  if (!has(*signal, series)) {
    throw wrongSetting(drive, group + "source", "\"" + word + "\"",
                       std::string("a source that ") + profile::toString(series) + " has");
  }
  signal->name = name;
  if (isOutput(signal->source)) readOutput(drive, group, *signal);
  return *signal;
}

}  // namespace

std::vector<SignalSetup> readSignals(const Settings& drive, Series series) {
  std::vector<SignalSetup> signals;
  for (const std::string& name : namesIn(drive, "signals")) {
    const SignalSetup signal = readSignal(drive, name, series);
    for (const SignalSetup& other : signals) {
      if (!isOutput(signal.source) || other.source != signal.source || other.number != signal.number) continue;
      throw wrongSetting(drive, "signals/" + name + "/source", "\"" + sourceText(signal) + "\"",
                         "an output that \"" + other.name + "\" does not switch already");
    }
    signals.push_back(signal);
  }
  return signals;
}

void checkSignalsCarried(const Settings& drive, const std::vector<SignalSetup>& signals,
                         const DriveIdentity& identity) {
  const auto refuse = [&](const SignalSetup& signal, const std::string& expected) {
    throw wrongSetting(drive, "signals/" + signal.name + "/source", "\"" + sourceText(signal) + "\"", expected);
  };
  for (const SignalSetup& signal : signals) {
    switch (signal.source) {
      case SignalSource::kModuleOutput:
      case SignalSource::kModuleInput:
        if (!identity.module_io) {
          refuse(signal,
                 "a source of the inverter: on this bus, as configured, the inputs and outputs of the module "
                 "are not carried");
        }
        break;
      case SignalSource::kControlBit:
      case SignalSource::kStatusBit:
        if (!identity.nord_profile) refuse(signal, "a source that the profile of this drive carries");
        break;
      case SignalSource::kBusInBit:
      case SignalSource::kBusOutBit:
      case SignalSource::kDigitalInput:
      case SignalSource::kRelay:
      case SignalSource::kAnalogInput:
        if (identity.process_values < 2) {
          refuse(signal,
                 "a source that needs no further word: the bus carries only one to and from this drive (a "
                 "longer telegram is needed: PPO type, assembly)");
        }
        break;
    }
  }
}

std::string sourceText(const SignalSetup& signal) {
  for (const SourceKind& kind : kSources) {
    if (kind.source == signal.source) return kind.word + std::to_string(signal.number);
  }
  return "";
}

// BU 0020 6.1.1, 6.2.1; BU 0280 5.1.2: [-01] to [-08] are the bus bits, [-11] and [-12] bits 8 and 9.
std::optional<std::uint8_t> busBitElement(const SignalSetup& signal) noexcept {
  if (signal.source == SignalSource::kBusInBit) return static_cast<std::uint8_t>(signal.number + 1);
  if (signal.source == SignalSource::kControlBit) return static_cast<std::uint8_t>(signal.number + 3);
  return std::nullopt;
}

std::optional<std::uint8_t> digitalIoBit(const SignalSetup& signal, Series series) noexcept {
  constexpr unsigned kFirstRelay = 12;
  const unsigned number = signal.number;
  if (signal.source == SignalSource::kRelay) return static_cast<std::uint8_t>(kFirstRelay + number - 1);
  const unsigned most = series == Series::kSk300e ? 6 : isOldSeries(series) ? 12 : 7;
  if (number <= most) return static_cast<std::uint8_t>(number - 1);
  // SK 54xE: bits 7 and 8 are the analogue inputs as digital ones, bit 9 is input 8 (BU 0020 6.2.2).
  if (series == Series::kSk54xe && number == 8) return std::uint8_t{9};
  return std::nullopt;
}

}  // namespace nord_driver::cycle
