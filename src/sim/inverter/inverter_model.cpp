#include "sim/inverter/inverter_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nord_driver::sim {

namespace {

constexpr double kStep = 1e-3;           // s
constexpr double kFaultReaction = 5e-3;  // s, until "error reaction active" has become "fault"
// P509: BU 0020 6.2.2; SK 300E, 700E and 750E have one value for each half and one for both (6.1.2).
// From a module on the system bus: 3, of the SK 5xxE 6 (BU 2700 7.2).
constexpr std::int32_t kProfibus = 4;
constexpr std::int32_t kSystemBus = 3;
constexpr std::int32_t kCanopen = 6;
constexpr std::int32_t kOlderSetpoint = 8;
constexpr std::int32_t kOlderControlWord = 9;
constexpr std::int32_t kOlderProfibus = 10;

// Broadcast of a leading inverter: BU 0280 5.1.3, and BU 0020 6.2.2 (P509).
constexpr std::int32_t kSystemBusBroadcast = 4;
constexpr std::int32_t kCanBroadcast = 9;
constexpr std::int32_t kCanopenBroadcast = 10;

// P546-P548. Frequencies are shares of P105 (BU 0020 7.3.5, 7.3.6).
constexpr std::int32_t kSetpointFrequency = 1;
constexpr std::int32_t kFrequencyAddition = 4;
constexpr std::int32_t kFrequencySubtraction = 5;
constexpr std::int32_t kDecentralAddition = 2;  // SK 1x0E and 2xxE: BU 0220 5.1.3
constexpr std::int32_t kDecentralSubtraction = 3;

constexpr Word kEnable = stw::kOn | stw::kNoOff2 | stw::kNoOff3 | stw::kEnableOperation;
constexpr Word kAllOn = kEnable | stw::kRampEnable | stw::kRampRun | stw::kSetpointEnable;  // X1111111

/// Moves `value` towards `target` by at most `step`.
double approach(double value, double target, double step) noexcept {
  return value < target ? std::min(value + step, target) : std::max(value - step, target);
}

}  // namespace

InverterModel::InverterModel(ParameterStore& parameters, Motor& motor, const InverterSettings& settings)
    : parameters_(parameters),
      motor_(motor),
      settings_(settings),
      posicon_(parameters, motor, settings.posicon),
      torn_(settings.posicon.torn_words) {}

void InverterModel::advance(Duration span) noexcept {
  double rest = toSeconds(span);
  while (rest > 0.0) {
    const double dt = std::min(rest, kStep);
    step(dt);
    rest -= dt;
  }
}

void InverterModel::step(double dt) noexcept {
  if (state_ == InverterState::kOff) {
    motor_.advance(dt, false, 0.0);
    return;
  }
  in_state_ += dt;
  watchTimeout(dt);
  if (!busControl() && terminals_.parameter_set) selectParameterSet(*terminals_.parameter_set);
  acknowledgeByItself();
  evaluate();
  watchPosition();
  follow(dt);
  parameters_.show(700, 2, switchOnBlock());
  const bool voltage = state_ == InverterState::kOperationEnabled || state_ == InverterState::kQuickStopActive;
  motor_.advance(dt, voltage, frequency_);
}

void InverterModel::enter(InverterState next) noexcept {
  state_ = next;
  in_state_ = 0.0;
  if (next != InverterState::kOperationEnabled && next != InverterState::kQuickStopActive) {
    frequency_ = 0.0;  // voltage off: the wheel coasts
    target_ = 0.0;
  }
}

// The transitions, numbered as in BU 2700 6.4.3; the order of the tests is the priority of the commands (6.4.1).
void InverterModel::evaluate() noexcept {
  using S = InverterState;
  const Word word = command();
  const bool led = hearsBroadcast(parameters_.value(509));
  const bool commanded = led ? led_.control != 0 : commanded_ || !busControl();
  const bool off2 = (word & stw::kNoOff2) == 0;
  const bool off3 = (word & stw::kNoOff3) == 0;
  const bool on = (word & stw::kOn) != 0;
  switch (state_) {
    case S::kOff:
      return;
    case S::kNotReadyToSwitchOn:
      return waitForStart();
    case S::kSwitchOnDisabled:
      if (commanded && !off2 && !off3 && !on) enter(S::kReadyToSwitchOn);  // 2
      return;
    case S::kReadyToSwitchOn:
      if (off2 || off3) return enter(S::kSwitchOnDisabled);  // 7
      if (on) enter(S::kSwitchedOn);                         // 3
      return;
    case S::kSwitchedOn:
      if (off2 || off3) return enter(S::kSwitchOnDisabled);        // 10
      if (!on) return enter(S::kReadyToSwitchOn);                  // 6
      if ((word & kAllOn) == kAllOn) enter(S::kOperationEnabled);  // 4
      return;
    case S::kOperationEnabled:
      if (off2) return enter(S::kSwitchOnDisabled);  // 9
      if (off3) return enter(S::kQuickStopActive);   // 11
      if (!on) {                                     // 8: only at f = 0; until then the command can be taken back
        if (frequency_ == 0.0) enter(S::kReadyToSwitchOn);
        return;
      }
      if ((word & stw::kEnableOperation) == 0) enter(S::kSwitchedOn);  // 5; the bit table of 6.4.1 says "ready" instead
      return;
    case S::kQuickStopActive:
      if (off2 || frequency_ == 0.0) enter(S::kSwitchOnDisabled);  // 12, or done: 6.4.1 bit 2
      return;
    case S::kFaultReactionActive:
      if (in_state_ >= kFaultReaction) enter(S::kFault);  // 14
      return;
    case S::kFault:
      return;  // left by an acknowledgement only: 15
  }
}

void InverterModel::follow(double dt) noexcept {
  if (positioning()) {
    frequency_ = positioningFrequency(dt);
    target_ = posicon_.speed();
    if (posicon_.fault() != 0) trip(posicon_.fault(), false);
    return;
  }
  posicon_.release();
  const double maximum = parameters_.scaled(105, set_);
  const auto ramp = [&](unsigned number) {
    // Ramp times are from 0 Hz to P105; 0 s is a step.
    const double time = parameters_.scaled(number, set_);
    return time > 0.0 ? maximum / time * dt : maximum * 1e6;
  };
  if (state_ == InverterState::kQuickStopActive) {
    target_ = 0.0;
    frequency_ = approach(frequency_, 0.0, ramp(426));
    return;
  }
  if (state_ != InverterState::kOperationEnabled) return;

  const Word word = command();
  unsigned braking = 103;
  if ((word & stw::kOn) == 0) {
    target_ = 0.0;
  } else if ((word & stw::kRampEnable) == 0) {
    target_ = 0.0;  // bit 4 = 0 runs the quick stop ramp and stays in "operation enabled"
    braking = 426;
  } else if ((word & stw::kRampRun) == 0) {
    target_ = setpointFrequency();
    return;  // bit 5 = 0 holds the frequency
  } else {
    target_ = setpointFrequency();
  }
  const bool away_from_zero = frequency_ == 0.0 || (frequency_ > 0.0 ? target_ > frequency_ : target_ < frequency_);
  if (away_from_zero) {
    frequency_ = approach(frequency_, target_, ramp(102));
  } else {
    const double next = (frequency_ > 0.0) == (target_ > 0.0) ? target_ : 0.0;  // a reversal passes zero
    frequency_ = approach(frequency_, next, ramp(braking));
  }
}

double InverterModel::setpointFrequency() const noexcept {
  const double maximum = parameters_.scaled(105, set_);
  const bool led = !local_ && !parameters_.device().isOlderSeries() && hearsBroadcast(setpointSource());
  double share = led                                ? toSigned(led_.setpoints[0]) / kFullScale
                 : busBitsEnable() && maximum > 0.0 ? busBitFrequency() / maximum
                 : busSetpoint()                    ? busShare()
                 : maximum > 0.0                    ? terminals_.frequency / maximum
                                                    : 0.0;
  // Bit 11 beats bit 12; both 0 is right (6.4.1 note 3).
  const bool left = busControl() && (data_.control & stw::kLeft) != 0 && (data_.control & stw::kRight) == 0;
  share = std::clamp(left ? -share : share, -1.0, 1.0);
  const double frequency = share * maximum;
  const double minimum = parameters_.scaled(104, set_);
  if (std::fabs(frequency) < minimum) return share < 0.0 || left ? -minimum : minimum;
  return frequency;
}

double InverterModel::busShare() const noexcept {
  if (busControl() && (data_.control & stw::kSetpointEnable) == 0) return 0.0;
  double share = 0.0;
  for (unsigned n = 0; n < data_.setpoints.size(); ++n) {
    const double value = toSigned(data_.setpoints[n]) / kFullScale;
    const unsigned place = setpointPlace(n);
    const std::int32_t function = busFunction(546, place);
    if (function == kSetpointFrequency) share += value;
    // P546 of the older series is a table of its own, with positions in these places (BU 0020 6.1.2).
    if (place == 0 && parameters_.device().isOlderSeries()) continue;
    const bool decentral = parameters_.device().isDecentral();
    if (function == (decentral ? kDecentralAddition : kFrequencyAddition)) share += value;
    if (function == (decentral ? kDecentralSubtraction : kFrequencySubtraction)) share -= value;
  }
  return share;
}

// Setpoint or actual value `n` has a parameter of its own, or on SK 540E and above an element of the first one.
std::int32_t InverterModel::busFunction(unsigned first_number, unsigned n) const noexcept {
  const bool array = parameters_.device().series == Series::kSk54xe || parameters_.device().isDecentral();
  return array ? parameters_.value(first_number, set_, n) : parameters_.value(first_number + n, set_);
}

Word InverterModel::command() const noexcept {
  const Word from_bus = hearsBroadcast(parameters_.value(509)) ? led_.control : data_.control;
  unsigned word = busControl() ? from_bus : terminals_.enable ? kAllOn : kAllOn & ~(stw::kOn | stw::kEnableOperation);
  if (busBitsEnable()) word |= kAllOn;
  if (terminals_.coast) word &= ~unsigned{stw::kNoOff2};
  if (terminals_.quick_stop) word &= ~unsigned{stw::kNoOff3};
  return static_cast<Word>(word);
}

bool InverterModel::busControl() const noexcept {
  if (local_) return false;
  const std::int32_t source = parameters_.value(509);
  if (hearsBroadcast(source)) return true;
  if (wiring_.source) return source == *wiring_.source;
  if (!parameters_.device().isOlderSeries()) return source == busSource();
  return source == kOlderProfibus || source == kOlderControlWord;
}

bool InverterModel::busSetpoint() const noexcept {
  if (local_) return false;
  const std::int32_t source = parameters_.value(509);
  if (wiring_.source && parameters_.device().isOlderSeries()) return source == *wiring_.source;
  if (parameters_.device().isOlderSeries()) return source == kOlderProfibus || source == kOlderSetpoint;
  return setpointSource() == busSource();
}

// P510[-01], 0 = as P509.
std::int32_t InverterModel::setpointSource() const noexcept {
  const std::int32_t source = parameters_.value(510);
  return source == 0 ? parameters_.value(509) : source;
}

bool InverterModel::hearsBroadcast(std::int32_t source) const noexcept {
  if (parameters_.device().isOlderSeries()) return false;
  if (parameters_.device().isDecentral()) return source == kSystemBusBroadcast;
  return source == kCanBroadcast || source == kCanopenBroadcast;
}

ProcessData InverterModel::said() const noexcept {
  ProcessData data;
  const bool runs = state_ == InverterState::kOperationEnabled;
  data.control = static_cast<Word>(runs ? kAllOn | stw::kDataValid : (kAllOn & ~unsigned{stw::kOn}) | stw::kDataValid);
  if (state_ == InverterState::kQuickStopActive) data.control &= static_cast<Word>(~unsigned{stw::kNoOff3});
  const double maximum = parameters_.scaled(105, set_);
  if (runs && maximum > 0.0) data.setpoints[0] = static_cast<Word>(std::lround(frequency_ / maximum * kFullScale));
  return data;
}

std::int32_t InverterModel::busSource() const noexcept {
  if (wiring_.source) return *wiring_.source;
  if (!wiring_.on_system_bus) return kProfibus;
  return parameters_.device().isDecentral() ? kSystemBus : kCanopen;
}

void InverterModel::setPowered(bool on) noexcept {
  if (on == powered()) return;
  if (!on) {
    enter(InverterState::kOff);
    return;
  }
  parameters_.restoreFromEeprom();
  commanded_ = false;
  data_ = previous_ = ProcessData{};
  position_command_ = PositionCommand{};
  set_ = 0;
  fault_ = 0;
  warning_ = 0;
  tripped_cause_ = master_lost_ = timed_out_ = link_fault_ = false;
  automatic_acknowledgements_ = 0;
  posicon_.powerOn();
  parameters_.show(700, 0, 0);
  parameters_.show(700, 1, 0);
  enter(InverterState::kNotReadyToSwitchOn);
}

void InverterModel::receive(const ProcessData& data) noexcept {
  if (!powered() || link_broken_ || (data.control & stw::kDataValid) == 0) return;
  const Word before = commanded_ ? data_.control : Word{0};
  const bool bit_before = busBitsAcknowledge();
  previous_ = std::exchange(data_, data);
  found_ = {found_[1], {posicon_.position(), posicon_.target()}};
  commanded_ = true;
  since_valid_ = 0.0;
  master_lost_ = timed_out_ = false;
  if (busControl()) selectParameterSet(data.control >> stw::kParameterSetShift);
  position_command_ = posicon_.isOn(set_) ? positionCommand() : PositionCommand{};

  const bool edge = (before & stw::kAcknowledge) == 0 && (data.control & stw::kAcknowledge) != 0;
  // Taking the enable away acknowledges too, unless an input has the function (BU 0020 8, BU 2700 8.2).
  const bool enable_dropped = (before & kEnable) == kEnable && (data.control & kEnable) != kEnable;
  if (edge || (!bit_before && busBitsAcknowledge()) || (enable_dropped && !inputAcknowledges())) acknowledge();
}

void InverterModel::selectParameterSet(unsigned set) noexcept {
  if (set == set_) return;
  set_ = set;  // at once, turning or not: SW1 and IW1 are shares of the new set's P105 from now on (BU 0020 7.3.5)
  ++set_switches_;
}

void InverterModel::setLocalControl(bool on, double setpoint_hz) noexcept {
  local_ = on;
  terminals_.enable = setpoint_hz != 0.0;
  terminals_.frequency = setpoint_hz;
}

}  // namespace nord_driver::sim
