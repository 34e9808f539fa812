// What the module watches, how it tells its inverters, and what it shows of it: BU 2700 7.1.1, 7.1.3, 8.1 and
// BU 0220 4.2.3.

#include "sim/drive_unit.h"
#include "sim/profibus/module_station.h"

namespace nord_driver::sim {

namespace {

// P170: BU 0220 6.2.2.
constexpr std::int32_t kBusTimeout = 1020;
constexpr std::int32_t kProfibusTimeout = 5020;

constexpr std::int32_t kWatchNothing = -1;  // P151; 0: only the control words are not watched (the table of 7.1.1)

// P173.
constexpr unsigned kPreoperational = 1u << 0;
constexpr unsigned kOperational = 1u << 1;
constexpr unsigned kWatchdogExpired = 1u << 2;
constexpr unsigned kTimeout = 1u << 3;
constexpr unsigned kOnline = 2;
constexpr unsigned kLost = 3;

// PKE.
constexpr unsigned kNumberMask = 0x07FF;
constexpr unsigned kNumberOffset = 1000;

}  // namespace

// P151 > 0: no telegram with a valid control word for that long is E10.3 in every inverter.
void ModuleStation::watch(Duration span) noexcept {
  for (unsigned place = 0; place < kPlaces; ++place) places_[place].seen = places_[place].seen || present(place);
  const std::int32_t limit = parameters_.value(151);
  if (limit > 0 && valid_data_seen_) {
    since_valid_ += span;
    if (since_valid_ >= std::chrono::milliseconds(limit)) {
      valid_data_seen_ = false;  // starts anew with the next valid telegram
      timeOut(kBusTimeout);
    }
  }
  endTimeOut();
  showStatus();
}

void ModuleStation::masterLost() noexcept {
  valid_data_seen_ = false;
  for (unsigned place = 0; place < kPlaces; ++place) {
    ExchangeCounters& counters = places_[place].counters;
    counters.control_before_loss = counters.last_control;
    if (driveAt(place) != nullptr) counters.status_at_loss = driveAt(place)->inverter().statusWord();
  }
  if (parameters_.value(151) == kWatchNothing) return;
  timeOut(kProfibusTimeout);
}

void ModuleStation::timeOut(std::int32_t error) noexcept {
  timed_out_ = cause_stands_ = true;
  error_ = error;
  for (unsigned place = 0; place < kPlaces; ++place) {
    if (!present(place)) continue;
    if (error == kProfibusTimeout) {
      driveAt(place)->inverter().masterLost();
    } else {
      driveAt(place)->inverter().moduleTimeout();
    }
  }
}

// "As long as one of the inverters connected is still in the error state ... the technology box remains in the time-out
// error state" (BU 0220 4.2.3.2). One that is switched off has no error any more.
void ModuleStation::endTimeOut() noexcept {
  if (!timed_out_ || cause_stands_) return;
  for (unsigned place = 0; place < kPlaces; ++place) {
    if (present(place) && driveAt(place)->inverter().faultNumber() != 0) return;
  }
  timed_out_ = false;
  parameters_.preset(170, 0, 1, error_);
  error_ = 0;
}

std::int32_t ModuleStation::moduleStatus() const noexcept {
  unsigned status = state() == SlaveState::kDataExchange ? kOperational : kPreoperational;
  if (error_ == kProfibusTimeout) status |= kWatchdogExpired;
  if (error_ == kBusTimeout) status |= kTimeout;
  for (unsigned place = 0; place < kPlaces; ++place) {
    const unsigned code = present(place) ? kOnline : places_[place].seen ? kLost : 0u;
    status |= code << (8 + 2 * place);
  }
  return static_cast<std::int32_t>(status);
}

void ModuleStation::showStatus() noexcept {
  parameters_.show(170, 0, error_);
  parameters_.show(173, 0, moduleStatus());
  parameters_.show(174, 0, settings_.inputs);
  parameters_.show(175, 0, outputs());
  parameters_.show(177, 0, settings_.inputs);
  const bool exchanging = state() == SlaveState::kDataExchange;
  for (unsigned slot = 0; slot <= kPlaces; ++slot) {
    const bool there = exchanging && slot < configuration_.size();
    parameters_.show(182, slot, there ? configuration_[slot] : 0);
  }
  for (unsigned place = 0; place < kPlaces; ++place) {
    if (!present(place)) continue;
    const InverterModel& inverter = driveAt(place)->inverter();
    ParameterStore& parameters = driveAt(place)->parameters();
    parameters_.show(177, 1 + 4 * place, toSigned(inverter.statusWord()));
    parameters.show(741, 0, inverter.statusWord());
    for (unsigned n = 0; n < 3; ++n) {
      const Word value = inverter.actualValue(n);
      parameters_.show(177, 2 + 4 * place + n, toSigned(value));
      parameters.show(741, 1 + n, value);
    }
  }
}

std::optional<std::uint8_t> ModuleStation::recordRefusal(unsigned device, const PkwWords& order,
                                                         bool at_answer) noexcept {
  if (device == 0 || !present(device - 1)) return std::nullopt;
  const unsigned number = (order.pke & kNumberMask) - kNumberOffset;
  const auto code = driveAt(device - 1)->parameterSwitches().busRefusal(number, at_answer);
  if (!code) return std::nullopt;
  return static_cast<std::uint8_t>(*code);
}

PkwWords ModuleStation::executeRecord(unsigned device, const PkwWords& order) noexcept {
  if (device > 0) {
    const unsigned place = device - 1;
    if (!present(place)) return PkwServer::refusal(order, absence(place));
    return driveAt(place)->pkw().executeNow(order);
  }
  showStatus();
  const PkwWords answer = own_pkw_.executeNow(order);
  if (parameters_.value(152) == 1) parameters_.resetToFactory();  // goes back to 0 by itself
  return answer;
}

}  // namespace nord_driver::sim
