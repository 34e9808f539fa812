#include "nord_driver/sim/drive_unit.h"

namespace nord_driver::sim {

namespace {

// P509, control word and setpoint from PROFIBUS: BU 0020 6.2.2, of the older series 6.1.2.
constexpr std::int32_t kProfibus = 4;
constexpr std::int32_t kProfibusOlderSeries = 10;

/// P515 the node id, P551 the profile, P509 CANopen.
void commissionOnCan(const DriveConfig& config, ParameterStore& parameters) noexcept {
  if (config.can->connection != CanConnection::kGateway) parameters.preset(515, 0, 0, config.slave.address);
  parameters.preset(551, 0, 0, config.can->cia402 ? 1 : 0);
  if (config.inverter.bus_source) parameters.preset(509, 0, 0, *config.inverter.bus_source);
}

/// Commissioned as BU 2700 7.2 asks for before it is switched on, then as the configuration says.
void commission(const DriveConfig& config, ParameterStore& parameters) {
  if (config.can) {
    commissionOnCan(config, parameters);
  } else {
    parameters.preset(507, 0, 0, config.slave.ppo_type);
    parameters.preset(508, 0, 0, config.slave.address);
    parameters.preset(509, 0, 0, config.device.isOlderSeries() ? kProfibusOlderSeries : kProfibus);
  }
  for (const ParameterPreset& preset : config.parameters) {
    if (!parameters.preset(preset.number, preset.set, preset.element, preset.raw)) {
      throw ConfigError("drive " + config.name + ": there is no parameter P" + std::to_string(preset.number) +
                        " with set " + std::to_string(preset.set + 1) + " and element " +
                        std::to_string(preset.element + 1));
    }
  }
}

}  // namespace

DriveUnit::DriveUnit(const DriveConfig& config, Referee& referee)
    : config_(config),
      parameters_(config.device),
      motor_(config.motor),
      inverter_(parameters_, motor_, config.inverter),
      pkw_(parameters_, config.pkw),
      slave_(config.slave, parameters_, inverter_, pkw_, &referee) {
  commission(config_, parameters_);
  inverter_.setPowered(true);
  slave_.setPowered(true);
}

void DriveUnit::advance(Duration span) noexcept {
  slave_.advance(span);
  inverter_.advance(span);
}

void DriveUnit::setPlugged(bool plugged) noexcept {
  plugged_ = plugged;
  setInverterPower(plugged);
  slave_.setPowered(plugged);
}

void DriveUnit::setModuleLink(bool intact) noexcept {
  module_link_ = intact;
  slave_.setInverterLink(intact);
}

void DriveUnit::setMute(bool mute) noexcept {
  mute_ = mute;
  slave_.setMute(mute);
}

void DriveUnit::setParameterSwitches(const ParameterSwitches& switches) noexcept {
  switches_ = switches;
  pkw_.setSilent(switches.silent);
  pkw_.refuse(switches.refuse);
}

void DriveUnit::setInverterPower(bool on) noexcept {
  if (on && !inverter_.powered()) pkw_.reset();
  inverter_.setPowered(on);
}

}  // namespace nord_driver::sim
