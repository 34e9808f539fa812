// Faults: how they come, how they stand and how they go. BU 2700 7.1.1 and 8, BU 0020 8.

#include "sim/inverter/inverter_model.h"

namespace nord_driver::sim {

namespace {

constexpr std::int32_t kInputAcknowledge = 12;  // P420.., BU 0020 8
constexpr int kAcknowledgeAlways = 6;           // P506
constexpr std::int32_t kWatchFromStart = 2;     // P120
constexpr double kWaitForModule = 5.0;          // s in "not ready", BU 0280 5.1.1

}  // namespace

void InverterModel::masterLost() noexcept {
  if (!powered() || ignoresBusErrors()) return;
  master_lost_ = true;
  trip(wiring_.master_lost_fault, false);
}

void InverterModel::moduleTimeout() noexcept {
  if (!powered() || ignoresBusErrors()) return;
  timed_out_ = true;
  trip(fault::kTimeout, false);
}

void InverterModel::setModuleLink(bool intact) noexcept {
  const bool was_broken = link_broken_;
  link_broken_ = !intact;
  if (intact) link_fault_ = false;
  if (intact || was_broken || !powered() || !watchesModule()) return;
  link_fault_ = true;
  trip(wiring_.on_system_bus ? fault::kNoModule : fault::kModuleLink, false);
}

// A module on the rack is always watched; on the system bus P120[-01] decides: 0 off, 1 once it was there, 2 from mains
// on (BU 0280 5.1.1).
bool InverterModel::watchesModule() const noexcept {
  if (ignoresBusErrors()) return false;
  return !wiring_.on_system_bus || parameters_.value(120) != 0;
}

void InverterModel::waitForStart() noexcept {
  const bool module_missing =
      wiring_.on_system_bus && link_broken_ && watchesModule() && parameters_.value(120) == kWatchFromStart;
  if (module_missing) {
    if (in_state_ < kWaitForModule) return;
    link_fault_ = true;
    return trip(fault::kNoModule, false);
  }
  if (in_state_ >= settings_.charging_time) enter(InverterState::kSwitchOnDisabled);  // 1
}

// P513 > 0: no control word with bit 10 = 1 for that long is E10.3 (BU 2700 7.1.1, 8.3), in the older series E10.0
// (BU 0020 8.1). Behind SK CU4/TU4 it is P151 of the module that watches the field bus (BU 2700 8.1).
void InverterModel::watchTimeout(double dt) noexcept {
  if (wiring_.on_system_bus) return;
  since_valid_ += dt;
  const double limit = parameters_.scaled(513);
  if (!commanded_ || limit <= 0.0 || timed_out_ || since_valid_ < limit) return;
  timed_out_ = true;
  trip(parameters_.device().isOlderSeries() ? fault::kBusTimeout : wiring_.timeout_fault, false);
}

bool InverterModel::ignoresBusErrors() const noexcept {
  return parameters_.value(513) < 0;
}

void InverterModel::trip(std::uint16_t number, bool cause_stays) noexcept {
  if (!powered()) return;
  tripped_cause_ = tripped_cause_ || cause_stays;
  if (state_ == InverterState::kFault || state_ == InverterState::kFaultReactionActive) return;
  fault_ = number;
  setWarning(0);
  // The history survives the mains, so it is not only shown.
  for (unsigned i = 4; i > 0; --i) parameters_.preset(701, 0, i, parameters_.value(701, 0, i - 1));
  parameters_.preset(701, 0, 0, number);
  parameters_.show(700, 0, number);
  enter(InverterState::kFaultReactionActive);  // 13
}

void InverterModel::setWarning(std::uint16_t number) noexcept {
  warning_ = number;
  parameters_.show(700, 1, number);
}

bool InverterModel::causeStands() const noexcept {
  return tripped_cause_ || master_lost_ || timed_out_ || link_fault_;
}

bool InverterModel::acknowledge() noexcept {
  if (state_ != InverterState::kFault || causeStands()) return false;
  fault_ = 0;
  parameters_.show(700, 0, 0);
  enter(InverterState::kSwitchOnDisabled);  // 15
  return true;
}

// P506: 1-5 times since mains on, 6 always. The counts are not in the bus manuals; 7 acts like 0 here.
void InverterModel::acknowledgeByItself() noexcept {
  const int allowed = parameters_.value(506);
  if (allowed <= 0 || allowed > kAcknowledgeAlways) return;
  if (in_state_ < settings_.automatic_acknowledgement_delay) return;
  if (allowed < kAcknowledgeAlways && automatic_acknowledgements_ >= allowed) return;
  if (acknowledge()) ++automatic_acknowledgements_;
}

bool InverterModel::inputAcknowledges() const noexcept {
  // SK 2xxE has one array for its inputs (BU 0220 5.1.2).
  for (unsigned element = 1; element < 4; ++element) {
    if (parameters_.value(420, 0, element) == kInputAcknowledge) return true;
  }
  for (unsigned number = 420; number <= 425; ++number) {
    if (parameters_.value(number) == kInputAcknowledge) return true;
  }
  return false;
}

std::uint16_t InverterModel::switchOnBlock() const noexcept {
  if (state_ == InverterState::kNotReadyToSwitchOn) return block::kCharging;
  if (state_ != InverterState::kSwitchOnDisabled) return block::kNone;
  if (terminals_.coast) return block::kVoltageByTerminals;
  if (terminals_.quick_stop) return block::kQuickStopByTerminals;
  if (!busControl() || !commanded_) return block::kNone;
  if ((data_.control & stw::kNoOff2) == 0) return block::kVoltageByBus;
  if ((data_.control & stw::kNoOff3) == 0) return block::kQuickStopByBus;
  return (data_.control & stw::kOn) != 0 ? block::kStandingEnable : block::kNone;
}

}  // namespace nord_driver::sim
