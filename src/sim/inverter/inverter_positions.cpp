// Positions in the process data: what the words of a telegram ask of the position control, and how it says where it is.
// BU 0020 7.3.4 to 7.3.8, BU 2700 5.3 and 6.4.4, BU 0220 7.2.1.4, BU 0070 6.1.

#include <algorithm>
#include <cmath>

#include "sim/inverter/inverter_model.h"

namespace nord_driver::sim {

namespace {

constexpr std::int32_t kTopSpeedBySetpoint = 2;  // P600
constexpr unsigned kArrayBits = 6;
constexpr double kLowestRaw = -2147483648.0, kHighestRaw = 2147483647.0;

// POSICON control bits of SK 700E and 750E: BU 0020 7.3.5.
constexpr unsigned kArrayMask = 0x3F;
constexpr unsigned kReferenceRun = 1u << 6, kReferencePoint = 1u << 7, kTeachIn = 1u << 8, kQuitTeachIn = 1u << 9,
                   kResetPosition = 1u << 10;

std::int32_t joined(Word high, Word low) noexcept {
  return static_cast<std::int32_t>(std::uint32_t{high} << 16 | low);
}

}  // namespace

// P546 to P548 by the number of the word: with a 32-bit setpoint 1 there is no setpoint 3 (BU 0020 7.3.6).
unsigned InverterModel::setpointPlace(unsigned n) const noexcept {
  if (!wideSetpoint()) return n;
  return n == wiring_.wide.other() ? 1 : 0;
}

PositionFunction InverterModel::positionSetpointAt(unsigned n) const noexcept {
  const unsigned place = setpointPlace(n);
  return positionSetpoint(parameters_.device(), place, busFunction(546, place));
}

// "PPO type 2 or 4": BU 0020 6.1.2, of SK 300E and 7x0E only. Asked for each word of each step: the quick answers first.
bool InverterModel::wideSetpoint() const noexcept {
  if (!parameters_.device().isOlderSeries() || data_.carried != data_.setpoints.size()) return false;
  const PositionFunction first = positionSetpoint(parameters_.device(), 0, busFunction(546, 0));
  return first.word == PositionWord::kWide;
}

// With a 32-bit setpoint position actual value 1 has 32 bits, too, when it is a position: BU 0020 7.3.7.
bool InverterModel::wideActual() const noexcept {
  return wideSetpoint() && positionActual(parameters_.device(), busFunction(543, 0)).word == PositionWord::kWhole;
}

void InverterModel::watchPosition() noexcept {
  const bool asked = commanded_ && busSetpoint() && posicon_.isOn(set_);
  posicon_.watch(asked ? position_command_ : PositionCommand{}, set_);
}

// Under the control of the terminals, while it is taught and with bit 6 = 0 the setpoint is a frequency.
bool InverterModel::positioning() const noexcept {
  constexpr unsigned kMoves = stw::kOn | stw::kRampEnable | stw::kRampRun | stw::kSetpointEnable;
  return state_ == InverterState::kOperationEnabled && posicon_.isOn(set_) && busControl() && !posicon_.teaching() &&
         (command() & kMoves) == kMoves;
}

double InverterModel::positioningFrequency(double dt) noexcept {
  MotionLimits limits;
  limits.maximum = parameters_.scaled(105, set_);
  const bool by_setpoint = parameters_.value(posicon::kControl, set_) == kTopSpeedBySetpoint;
  limits.top = by_setpoint ? std::fabs(setpointFrequency()) : limits.maximum;
  const auto ramp = [&](unsigned number) {
    const double time = parameters_.scaled(number, set_);
    return time > 0.0 ? limits.maximum / time : limits.maximum * 1e6;
  };
  limits.acceleration = ramp(102);
  limits.deceleration = ramp(103);
  return posicon_.drive(limits, dt);
}

PositionCommand InverterModel::positionCommand() const noexcept {
  PositionCommand command;
  command.target = positionTarget();
  unsigned bits = 0;
  bool carried = false;
  for (unsigned n = 0; n < data_.carried; ++n) {
    if (positionSetpointAt(n).word != PositionWord::kControlBits) continue;
    bits |= data_.setpoints[n];
    carried = true;
  }
  const PosiconInputs& inputs = posicon_.settings().inputs;
  for (unsigned bit = 0; bit < kArrayBits; ++bit) {
    const std::int32_t function = inputs.first_array_bit + static_cast<std::int32_t>(bit);
    carried = carried || busBitHasFunction(function);
    if (busBitIs(function)) bits |= 1u << bit;
  }
  if (carried) command.bits = bits & kArrayMask;
  command.reference_run = (bits & kReferenceRun) != 0 || busBitIs(inputs.reference_run);
  command.reference_point = (bits & kReferencePoint) != 0 || busBitIs(inputs.reference_point);
  command.teach_in = (bits & kTeachIn) != 0 || busBitIs(inputs.teach_in);
  command.quit_teach_in = (bits & kQuitTeachIn) != 0 || busBitIs(inputs.quit_teach_in);
  command.reset_position = (bits & kResetPosition) != 0 || busBitIs(inputs.reset_position);
  return command;
}

std::optional<double> InverterModel::positionTarget() const noexcept {
  const ProcessData& before = torn_ ? previous_ : data_;  // where the high words are from
  std::optional<Word> low, high;
  std::optional<double> whole;
  PositionFunction unit;
  for (unsigned n = 0; n < data_.carried; ++n) {
    const PositionFunction function = positionSetpointAt(n);
    const double thousandths = toSigned(data_.setpoints[n]);
    switch (function.word) {
      case PositionWord::kWhole:
        whole = thousandths / positionUnit(function);
        break;
      case PositionWord::kWide:
        if (!wideSetpoint()) break;
        high = before.setpoints[wiring_.wide.high];
        low = data_.setpoints[wiring_.wide.low];
        unit = function;
        break;
      case PositionWord::kLow:
        low = data_.setpoints[n];
        unit = function;
        break;
      case PositionWord::kHigh:
        high = before.setpoints[n];
        break;
      case PositionWord::kNone:
      case PositionWord::kControlBits:
        break;
    }
  }
  if (!low) return whole;
  // "Only the low word can also be transferred": 32.767 to -32.768 rotations (BU 2700 6.4.4).
  const std::int32_t raw = high ? joined(*high, *low) : toSigned(*low);
  return raw / positionUnit(unit);
}

double InverterModel::positionUnit(const PositionFunction& function) const noexcept {
  if (!function.increments) return 1.0 / posicon::kResolution;
  const PosiconSettings& settings = posicon_.settings();
  return parameters_.device().isOlderSeries() ? settings.older_increments : settings.increments;
}

Word InverterModel::positionWord(const PositionFunction& function, bool high) const noexcept {
  const Found found = torn_ && high ? found_[0] : Found{posicon_.position(), posicon_.target()};
  const double revolutions =
      std::clamp(function.set_position ? found.target : found.position, -posicon::kRange, posicon::kRange);
  const double raw = std::clamp(std::round(revolutions * positionUnit(function)), kLowestRaw, kHighestRaw);
  const auto bits = static_cast<std::uint32_t>(static_cast<std::int32_t>(raw));
  return static_cast<Word>(high ? bits >> 16 : bits & 0xFFFFu);
}

// "With posicon: setpoint position has been reached": BU 0020 7.3.4, bit 8.
bool InverterModel::setpointReached() const noexcept {
  const bool by_position = posicon_.isOn(set_) && busControl() && !posicon_.teaching();
  return by_position ? posicon_.reached() : frequency_ == target_;
}

// What P481 assigns to a bus I/O out bit, or to bit 10 or 13 of the status word.
bool InverterModel::outputIsOn(unsigned element) const noexcept {
  const std::int32_t function = parameters_.value(481, set_, element);
  if (function == 0) return false;
  const PosiconOutputs& outputs = posicon_.settings().outputs;
  if (function == outputs.referenced) return posicon_.referenced();
  return function == outputs.position_reached && posicon_.isOn(set_) && posicon_.reached();
}

}  // namespace nord_driver::sim
