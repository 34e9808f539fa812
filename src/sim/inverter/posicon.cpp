#include "sim/inverter/posicon.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::sim {

namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr std::int32_t kIncrements = 1;  // P610
constexpr unsigned kArrayBits = 6;
constexpr double kLeaving = 0.2;  // of the speed of the reference run

std::int32_t inSteps(double revolutions) noexcept {
  const double within = std::clamp(revolutions, -posicon::kRange, posicon::kRange);
  return static_cast<std::int32_t>(std::lround(within / posicon::kResolution));
}

}  // namespace

Posicon::Posicon(ParameterStore& parameters, const Motor& motor, const PosiconSettings& settings) noexcept
    : parameters_(parameters),
      motor_(motor),
      settings_(settings),
      encoder_(settings.encoder, settings.position),
      loop_(motor),
      target_(settings.position) {}

double Posicon::shaft() const noexcept {
  return motor_.angle() / kTwoPi;
}

// "This value range can be extended with the ratio factor (P607 speed ratio and P608 reduction)": BU 2700 6.4.4. Which
// one multiplies is not said; here a position is the shaft's revolutions times P607 by P608.
double Posicon::ratio() const noexcept {
  const double ratio = parameters_.value(posicon::kRatio, set_);
  const double reduction = parameters_.value(posicon::kReduction, set_);
  return ratio > 0.0 && reduction > 0.0 ? ratio / reduction : 1.0;
}

double Posicon::position() const noexcept {
  return encoder_.position(shaft()) * ratio();
}

void Posicon::powerOn() noexcept {
  encoder_.powerOn(shaft());
  command_ = PositionCommand{};
  target_ = position();
  release();
}

void Posicon::watch(const PositionCommand& command, unsigned set) noexcept {
  set_ = set;
  const PositionCommand before = command_;
  command_ = command;
  if (command.reset_position && !before.reset_position) encoder_.setPosition(shaft(), 0.0);
  if (command.quit_teach_in && !before.quit_teach_in) learn();
  if (!command.reference_run) run_ = Run::kNone;
  if (run_ == Run::kNone) aim(before);
  show();
}

void Posicon::aim(const PositionCommand& before) noexcept {
  if (command_.target) {
    target_ = limited(*command_.target);
  } else if (command_.bits) {
    aimByArray(before.bits.value_or(0));
  }
}

// BU 0020 7.3.5: the position is based on array or increment as per P610. 0 chooses no element.
void Posicon::aimByArray(unsigned bits_before) noexcept {
  const unsigned bits = *command_.bits;
  if (parameters_.value(posicon::kMode, set_) != kIncrements) {
    const unsigned element = settings_.array_from_zero ? bits + 1 : bits;
    const ParameterDefinition* array = parameters_.find(posicon::kArray);
    if (element == 0 || array == nullptr || element > array->elements) return;
    target_ = limited(parameters_.value(posicon::kArray, set_, element - 1) * posicon::kResolution);
    return;
  }
  if (!driving_) return;  // an increment counts from where the shaft stands under control
  for (unsigned bit = 0; bit < kArrayBits; ++bit) {
    if ((bits & ~bits_before & 1u << bit) == 0) continue;
    target_ = limited(target_ + parameters_.value(posicon::kArray, set_, bit) * posicon::kResolution);
  }
}

double Posicon::limited(double position) const noexcept {
  const double minimum = parameters_.value(posicon::kMinimum, set_) * posicon::kResolution;
  const double maximum = parameters_.value(posicon::kMaximum, set_) * posicon::kResolution;
  if (minimum < maximum) position = std::clamp(position, minimum, maximum);
  return std::clamp(position, -posicon::kRange, posicon::kRange);
}

double Posicon::drive(const MotionLimits& limits, double dt) noexcept {
  if (!driving_) {
    driving_ = true;
    loop_.begin();
    // Whatever was asked for before the drive was stopped is over: it stands where it is until it is asked anew.
    target_ = position();
    aim(command_);
  }
  if (command_.reference_run && run_ == Run::kNone) run_ = onReferencePoint() ? Run::kLeave : Run::kSearch;
  if (run_ == Run::kSearch || run_ == Run::kLeave) return runToReference(limits, dt);
  return loop_.towards((target_ - position()) / ratio(), limits, dt);
}

// To the switch, and slowly back until it is off: there is the reference point.
double Posicon::runToReference(const MotionLimits& limits, double dt) noexcept {
  if (run_ == Run::kSearch && onReferencePoint()) run_ = Run::kLeave;
  if (run_ == Run::kSearch) return loop_.run(settings_.reference_speed, limits, dt);
  const double back = -kLeaving * settings_.reference_speed;
  if (onReferencePoint() || loop_.speed() * back < 0.0) return loop_.run(back, limits, dt);
  encoder_.setPosition(shaft(), 0.0);
  target_ = 0.0;
  run_ = Run::kDone;
  return loop_.towards(0.0, limits, dt);
}

bool Posicon::onReferencePoint() const noexcept {
  if (command_.reference_point) return true;
  if (!settings_.reference_switch) return false;
  const double beyond = shaft() - *settings_.reference_switch;
  return settings_.reference_speed < 0.0 ? beyond <= 0.0 : beyond >= 0.0;
}

void Posicon::release() noexcept {
  driving_ = false;
  run_ = Run::kNone;
}

// The element the bits choose takes the actual position, as an order over the bus would write it.
void Posicon::learn() noexcept {
  const unsigned bits = command_.bits.value_or(0);
  const unsigned element = settings_.array_from_zero ? bits + 1 : bits;
  if (element == 0) return;
  const Storage storage = parameters_.value(560) == 0 ? Storage::kRam : Storage::kEeprom;
  parameters_.write(posicon::kArray, set_, element - 1, inSteps(position()), storage);
}

bool Posicon::reached() const noexcept {
  if (run_ == Run::kSearch || run_ == Run::kLeave) return false;
  const double window = parameters_.value(posicon::kWindow, set_) * posicon::kResolution;
  return std::fabs(target_ - position()) <= std::max(window, posicon::kResolution);
}

std::uint16_t Posicon::fault() const noexcept {
  const double allowed = parameters_.value(posicon::kSlipError, set_) * posicon::kResolution;
  if (!driving_ || allowed <= 0.0 || std::fabs(loop_.lag()) <= allowed) return 0;
  return static_cast<std::uint16_t>(settings_.slip_fault);
}

void Posicon::show() noexcept {
  parameters_.show(posicon::kActualPosition, 0, inSteps(position()));
  parameters_.show(posicon::kSetPosition, 0, inSteps(target_));
  parameters_.show(posicon::kDifference, 0, inSteps(target_ - position()));
}

}  // namespace nord_driver::sim
