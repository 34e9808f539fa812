// One simulated drive: inverter, motor, parameters, bus module, and the switches an experimenter has.
#pragma once

#include <optional>
#include <string>

#include "sim/inverter/inverter_model.h"
#include "sim/inverter/motor.h"
#include "sim/inverter/parameter_store.h"
#include "sim/profibus/dp_slave.h"
#include "sim/profibus/module_station.h"
#include "sim/profibus/pkw_server.h"
#include "sim/sim_config.h"

namespace nord_driver::sim {

/// What an experimenter does to parameter orders.
struct ParameterSwitches {
  bool silent = false;               ///< none is answered any more
  std::optional<PkwRefusal> refuse;  ///< answered with this error
  unsigned delay = 0;                ///< telegrams they wait; over CAN milliseconds more
};

class DriveUnit {
 public:
  /// With a module of its own. `referee` must outlive the drive.
  DriveUnit(const DriveConfig& config, Referee& referee);
  /// Behind a module that others share; it must outlive the drive.
  DriveUnit(const DriveConfig& config, ModuleStation& module);
  DriveUnit(const DriveUnit&) = delete;
  DriveUnit& operator=(const DriveUnit&) = delete;

  void advance(Duration span) noexcept;

  /// Mains and the module's 24 V both off: the station is silent, the wheel coasts. A module that others share lives
  /// on.
  void setPlugged(bool plugged) noexcept;
  /// Mains of the inverter behind a module with its own 24 V supply (BU 0020 2.1.3).
  void setInverterPower(bool on) noexcept;
  /// The connection between this inverter and its module.
  void setInverterLink(bool intact) noexcept;
  bool inverterLink() const noexcept { return inverter_link_; }
  /// The module works, its answers are lost.
  void setMute(bool mute) noexcept;
  bool mute() const noexcept { return mute_; }
  /// How parameter orders fare, over whatever bus they come.
  void setParameterSwitches(const ParameterSwitches& switches) noexcept;
  const ParameterSwitches& parameterSwitches() const noexcept { return switches_; }
  /// Answers come later by this much than the segment makes them; those of the whole station.
  void setAnswerDelay(Duration delay) noexcept { station().setAnswerDelay(delay); }
  Duration answerDelay() const noexcept { return slave().answerDelay(); }

  const DriveConfig& config() const noexcept { return config_; }
  const std::string& name() const noexcept { return config_.name; }
  bool plugged() const noexcept { return plugged_; }

  double shaftSpeed() const noexcept { return motor_.speed(); }            ///< rad/s at the motor
  double shaftAngle() const noexcept { return motor_.angle(); }            ///< rad at the motor
  double wheelSpeed() const noexcept { return motor_.speed() / ratio(); }  ///< rad/s at the joint
  double wheelAngle() const noexcept { return motor_.angle() / ratio(); }  ///< rad at the joint

  ParameterStore& parameters() noexcept { return parameters_; }
  const ParameterStore& parameters() const noexcept { return parameters_; }
  InverterModel& inverter() noexcept { return inverter_; }
  const InverterModel& inverter() const noexcept { return inverter_; }
  /// The bus module: its own, or the one it shares.
  DpStation& slave() noexcept { return station(); }
  const DpStation& slave() const noexcept {
    return module_ != nullptr ? static_cast<const DpStation&>(*module_) : *own_;
  }
  bool sharesModule() const noexcept { return module_ != nullptr; }
  /// Of its station, and of what came for this inverter.
  SlaveCounters counters() const noexcept;
  /// Its process data move: in data exchange, its node operational.
  bool inDataExchange() const noexcept;
  /// What the node of a drive on a CAN bus tells of the exchange.
  void showExchange(bool moving, const SlaveCounters& counters) noexcept;
  PkwServer& pkw() noexcept { return pkw_; }

 private:
  DpStation& station() noexcept { return module_ != nullptr ? static_cast<DpStation&>(*module_) : *own_; }
  unsigned place() const noexcept { return config_.place - 1; }
  double ratio() const noexcept { return config_.inverted ? -config_.gear_ratio : config_.gear_ratio; }

  DriveConfig config_;
  ParameterStore parameters_;
  Motor motor_;
  InverterModel inverter_;
  PkwServer pkw_;
  std::optional<DpSlave> own_;
  ModuleStation* module_ = nullptr;
  bool plugged_ = true;
  bool inverter_link_ = true;
  bool mute_ = false;
  bool exchanging_ = false;  // on a CAN bus
  SlaveCounters exchanged_;  // on a CAN bus
  ParameterSwitches switches_;
};

}  // namespace nord_driver::sim
