// One simulated drive: inverter, motor, parameters, and the switches an experimenter has. Its bus is that of its module.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/bus_module.h"
#include "sim/inverter/inverter_model.h"
#include "sim/inverter/motor.h"
#include "sim/inverter/parameter_store.h"
#include "sim/inverter/pkw_server.h"
#include "sim/sim_config.h"

namespace nord_driver::sim {

/// A refusal in the numbers of the bus, which an inverter itself may never give: an SDO abort code, Error_Code_1 of
/// DP-V1, a general error code of DeviceNet. The parameter channel (PKW) and PCP do not look at it.
struct BusRefusal {
  std::uint32_t code = 0;
  std::optional<unsigned> number;  ///< accesses to this parameter only
  bool at_answer = false;          ///< DP-V1: the order is taken, and refused when its answer is fetched
};

/// What an experimenter does to parameter orders.
struct ParameterSwitches {
  bool silent = false;               ///< none is answered any more
  std::optional<PkwRefusal> refuse;  ///< answered with this error
  std::optional<BusRefusal> bus_refuse;
  unsigned delay = 0;  ///< telegrams they wait; over CAN milliseconds more

  /// The code of the bus an access to this parameter is refused with; `at_answer`: as BusRefusal has it.
  std::optional<std::uint32_t> busRefusal(unsigned number, bool at_answer = false) const noexcept {
    if (!bus_refuse || bus_refuse->at_answer != at_answer || bus_refuse->number.value_or(number) != number) return {};
    return bus_refuse->code;
  }
};

/// What makes an inverter one of a certain bus.
struct Commissioning {
  BusWiring wiring;
  std::vector<ParameterPreset> parameters;  ///< P509 and what else the manual of the bus has set before it is used
};

class DriveUnit {
 public:
  /// It is in the shop: no mains, no module.
  explicit DriveUnit(const DriveConfig& config);
  DriveUnit(const DriveUnit&) = delete;
  DriveUnit& operator=(const DriveUnit&) = delete;

  /// Commissions it, puts it behind its module at the configured place, and switches its mains on; once. `module` must
  /// outlive the drive's use. Throws ConfigError when the configuration sets a parameter that is not there.
  void connect(BusModule& module, const Commissioning& commissioning);

  void advance(Duration span) noexcept {
    if (leader_ != nullptr) inverter_.hearLeader(leader_->inverter().said());
    inverter_.advance(span);
  }
  /// Which inverter on its system bus says to all what to do; it must outlive this one. nullptr: none.
  void hear(const DriveUnit* leader) noexcept { leader_ = leader; }

  /// Mains and the supply of a module that has none of its own both off: the station is silent, the wheel coasts. A
  /// module that others share lives on.
  void setPlugged(bool plugged) noexcept;
  /// Mains of the inverter behind a module with its own 24 V supply (BU 0020 2.1.3).
  void setInverterPower(bool on) noexcept;
  /// The connection between this inverter and its module.
  void setInverterLink(bool intact) noexcept { module_->setInverterLink(place(), intact); }
  bool inverterLink() const noexcept { return module_->inverterLink(place()); }
  /// The module works, its answers are lost; those of the whole station.
  void setMute(bool mute) noexcept { module_->setMute(mute); }
  /// Answers come later by this much than the bus makes them; those of the whole station.
  void setAnswerDelay(Duration delay) noexcept { module_->setAnswerDelay(delay); }
  /// How parameter orders fare, over whatever bus they come.
  void setParameterSwitches(const ParameterSwitches& switches) noexcept;
  const ParameterSwitches& parameterSwitches() const noexcept { return switches_; }

  const DriveConfig& config() const noexcept { return config_; }
  const std::string& name() const noexcept { return config_.name; }
  bool plugged() const noexcept { return plugged_; }

  double shaftSpeed() const noexcept { return motor_.speed(); }            ///< rad/s at the motor
  double shaftAngle() const noexcept { return motor_.angle(); }            ///< rad at the motor
  double wheelSpeed() const noexcept { return motor_.speed() / ratio(); }  ///< rad/s at the joint
  double wheelAngle() const noexcept { return motor_.angle() / ratio(); }  ///< rad at the joint

  /// A jam: something holds the shaft.
  void setBlocked(bool on) noexcept { motor_.setBlocked(on); }
  /// Revolutions, as the encoder says; without rounding, whatever the bus can carry.
  double position() const noexcept { return inverter_.posicon().position(); }

  ParameterStore& parameters() noexcept { return parameters_; }
  const ParameterStore& parameters() const noexcept { return parameters_; }
  InverterModel& inverter() noexcept { return inverter_; }
  const InverterModel& inverter() const noexcept { return inverter_; }
  PkwServer& pkw() noexcept { return pkw_; }
  const PkwServer& pkw() const noexcept { return pkw_; }

  /// The bus module: its own, or the one it shares.
  BusModule& module() noexcept { return *module_; }
  const BusModule& module() const noexcept { return *module_; }
  /// Its process data move.
  bool inDataExchange() const noexcept { return module_->inDataExchange(); }
  /// Of its station, and of what came for this inverter.
  ExchangeCounters counters() const noexcept { return module_->countersOf(place()); }

 private:
  unsigned place() const noexcept { return config_.place > 0 ? config_.place - 1 : 0; }
  double ratio() const noexcept { return config_.inverted ? -config_.gear_ratio : config_.gear_ratio; }

  DriveConfig config_;
  ParameterStore parameters_;
  Motor motor_;
  InverterModel inverter_;
  PkwServer pkw_;
  BusModule* module_ = nullptr;
  const DriveUnit* leader_ = nullptr;
  bool plugged_ = true;
  ParameterSwitches switches_;
};

}  // namespace nord_driver::sim
