#include "sim/drive_unit.h"

namespace nord_driver::sim {

DriveUnit::DriveUnit(const DriveConfig& config)
    : config_(config),
      parameters_(config.device),
      motor_(config.motor),
      inverter_(parameters_, motor_, config.inverter),
      pkw_(parameters_, config.pkw) {
  switches_.delay = config.pkw.delay;
}

// Commissioned as the manual of the bus asks for before it is switched on, then as the configuration says.
void DriveUnit::connect(BusModule& module, const Commissioning& commissioning) {
  inverter_.wire(commissioning.wiring);
  for (const ParameterPreset& preset : commissioning.parameters) {
    parameters_.preset(preset.number, preset.set, preset.element, preset.raw);
  }
  for (unsigned element = 1; element < 5; ++element) {  // where these are arrays only the first one has a function
    for (unsigned set = 0; set < ParameterStore::kSets; ++set) {
      parameters_.preset(543, set, element, 0);
      parameters_.preset(546, set, element, 0);
    }
  }
  for (const ParameterPreset& preset : config_.parameters) {
    if (!parameters_.preset(preset.number, preset.set, preset.element, preset.raw)) {
      throw ConfigError("drive " + config_.name + ": there is no parameter P" + std::to_string(preset.number) +
                        " with set " + std::to_string(preset.set + 1) + " and element " +
                        std::to_string(preset.element + 1));
    }
  }
  module_ = &module;
  inverter_.setPowered(true);
  module_->connect(*this, place());
}

void DriveUnit::setPlugged(bool plugged) noexcept {
  plugged_ = plugged;
  setInverterPower(plugged);
  module_->inverterPlugged(plugged);
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

}  // namespace nord_driver::sim
