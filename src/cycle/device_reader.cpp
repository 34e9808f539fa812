#include "nord_driver/cycle/device_reader.h"

#include <algorithm>

#include "nord_driver/profile/parameter_catalogue.h"

namespace nord_driver::cycle {

namespace {

constexpr std::uint8_t kMaxAttempts = 3;
constexpr std::uint16_t kAccelerationTime = 102, kDecelerationTime = 103;
// s: the bus manuals name no unit of P103, which is set in the steps of P102 on the inverter.
constexpr double kRampStep = 0.01;
constexpr std::uint16_t kMaxFrequency = 105, kOptionMonitoring = 120, kModuleTimeout = 151, kTelegramTimeout = 513,
                        kFirstActualValue = 543, kFirstSetpoint = 546, kEepromSwitch = 560, kSoftwareVersion = 707;

bool isArray(profile::ParameterShape shape) noexcept {
  return shape == profile::ParameterShape::kArray || shape == profile::ParameterShape::kArrayPerSet;
}

}  // namespace

DeviceReader::DeviceReader(profile::Series series, TimeoutOwner owner) noexcept : series_(series) {
  for (std::uint8_t set = 1; set <= 4; ++set) add(kMaxFrequency, set, 1);
  add(kTelegramTimeout, 1, 1);
  if (owner == TimeoutOwner::kModule) {
    add(kModuleTimeout, 1, 1);
    add(kOptionMonitoring, 1, 1);
  }
  add(kEepromSwitch, 1, 1);
  add(kSoftwareVersion, 1, 1);
  add(kSoftwareVersion, 1, 2);
  addFunctions(kFirstActualValue);
  addFunctions(kFirstSetpoint);
  for (std::uint8_t set = 1; set <= 4; ++set) {
    add(kAccelerationTime, set, 1);
    add(kDecelerationTime, set, 1);
  }
}

void DeviceReader::add(std::uint16_t number, std::uint8_t set, std::uint8_t index) noexcept {
  if (profile::findParameter(number, series_) != nullptr) items_.push_back({number, set, index});
}

// Functions 1..3: three parameters on SK 500E-535E, one array on the others (BU 2700 6.4.4).
void DeviceReader::addFunctions(std::uint16_t first_number) noexcept {
  const profile::ParameterInfo* info = profile::findParameter(first_number, series_);
  if (info == nullptr) return;
  for (std::uint8_t i = 0; i < 3; ++i) {
    if (isArray(info->shape)) {
      add(first_number, 1, static_cast<std::uint8_t>(i + 1));
    } else {
      add(static_cast<std::uint16_t>(first_number + i), 1, 1);
    }
  }
}

void DeviceReader::handleOffline() noexcept {
  waiting_ = false;
  restart_ = true;
}

bool DeviceReader::maxFrequenciesAsked() const noexcept {
  if (restart_) return false;
  if (data_.complete) return true;
  for (std::size_t i = next_; i < items_.size(); ++i) {
    if (items_[i].number == kMaxFrequency) return false;
  }
  return true;
}

bool DeviceReader::missesMaxFrequency() const noexcept {
  if (restart_ || next_ != items_.size()) return false;
  return std::any_of(items_.begin(), items_.end(), [](const Item& item) { return item.due; });
}

std::optional<profile::ParameterRequest> DeviceReader::pollRequest() noexcept {
  if (waiting_) return std::nullopt;
  if (restart_) {
    restart_ = false;
    next_ = 0;
    attempts_ = 0;
    data_ = {};
    for (Item& item : items_) item.due = true;
  }
  while (next_ != items_.size() && !items_[next_].due) ++next_;
  if (next_ == items_.size()) {
    data_.complete = true;
    return std::nullopt;
  }
  const Item& item = items_[next_];
  waiting_ = true;
  return profile::readRequest(*profile::findParameter(item.number, series_), item.set, item.index);
}

void DeviceReader::handleResult(const profile::ParameterResult& result) noexcept {
  if (!waiting_) return;
  waiting_ = false;
  // Not asked at all: the question is still to be put.
  if (result.outcome == profile::ParameterOutcome::kBusy || result.outcome == profile::ParameterOutcome::kOffline) {
    return;
  }
  const bool timed_out = result.outcome == profile::ParameterOutcome::kTimeout;
  if (timed_out && ++attempts_ < kMaxAttempts) return;
  items_[next_].due = timed_out && items_[next_].number == kMaxFrequency;
  if (result.outcome == profile::ParameterOutcome::kDone) {
    store(items_[next_], result.raw);
  } else {
    leaveOut(items_[next_]);
  }
  attempts_ = 0;
  ++next_;
}

void DeviceReader::store(const Item& item, std::int32_t raw) noexcept {
  const double value = profile::toValue(*profile::findParameter(item.number, series_), raw);
  if (item.number == kMaxFrequency) {
    if (value > 0.0) data_.max_frequency[item.set - 1u] = value;
  } else if (item.number == kTelegramTimeout) {
    data_.telegram_timeout = value;
  } else if (item.number == kModuleTimeout) {
    data_.module_timeout = value;
  } else if (item.number == kOptionMonitoring) {
    data_.option_monitoring = raw;
  } else if (item.number == kEepromSwitch) {
    data_.saves_in_eeprom = raw != 0;
  } else if (item.number == kSoftwareVersion) {
    (item.index == 1 ? data_.software_version : data_.software_revision) = raw;
  } else if (item.number == kAccelerationTime) {
    data_.acceleration_time[item.set - 1u] = value;
  } else if (item.number == kDecelerationTime) {
    data_.deceleration_time[item.set - 1u] = raw * kRampStep;
  } else if (auto* functions = functionsOf(item)) {
    functions->push_back(static_cast<std::uint16_t>(raw));
  }
}

// They are asked for in their order: one that stays away must not let the next take its place.
void DeviceReader::leaveOut(const Item& item) noexcept {
  if (auto* functions = functionsOf(item)) functions->push_back(kUnknownFunction);
}

FixedVector<std::uint16_t, 3>* DeviceReader::functionsOf(const Item& item) noexcept {
  if (item.number >= kFirstSetpoint && item.number < kFirstSetpoint + 3) return &data_.setpoint_functions;
  if (item.number >= kFirstActualValue && item.number < kFirstSetpoint) return &data_.actual_value_functions;
  return nullptr;
}

}  // namespace nord_driver::cycle
