// What the inverter says of itself: status word and actual values.

#include <algorithm>
#include <cmath>

#include "sim/inverter/inverter_model.h"

namespace nord_driver::sim {

namespace {

constexpr unsigned kBit10Element = 8, kBit13Element = 9;  // of P481: BU 0020 6.2.1

}  // namespace

const char* toString(InverterState state) noexcept {
  switch (state) {
    case InverterState::kOff:
      return "off";
    case InverterState::kNotReadyToSwitchOn:
      return "not ready to switch on";
    case InverterState::kSwitchOnDisabled:
      return "switch-on disabled";
    case InverterState::kReadyToSwitchOn:
      return "ready to switch on";
    case InverterState::kSwitchedOn:
      return "switched on";
    case InverterState::kOperationEnabled:
      return "operation enabled";
    case InverterState::kQuickStopActive:
      return "quick stop active";
    case InverterState::kFaultReactionActive:
      return "fault reaction active";
    case InverterState::kFault:
      return "fault";
  }
  return "?";
}

Word InverterModel::statusWord() const noexcept {
  using S = InverterState;
  if (state_ == S::kOff) return 0;
  Word word = 0;
  switch (state_) {
    case S::kOff:
    case S::kNotReadyToSwitchOn:
      break;
    case S::kSwitchOnDisabled:
      word = zsw::kSwitchOnDisabled;
      break;
    case S::kReadyToSwitchOn:
      word = zsw::kReadyToSwitchOn;
      break;
    case S::kSwitchedOn:
      word = zsw::kReadyToSwitchOn | zsw::kSwitchedOn;
      break;
    case S::kOperationEnabled:
    case S::kQuickStopActive:
      word = zsw::kReadyToSwitchOn | zsw::kSwitchedOn | zsw::kOperationEnabled;
      break;
    case S::kFaultReactionActive:
      word = zsw::kReadyToSwitchOn | zsw::kSwitchedOn | zsw::kOperationEnabled | zsw::kFault;
      break;
    case S::kFault:
      word = zsw::kFault;
      break;
  }
  const bool commanded = commanded_ || !busControl();
  const bool off2 = terminals_.coast || (commanded && (command() & stw::kNoOff2) == 0);
  const bool off3 =
      terminals_.quick_stop || (commanded && (command() & stw::kNoOff3) == 0) || state_ == S::kQuickStopActive;
  if (!off2) word |= zsw::kNoOff2;
  if (!off3) word |= zsw::kNoOff3;
  if (warning_ != 0) word |= zsw::kWarning;
  if (inputs_.bit_10 || outputIsOn(kBit10Element)) word |= zsw::kBit10;
  if (inputs_.bit_13 || outputIsOn(kBit13Element)) word |= zsw::kBit13;
  if (setpointReached()) word |= zsw::kSetpointReached;
  if (busControl()) word |= zsw::kBusControl;
  word |= frequency_ < 0.0 ? zsw::kLeft : zsw::kRight;  // at rest "right": 0B31
  return static_cast<Word>(word | set_ << zsw::kParameterSetShift);
}

Word InverterModel::actualValue(unsigned n) const noexcept {
  if (state_ == InverterState::kOff || n > 2) return 0;
  if (!wideActual()) return functionValue(busFunction(543, n));
  const WideField& wide = wiring_.wide;
  if (n == wide.other()) return functionValue(busFunction(543, 1));
  return positionWord(positionActual(parameters_.device(), busFunction(543, 0)), n == wide.high);
}

// BU 0020 6.2.2 (P543) and 7.3.7: shares of the nominal sizes, +-200 %.
Word InverterModel::functionValue(std::int32_t function) const noexcept {
  const PositionFunction position = positionActual(parameters_.device(), function);
  if (position.word != PositionWord::kNone) return positionWord(position, position.word == PositionWord::kHigh);
  const double maximum = parameters_.scaled(105, set_);
  double share = 0.0;
  switch (function) {
    case 1:
      share = frequency_ / maximum;
      break;
    case 2:   // speed
    case 22:  // speed encoder
    case 23:  // actual frequency with slip
      share = motor_.rotorFrequency() / maximum;
      break;
    case 3:
      share = std::fabs(motor_.torqueShare());
      break;
    case 4:
      share = motor_.torqueShare() * 100.0 / parameters_.scaled(112, set_);
      break;
    case 5:
      return inputs_.digital_io;
    case 8:
      share = target_ / maximum;
      break;
    case 9:
      return fault_;
    case 12: {
      unsigned bits = inputs_.bus_out_bits;
      for (unsigned bit = 0; bit < 8; ++bit) bits |= outputIsOn(bit) ? 1u << bit : 0u;
      return static_cast<Word>(bits);
    }
    case 17:
    case 18:
      if (!parameters_.device().isOlderSeries()) share = inputs_.analog[function == 17 ? 0 : 1];
      break;
    default:
      break;
  }
  const double raw = std::round(share * kFullScale);
  return toWord(static_cast<std::int16_t>(std::clamp(raw, -32768.0, 32767.0)));
}

}  // namespace nord_driver::sim
