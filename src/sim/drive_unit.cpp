#include "sim/drive_unit.h"

namespace nord_driver::sim {

namespace {

// P509, control word and setpoint from PROFIBUS: BU 0020 6.2.2, of the older series 6.1.2.
constexpr std::int32_t kProfibus = 4;
constexpr std::int32_t kProfibusOlderSeries = 10;
// Through a module on the system bus: BU 2700 7.2.
constexpr std::int32_t kSystemBus = 3;
constexpr std::int32_t kCanopen = 6;

std::int32_t controlWordSource(const DriveConfig& config) {
  if (config.place > 0) return config.device.isDecentral() ? kSystemBus : kCanopen;
  return config.device.isOlderSeries() ? kProfibusOlderSeries : kProfibus;
}

InverterSettings onSystemBus(InverterSettings settings) {
  settings.on_system_bus = true;
  return settings;
}

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
    parameters.preset(509, 0, 0, controlWordSource(config));
  }
  for (unsigned element = 1; element < 5; ++element) {  // where these are arrays only the first one has a function
    for (unsigned set = 0; set < ParameterStore::kSets; ++set) {
      parameters.preset(543, set, element, 0);
      parameters.preset(546, set, element, 0);
    }
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
      pkw_(parameters_, config.pkw) {
  own_.emplace(config.slave, parameters_, inverter_, pkw_, &referee);
  switches_.delay = config.pkw.delay;
  commission(config_, parameters_);
  inverter_.setPowered(true);
  own_->setPowered(true);
}

DriveUnit::DriveUnit(const DriveConfig& config, ModuleStation& module)
    : config_(config),
      parameters_(config.device),
      motor_(config.motor),
      inverter_(parameters_, motor_, onSystemBus(config.inverter)),
      pkw_(parameters_, config.pkw),
      module_(&module) {
  switches_.delay = config.pkw.delay;
  commission(config_, parameters_);
  inverter_.setPowered(true);
  module_->attach(place(), parameters_, inverter_, pkw_, config_.slave.ppo_type);
}

void DriveUnit::advance(Duration span) noexcept {
  if (own_) own_->advance(span);  // a shared module is advanced once for all its drives
  inverter_.advance(span);
}

void DriveUnit::setPlugged(bool plugged) noexcept {
  plugged_ = plugged;
  setInverterPower(plugged);
  if (own_) own_->setPowered(plugged);
}

void DriveUnit::setMute(bool mute) noexcept {
  mute_ = mute;
  slave().setMute(mute);
}

void DriveUnit::setParameterSwitches(const ParameterSwitches& switches) noexcept {
  switches_ = switches;
  pkw_.setDelay(switches.delay);
  pkw_.setSilent(switches.silent);
  pkw_.refuse(switches.refuse);
}

void DriveUnit::setInverterPower(bool on) noexcept {
  if (on && !inverter_.powered()) pkw_.reset();
  inverter_.setPowered(on);
}

void DriveUnit::setInverterLink(bool intact) noexcept {
  inverter_link_ = intact;
  if (module_ != nullptr) {
    module_->setInverterLink(place(), intact);
  } else {
    own_->setInverterLink(intact);
  }
}

bool DriveUnit::inDataExchange() const noexcept {
  return config_.can ? exchanging_ : slave().state() == SlaveState::kDataExchange;
}

void DriveUnit::showExchange(bool moving, const SlaveCounters& counters) noexcept {
  exchanging_ = moving;
  exchanged_ = counters;
}

SlaveCounters DriveUnit::counters() const noexcept {
  if (config_.can) return exchanged_;
  return module_ != nullptr ? module_->countersOf(place()) : own_->counters();
}

}  // namespace nord_driver::sim
