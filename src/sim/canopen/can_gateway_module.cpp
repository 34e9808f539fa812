#include "sim/canopen/can_gateway_module.h"

#include <algorithm>

#include "sim/module_parameters.h"

namespace nord_driver::sim {

namespace {

constexpr std::int32_t kWatchNothing = -1;  // P151
// P170 shows 102.0 for P151 (BU 0220 6.2.2). The module has no number of its own for a lost CANopen master that could
// be read: 103.0 is bus off.
constexpr std::int32_t kBusTimeout = 1020;
constexpr std::int32_t kBusLost = 1030;

/// Those of the PROFIBUS module without what belongs to PROFIBUS.
std::vector<ParameterDefinition> definitions() {
  std::vector<ParameterDefinition> all = moduleParameterDefinitions();
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const ParameterDefinition& d) { return d.number == 160 || d.number >= 176; }),
            all.end());
  return all;
}

bool isPresent(const DriveUnit* drive) noexcept {
  return drive != nullptr && drive->inverter().powered() && drive->inverterLink();
}

}  // namespace

CanGatewayModule::CanGatewayModule() : parameters_(definitions()), objects_(parameters_, nullptr, false) {}

void CanGatewayModule::restart() noexcept {
  parameters_.restoreFromEeprom();
  valid_seen_ = timed_out_ = cause_stands_ = false;
  error_ = 0;
}

void CanGatewayModule::validWord() noexcept {
  valid_seen_ = true;
  cause_stands_ = false;
  since_valid_ = Duration::zero();
}

void CanGatewayModule::timeOut(std::int32_t error) noexcept {
  timed_out_ = cause_stands_ = true;
  valid_seen_ = false;  // watched again from the next valid word on
  error_ = error;
}

void CanGatewayModule::masterLost(const Drives& drives) noexcept {
  if (parameters_.value(151) == kWatchNothing) return;
  timeOut(kBusLost);
  for (DriveUnit* drive : drives) {
    if (isPresent(drive)) drive->inverter().masterLost();
  }
}

void CanGatewayModule::watch(Duration span, const Drives& drives) noexcept {
  const std::int32_t limit = parameters_.value(151);
  if (limit > 0 && valid_seen_) {
    since_valid_ += span;
    if (since_valid_ >= std::chrono::milliseconds{limit}) {
      timeOut(kBusTimeout);
      for (DriveUnit* drive : drives) {
        if (isPresent(drive)) drive->inverter().moduleTimeout();
      }
    }
  }
  const bool faulty = std::any_of(drives.begin(), drives.end(), [](const DriveUnit* drive) {
    return isPresent(drive) && drive->inverter().faultNumber() != 0;
  });
  if (timed_out_ && !cause_stands_ && !faulty) {
    timed_out_ = false;
    parameters_.preset(170, 0, 1, error_);
    error_ = 0;
  }
  parameters_.show(170, 0, error_);
}

}  // namespace nord_driver::sim
