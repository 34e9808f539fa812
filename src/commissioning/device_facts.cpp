#include "commissioning/device_facts.h"

#include <cmath>

#include "commissioning/drive_under_check.h"
#include "profile/cycle_parameters.h"

namespace nord_driver::commissioning {

namespace {

constexpr double kRampStep = 0.01;  // s, of P102 and P103
constexpr std::uint8_t kSets = 4, kPlaces = 3;

class Collector {
 public:
  Collector(const AskedDrive& asked, const catalogue::DriveCatalogue& known) : drive_(asked, known, {}, 1) {}

  /// `value` in units of `step`.
  void store(const ParameterKey& key, std::optional<double> value, double step) {
    if (value) facts_.store(key, static_cast<std::int32_t>(std::lround(*value / step)));
  }
  void storeOrMissing(const ParameterKey& key, std::optional<double> value) {
    const auto* info = profile::findCycleParameter(key.number, drive_.asked().series);
    if (info == nullptr) return;
    if (!value) return facts_.storeUnreadable(key);
    store(key, value, info->resolution);
  }
  template <typename Raw>
  void storeRaw(const ParameterKey& key, std::optional<Raw> raw) {
    if (raw) facts_.store(key, *raw);
  }
  void storeFunction(const ParameterKey& key, std::optional<std::uint16_t> function) {
    if (function && *function != cycle::kUnknownFunction) return facts_.store(key, *function);
    facts_.storeUnreadable(key);
  }
  const DriveUnderCheck& drive() const noexcept { return drive_; }
  CommissioningFacts take() { return std::move(facts_); }

 private:
  DriveUnderCheck drive_;
  CommissioningFacts facts_;
};

void collectPerSet(const cycle::DeviceData& device, std::uint8_t set, Collector& to) {
  const DriveUnderCheck& drive = to.drive();
  const std::size_t i = set - 1u;
  to.storeOrMissing(drive.key(105, set), device.max_frequency[i]);
  to.storeOrMissing(drive.key(104, set), device.min_frequency[i]);
  to.store(drive.key(102, set), device.acceleration_time[i], kRampStep);
  to.store(drive.key(103, set), device.deceleration_time[i], kRampStep);
  to.storeFunction(drive.functionKey(543, 0, set), device.word_functions[i].actual_values[0]);
  to.storeFunction(drive.functionKey(546, 0, set), device.word_functions[i].setpoints[0]);
  to.storeRaw(drive.key(600, set), device.position_control[i]);
}

}  // namespace

CommissioningFacts deviceFacts(const cycle::DeviceData& device, const AskedDrive& asked,
                               const catalogue::DriveCatalogue& known) {
  if (!device.complete) return {};
  Collector to(asked, known);
  const DriveUnderCheck& drive = to.drive();
  for (std::uint8_t set = 1; set <= kSets; ++set) collectPerSet(device, set, to);
  for (std::uint8_t place = 1; place < kPlaces; ++place) {
    to.storeFunction(drive.functionKey(543, place, 1), device.word_functions[0].actual_values[place]);
    to.storeFunction(drive.functionKey(546, place, 1), device.word_functions[0].setpoints[place]);
  }
  for (std::size_t bit = 0; bit < device.bus_bit_functions.size(); ++bit) {
    to.storeFunction(drive.key(480, 0, static_cast<std::uint8_t>(bit + 1)), device.bus_bit_functions[bit]);
  }
  if (asked.words.out_bit != 0) to.storeRaw(drive.key(481, 0, asked.words.out_bit), device.out_bit_function);
  to.storeOrMissing(drive.key(513), device.telegram_timeout);
  if (asked.identity.timeout_owner == TimeoutOwner::kModule) {
    to.storeOrMissing(drive.key(151), device.module_timeout);
    to.storeRaw(drive.key(120), device.option_monitoring);
  }
  to.storeRaw(drive.key(509), device.control_word_source);
  to.storeRaw(drive.key(510), device.setpoint_source);
  to.storeRaw(drive.key(560), device.saves_in_eeprom);
  for (std::uint8_t set = 1; set <= kSets && asked.words.positions; ++set) {
    to.storeRaw(drive.key(607, set), device.speed_ratio[set - 1u]);
    to.storeRaw(drive.key(608, set), device.reduction[set - 1u]);
  }
  if (asked.words.positions) to.storeRaw(drive.key(610), device.setpoint_mode);
  return to.take();
}

}  // namespace nord_driver::commissioning
