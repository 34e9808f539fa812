// One simulated drive: inverter, motor, parameters, bus module, and the switches an experimenter has.
#pragma once

#include <optional>
#include <string>

#include "nord_driver/sim/dp_slave.h"
#include "nord_driver/sim/inverter_model.h"
#include "nord_driver/sim/motor.h"
#include "nord_driver/sim/parameter_store.h"
#include "nord_driver/sim/pkw_server.h"
#include "nord_driver/sim/sim_config.h"

namespace nord_driver::sim {

/// What an experimenter does to parameter orders.
struct ParameterSwitches {
  bool silent = false;               ///< none is answered any more
  std::optional<PkwRefusal> refuse;  ///< answered with this error
  unsigned delay = 0;                ///< cycles of about a millisecond they take longer
};

class DriveUnit {
 public:
  /// `referee` must outlive the drive.
  DriveUnit(const DriveConfig& config, Referee& referee);
  DriveUnit(const DriveUnit&) = delete;
  DriveUnit& operator=(const DriveUnit&) = delete;

  void advance(Duration span) noexcept;

  /// Mains and the module's 24 V both off: the station is silent, the wheel coasts.
  void setPlugged(bool plugged) noexcept;
  /// Mains of the inverter behind a module with its own 24 V supply (BU 0020 2.1.3).
  void setInverterPower(bool on) noexcept;
  /// Answers come later by this much than the segment makes them.
  /// Module and inverter are connected.
  void setModuleLink(bool intact) noexcept;
  bool moduleLink() const noexcept { return module_link_; }
  /// The module works, its answers are lost.
  void setMute(bool mute) noexcept;
  bool mute() const noexcept { return mute_; }
  /// How parameter orders fare, over whatever bus they come.
  void setParameterSwitches(const ParameterSwitches& switches) noexcept;
  const ParameterSwitches& parameterSwitches() const noexcept { return switches_; }
  void setAnswerDelay(Duration delay) noexcept { answer_delay_ = delay; }
  Duration answerDelay() const noexcept { return answer_delay_; }

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
  DpSlave& slave() noexcept { return slave_; }
  const DpSlave& slave() const noexcept { return slave_; }
  PkwServer& pkw() noexcept { return pkw_; }

 private:
  double ratio() const noexcept { return config_.inverted ? -config_.gear_ratio : config_.gear_ratio; }

  DriveConfig config_;
  ParameterStore parameters_;
  Motor motor_;
  InverterModel inverter_;
  PkwServer pkw_;
  DpSlave slave_;
  bool plugged_ = true;
  bool module_link_ = true;
  bool mute_ = false;
  ParameterSwitches switches_;
  Duration answer_delay_{0};
};

}  // namespace nord_driver::sim
