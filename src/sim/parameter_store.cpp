#include "nord_driver/sim/parameter_store.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

constexpr bool kPerSet = true;
constexpr bool kReadOnly = true;

}  // namespace

// Ranges and factory settings where BU 0020 6.2, BU 0220 5.1 or BU 0280 5.1 print them. The chapters with P102-P112,
// P420, P426 and P506 are in the inverters' own manuals: their ranges here are the simulator's, only the resolution is
// NORD's.
const std::vector<ParameterDefinition>& parameterDefinitions() {
  static const std::vector<ParameterDefinition> definitions{
      // number, name, divisor, min, max, factory, per set, elements, read only
      {102, "Acceleration time", 100, 0, 32000, 200, kPerSet, 0, false},
      {103, "Deceleration time", 100, 0, 32000, 200, kPerSet, 0, false},
      {104, "Minimum frequency", 10, 0, 4000, 0, kPerSet, 0, false},
      {105, "Maximum frequency", 10, 1, 4000, 500, kPerSet, 0, false},
      {112, "Torque current limit", 1, 25, 400, 100, kPerSet, 0, false},
      {120, "Option monitoring", 1, 0, 2, 1, false, 4, false},
      {420, "Digital input 1", 1, 0, 77, 0, false, 0, false},
      {421, "Digital input 2", 1, 0, 77, 0, false, 0, false},
      {422, "Digital input 3", 1, 0, 77, 0, false, 0, false},
      {423, "Digital input 4", 1, 0, 77, 0, false, 0, false},
      {424, "Digital input 5", 1, 0, 77, 0, false, 0, false},
      {425, "Digital input 6", 1, 0, 77, 0, false, 0, false},
      {426, "Quick stop time", 100, 0, 32000, 10, kPerSet, 0, false},
      {506, "Automatic acknowledgement", 1, 0, 7, 0, false, 0, false},
      {507, "PPO type", 1, 1, 4, 1, false, 0, false},
      {508, "Profibus address", 1, 1, 126, 1, false, 0, false},
      {509, "Control word source", 1, 0, 10, 0, false, 0, false},
      {510, "Setpoint source", 1, 0, 10, 0, false, 2, false},
      {513, "Telegram time-out", 10, -1, 1000, 0, false, 0, false},
      {514, "CAN baud rate", 1, 0, 7, 5, false, 0, false},
      {515, "CAN address", 1, 0, 255, 32, false, 3, false},
      {543, "Bus actual value 1", 1, 0, 24, 1, kPerSet, 0, false},
      {544, "Bus actual value 2", 1, 0, 24, 0, kPerSet, 0, false},
      {545, "Bus actual value 3", 1, 0, 24, 0, kPerSet, 0, false},
      {546, "Bus setpoint 1", 1, 0, 55, 1, kPerSet, 0, false},
      {547, "Bus setpoint 2", 1, 0, 55, 0, kPerSet, 0, false},
      {548, "Bus setpoint 3", 1, 0, 55, 0, kPerSet, 0, false},
      {560, "Save in EEPROM", 1, 0, 1, 1, false, 0, false},
      {700, "Current fault", 10, 0, 9999, 0, false, 3, kReadOnly},
      {701, "Last faults", 10, 0, 9999, 0, false, 5, kReadOnly},
      {707, "Software version", 10, 0, 9999, 20, false, 2, kReadOnly},
      {740, "Process data bus in", 1, 0, 0xFFFF, 0, false, 13, kReadOnly},
      {741, "Process data bus out", 1, 0, 0xFFFF, 0, false, 13, kReadOnly},
      {742, "Database version", 1, 0, 9999, 1, false, 0, kReadOnly},
      {743, "Inverter power", 100, 0, 32000, 150, false, 0, kReadOnly},
      {744, "Configuration", 1, 0, 0xFFFF, 0, false, 0, kReadOnly},
      {745, "Module version", 10, 0, 9999, 10, false, 0, kReadOnly},
      {746, "Module status", 1, 0, 0xFFFF, 0x0600, false, 0, kReadOnly},
      {747, "Voltage range", 1, 0, 0xFFFF, 0x23, false, 0, kReadOnly},
      {748, "CANopen status", 1, 0, 0xFFFF, 0, false, 3, kReadOnly},
      {749, "DIP switches", 1, 0, 0x1FF, 0, false, 0, kReadOnly},
  };
  return definitions;
}

ParameterStore::ParameterStore() {
  index_.fill(-1);
  const std::vector<ParameterDefinition>& definitions = parameterDefinitions();
  for (std::size_t d = 0; d < definitions.size(); ++d) {
    const ParameterDefinition& definition = definitions[d];
    index_[definition.number] = static_cast<std::int16_t>(d);
    first_.push_back(ram_.size());
    const std::size_t sets = definition.per_set ? kSets : 1;
    const std::size_t elements = std::max<std::size_t>(definition.elements, 1);
    ram_.insert(ram_.end(), sets * elements, definition.factory);
  }
  eeprom_ = ram_;
}

const ParameterDefinition* ParameterStore::find(unsigned number) const noexcept {
  if (number >= index_.size() || index_[number] < 0) return nullptr;
  return &parameterDefinitions()[static_cast<std::size_t>(index_[number])];
}

std::optional<std::size_t> ParameterStore::slot(unsigned number, unsigned set, unsigned element) const noexcept {
  const ParameterDefinition* definition = find(number);
  if (definition == nullptr) return std::nullopt;
  const unsigned sets = definition->per_set ? kSets : 1;
  const unsigned elements = std::max<unsigned>(definition->elements, 1);
  if (!definition->per_set) set = 0;
  if (set >= sets || element >= elements) return std::nullopt;
  return first_[static_cast<std::size_t>(index_[number])] + element * sets + set;
}

std::int32_t ParameterStore::value(unsigned number, unsigned set, unsigned element) const noexcept {
  const std::optional<std::size_t> at = slot(number, set, element);
  return at ? ram_[*at] : 0;
}

double ParameterStore::scaled(unsigned number, unsigned set) const noexcept {
  const ParameterDefinition* definition = find(number);
  if (definition == nullptr) return 0.0;
  return static_cast<double>(value(number, set)) / definition->divisor;
}

std::optional<ParameterError> ParameterStore::write(unsigned number, unsigned set, unsigned element, std::int32_t raw,
                                                    Storage storage) noexcept {
  const ParameterDefinition* definition = find(number);
  if (definition == nullptr) return ParameterError::kInvalidNumber;
  const std::optional<std::size_t> at = slot(number, set, element);
  if (!at) return ParameterError::kSubIndex;
  if (definition->read_only) return ParameterError::kNotChangeable;
  if (raw < definition->minimum || raw > definition->maximum) return ParameterError::kLimits;
  ram_[*at] = raw;
  if (storage == Storage::kEeprom) {
    eeprom_[*at] = raw;
    ++eeprom_writes_;
  }
  return std::nullopt;
}

bool ParameterStore::preset(unsigned number, unsigned set, unsigned element, std::int32_t raw) noexcept {
  const std::optional<std::size_t> at = slot(number, set, element);
  if (!at) return false;
  ram_[*at] = raw;
  eeprom_[*at] = raw;
  return true;
}

void ParameterStore::show(unsigned number, unsigned element, std::int32_t raw) noexcept {
  const std::optional<std::size_t> at = slot(number, 0, element);
  if (at) ram_[*at] = raw;
}

}  // namespace nord_driver::sim
