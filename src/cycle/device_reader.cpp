#include "cycle/device_reader.h"

#include <algorithm>
#include <utility>

#include "profile/cycle_parameters.h"
#include "profile/parameter_shape.h"

namespace nord_driver::cycle {

namespace {

constexpr std::uint8_t kMaxAttempts = 3;
constexpr std::uint16_t kMinFrequency = 104, kMaxFrequency = 105, kOptionMonitoring = 120, kBusBits = 480,
                        kOutBits = 481, kControlWordSource = 509, kSetpointSource = 510, kTelegramTimeout = 513,
                        kFirstActualValue = 543, kFirstSetpoint = 546, kPositionControl = 600, kSpeedRatio = 607,
                        kReduction = 608, kSetpointMode = 610, kSoftwareVersion = 707;
constexpr std::uint8_t kSets = 4;
constexpr std::uint16_t kAccelerationTime = 102, kDecelerationTime = 103;

// Another answer may come later: the inverter was off for a moment, and its module is there.
bool mayChange(const profile::ParameterResult& result) noexcept {
  if (result.outcome == profile::ParameterOutcome::kTimeout) return true;
  return result.outcome == profile::ParameterOutcome::kRefused && mayPass(result.reason);
}

}  // namespace

DeviceReader::DeviceReader(profile::Series series, TimeoutOwner owner, bool further_words, bool positions,
                           std::uint8_t out_bit) noexcept
    : series_(series) {
  for (std::uint8_t set = 1; set <= kSets; ++set) add({kMaxFrequency, set});
  for (std::uint8_t set = 1; set <= kSets; ++set) add({kMinFrequency, set});
  for (std::uint8_t set = 1; set <= kSets; ++set) addFunction(kFirstActualValue, 0, set);
  for (std::uint8_t set = 1; set <= kSets; ++set) addFunction(kFirstSetpoint, 0, set);
  if (further_words) {
    for (std::uint8_t set = 1; set <= kSets; ++set) addFurtherFunctions(set);
    addBusBits();
  }
  for (std::uint8_t set = 1; set <= kSets; ++set) add({kPositionControl, set});
  if (positions) add({kSetpointMode});
  if (out_bit != 0) addElement(kOutBits, out_bit);
  add({kControlWordSource});
  add({kSetpointSource});
  motion_items_ = items_.size();
  add({kTelegramTimeout});
  if (owner == TimeoutOwner::kModule) {
    add({kModuleTimeout});
    add({kOptionMonitoring});
  }
  add({kEepromSwitch});
  add({kSoftwareVersion});
  addElement(kSoftwareVersion, 2);
  if (!further_words) {
    addFurtherFunctions(1);
    addBusBits();
  }
  for (std::uint8_t set = 1; set <= kSets && positions; ++set) {
    add({kSpeedRatio, set});
    add({kReduction, set});
  }
  for (std::uint8_t set = 1; set <= kSets; ++set) {
    add({kAccelerationTime, set});
    add({kDecelerationTime, set});
  }
}

void DeviceReader::add(const Item& item) noexcept {
  if (profile::findCycleParameter(item.number, series_) != nullptr) items_.push_back(item);
}

void DeviceReader::addElement(std::uint16_t number, std::uint8_t index) noexcept {
  Item item{number};
  item.index = index;
  add(item);
}

// Functions 1..3: three parameters on SK 500E-535E, one array on the others (BU 2700 6.4.4).
void DeviceReader::addFunction(std::uint16_t first_number, std::uint8_t place, std::uint8_t set) noexcept {
  const profile::CycleParameter* info = profile::findCycleParameter(first_number, series_);
  if (info != nullptr && profile::isArray(info->shape)) {
    add({first_number, set, static_cast<std::uint8_t>(place + 1)});
  } else {
    add({static_cast<std::uint16_t>(first_number + place), set});
  }
}

void DeviceReader::addFurtherFunctions(std::uint8_t set) noexcept {
  for (std::uint8_t place = 1; place < 3; ++place) addFunction(kFirstActualValue, place, set);
  for (std::uint8_t place = 1; place < 3; ++place) addFunction(kFirstSetpoint, place, set);
}

void DeviceReader::addBusBits() noexcept {
  const profile::CycleParameter* info = profile::findCycleParameter(kBusBits, series_);
  for (std::uint8_t i = 1; info != nullptr && i <= info->elements; ++i) addElement(kBusBits, i);
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

bool DeviceReader::motionAsked() const noexcept {
  return !restart_ && (data_.complete || next_ >= motion_items_);
}

// Without P105, which a typed one may take the place of, nothing is enabled anyway.
bool DeviceReader::motionKnown() const noexcept {
  if (!motionAsked()) return false;
  const unsigned rounds = rounds_ + (next_ >= motion_items_ ? 1u : 0u);
  if (!answered_ || rounds > kAwaitedRounds) return true;
  return std::none_of(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(motion_items_),
                      [](const Item& item) { return item.due && item.number != kMaxFrequency; });
}

bool DeviceReader::missesMotion(bool max_frequencies) const noexcept {
  // Beside others that are asked for again.
  if (restart_ || next_ < motion_items_ || (!data_.complete && next_ != items_.size())) return false;
  const auto end = items_.begin() + static_cast<std::ptrdiff_t>(motion_items_);
  return std::any_of(items_.begin(), end, [max_frequencies](const Item& item) {
    return item.due && (max_frequencies || item.number != kMaxFrequency);
  });
}

void DeviceReader::askAgain(std::uint16_t number) noexcept {
  const bool told =
      number == kOptionMonitoring || number == kModuleTimeout || number == kTelegramTimeout || number == kEepromSwitch;
  if (restart_ || !told) return;
  if (number == kEepromSwitch) data_.saves_in_eeprom.reset();
  for (std::size_t i = motion_items_; i < items_.size(); ++i) {
    if (items_[i].number != number) continue;
    items_[i].due = true;
    next_ = std::min(next_, i);
    outdated_ = outdated_ || (waiting_ && asked_ == i);
  }
}

void DeviceReader::askMissingAgain(bool max_frequencies) noexcept {
  for (Item& item : items_) {
    if (item.number == kMaxFrequency && !max_frequencies) item.due = false;
  }
  silent_ = false;
  next_ = 0;
  if (rounds_ <= kAwaitedRounds) ++rounds_;
}

std::optional<profile::ParameterRequest> DeviceReader::pollRequest() noexcept {
  if (waiting_) return std::nullopt;
  if (restart_) {
    restart_ = false;
    next_ = 0;
    attempts_ = 0;
    outdated_ = false;
    silent_ = false;
    answered_ = false;
    rounds_ = 0;
    data_ = {};
    for (Item& item : items_) item.due = true;
  }
  while (next_ != items_.size() && !items_[next_].due) ++next_;
  if (next_ == items_.size()) {
    data_.complete = true;
    return std::nullopt;
  }
  const Item& item = items_[next_];
  asked_ = next_;
  waiting_ = true;
  auto request = profile::readRequest(*profile::findCycleParameter(item.number, series_), item.set, item.index);
  request.scales = item.number == kMaxFrequency;
  return request;
}

void DeviceReader::handleResult(const profile::ParameterResult& result) noexcept {
  if (!waiting_) return;
  waiting_ = false;
  if (std::exchange(outdated_, false)) return;
  // Not asked at all: the question is still to be put.
  if (result.outcome == profile::ParameterOutcome::kBusy || result.outcome == profile::ParameterOutcome::kOffline) {
    return;
  }
  const bool timed_out = result.outcome == profile::ParameterOutcome::kTimeout;
  if (timed_out && ++attempts_ < (silent_ ? 1 : kMaxAttempts)) return;
  silent_ = timed_out;
  answered_ = answered_ || !timed_out;
  items_[asked_].due = mayChange(result) && asked_ < motion_items_;
  if (result.outcome == profile::ParameterOutcome::kDone) store(items_[asked_], result.raw);
  attempts_ = 0;
  if (next_ == asked_) ++next_;  // set back meanwhile, it stays there
}

void DeviceReader::store(const Item& item, std::int32_t raw) noexcept {
  const double value = profile::toValue(*profile::findCycleParameter(item.number, series_), raw);
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
  } else if (item.number == kControlWordSource) {
    data_.control_word_source = raw;
  } else if (item.number == kSetpointSource) {
    data_.setpoint_source = raw;
  } else if (item.number == kPositionControl) {
    data_.position_control[item.set - 1u] = raw;
  } else if (item.number == kSetpointMode) {
    data_.setpoint_mode = raw;
  } else if (item.number == kSpeedRatio) {
    data_.speed_ratio[item.set - 1u] = raw;
  } else if (item.number == kReduction) {
    data_.reduction[item.set - 1u] = raw;
  } else if (item.number == kMinFrequency) {
    data_.min_frequency[item.set - 1u] = value;
  } else if (item.number == kOutBits) {
    data_.out_bit_function = static_cast<std::uint16_t>(raw);
  } else if (item.number == kBusBits) {
    while (data_.bus_bit_functions.size() < item.index) data_.bus_bit_functions.push_back(kUnknownFunction);
    data_.bus_bit_functions[item.index - 1u] = static_cast<std::uint16_t>(raw);
  } else if (item.number == kAccelerationTime) {
    data_.acceleration_time[item.set - 1u] = value;
  } else if (item.number == kDecelerationTime) {
    data_.deceleration_time[item.set - 1u] = value;
  } else {
    storeFunction(item, static_cast<std::uint16_t>(raw));
  }
}

void DeviceReader::storeFunction(const Item& item, std::uint16_t function) noexcept {
  const bool actual_value = item.number < kFirstSetpoint;
  const unsigned parameter = item.number - unsigned{actual_value ? kFirstActualValue : kFirstSetpoint};
  const std::size_t place = parameter + item.index - 1u;
  WordFunctions& words = data_.word_functions[item.set - 1u];
  // Whatever is read one day beside these: nothing is written beyond the places.
  if (place < words.setpoints.size()) (actual_value ? words.actual_values : words.setpoints)[place] = function;
}

}  // namespace nord_driver::cycle
