// POSICON, the position control of an inverter: where the shaft is, where it shall be, and the way there.
//
// BU 0020 7.3.4, 7.3.5; BU 2700 5.3. It knows no telegrams: what the words mean comes to it as a PositionCommand.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/inverter/encoder.h"
#include "sim/inverter/motor.h"
#include "sim/inverter/parameter_store.h"
#include "sim/inverter/posicon_settings.h"
#include "sim/inverter/position_loop.h"

namespace nord_driver::sim {

/// What the bus asks for at the moment.
struct PositionCommand {
  std::optional<double> target;  ///< revolutions, absolute, when words carry one
  std::optional<unsigned> bits;  ///< bits 0 to 5, position array or position increments, when something carries them
  bool reference_run = false;
  bool reference_point = false;  ///< the switch, by the bus
  bool teach_in = false;
  bool quit_teach_in = false;
  bool reset_position = false;
};

class Posicon {
 public:
  /// All must outlive it.
  Posicon(ParameterStore& parameters, const Motor& motor, const PosiconSettings& settings) noexcept;

  void powerOn() noexcept;
  /// Every step while there are mains, whoever moves the shaft.
  void watch(const PositionCommand& command, unsigned set) noexcept;
  /// The output frequency for the next `dt` seconds, while the position control moves the shaft.
  double drive(const MotionLimits& limits, double dt) noexcept;
  /// Somebody else moves it, or nobody.
  void release() noexcept;

  /// P600 of this set is not 0.
  bool isOn(unsigned set) const noexcept { return parameters_.value(posicon::kControl, set) != 0; }
  /// The shaft is moved by frequencies meanwhile.
  bool teaching() const noexcept { return command_.teach_in; }

  double position() const noexcept;  ///< revolutions, as the inverter knows it
  double target() const noexcept { return target_; }
  double speed() const noexcept { return loop_.speed(); }  ///< Hz, as the path has it
  bool referenced() const noexcept { return encoder_.referenced(); }
  bool referencing() const noexcept { return run_ != Run::kNone; }
  /// Within P612, at least a step of the resolution.
  bool reached() const noexcept;
  /// The fault its path asks for, 0 = none.
  std::uint16_t fault() const noexcept;
  const PosiconSettings& settings() const noexcept { return settings_; }

 private:
  enum class Run : std::uint8_t { kNone, kSearch, kLeave, kDone };

  void aim(const PositionCommand& before) noexcept;
  void aimByArray(unsigned bits_before) noexcept;
  double runToReference(const MotionLimits& limits, double dt) noexcept;
  void learn() noexcept;
  bool onReferencePoint() const noexcept;
  void show() noexcept;
  double shaft() const noexcept;
  double ratio() const noexcept;
  double limited(double position) const noexcept;

  ParameterStore& parameters_;
  const Motor& motor_;
  PosiconSettings settings_;
  Encoder encoder_;
  PositionLoop loop_;
  PositionCommand command_;
  unsigned set_ = 0;
  double target_ = 0.0;
  bool driving_ = false;
  Run run_ = Run::kNone;
};

}  // namespace nord_driver::sim
