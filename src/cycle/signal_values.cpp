#include "cycle/signal_values.h"

#include <algorithm>

#include "cycle/word_needs.h"
#include "profile/scaling.h"

namespace nord_driver::cycle {

using profile::WordUse;

namespace {

double bitOf(unsigned word, unsigned bit) noexcept {
  return (word >> bit & 1u) != 0 ? 1.0 : 0.0;
}

std::optional<std::int16_t> wordWith(WordUse use, profile::Series series, const DriveSnapshot& drive) noexcept {
  const std::size_t set = drive.parameter_set;
  if (!drive.online || set < 1 || set > drive.device.word_functions.size()) return std::nullopt;
  for (std::size_t place = 2; place <= std::min<std::size_t>(drive.words, profile::kMaxProcessValues); ++place) {
    if (carries(place, {true, use}, drive.device.word_functions[set - 1], series)) {
      return drive.input.actual_values[place - 1];
    }
  }
  return std::nullopt;
}

std::optional<double> bitWith(WordUse use, unsigned bit, profile::Series series, const DriveSnapshot& drive) noexcept {
  const auto word = wordWith(use, series, drive);
  if (!word) return std::nullopt;
  return bitOf(static_cast<std::uint16_t>(*word), bit);
}

}  // namespace

std::optional<double> signalValue(const SignalSetup& signal, profile::Series series,
                                  const DriveSnapshot& drive) noexcept {
  switch (signal.source) {
    case SignalSource::kBusOutBit:
      return bitWith(WordUse::kBusBits, signal.number, series, drive);
    case SignalSource::kDigitalInput:
    case SignalSource::kRelay:
      return bitWith(WordUse::kDigitalIo, digitalIoBit(signal, series).value_or(0), series, drive);
    case SignalSource::kStatusBit:
      if (!drive.online) return std::nullopt;
      return bitOf(drive.input.status_word, signal.number);
    case SignalSource::kModuleInput:
      if (!drive.module_answers) return std::nullopt;
      return bitOf(drive.module_inputs, signal.number - 1u);
    case SignalSource::kAnalogInput: {
      const auto use = signal.number == 1 ? WordUse::kAnalogInput1 : WordUse::kAnalogInput2;
      const auto word = wordWith(use, series, drive);
      if (!word) return std::nullopt;
      return 100.0 * *word / profile::kHundredPercent;
    }
    case SignalSource::kBusInBit:
    case SignalSource::kControlBit:
    case SignalSource::kModuleOutput:
      break;
  }
  return std::nullopt;
}

}  // namespace nord_driver::cycle
