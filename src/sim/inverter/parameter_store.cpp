#include "sim/inverter/parameter_store.h"

#include <algorithm>
#include <utility>

namespace nord_driver::sim {

ParameterStore::ParameterStore(const Device& device) : device_(device), definitions_(parameterDefinitions(device)) {
  lay();
}

ParameterStore::ParameterStore(std::vector<ParameterDefinition> definitions) : definitions_(std::move(definitions)) {
  lay();
}

void ParameterStore::lay() {
  index_.fill(-1);
  for (std::size_t d = 0; d < definitions_.size(); ++d) {
    const ParameterDefinition& definition = definitions_[d];
    index_[definition.number] = static_cast<std::int16_t>(d);
    first_.push_back(ram_.size());
    const std::size_t sets = definition.per_set ? kSets : 1;
    const std::size_t elements = std::max<std::size_t>(definition.elements, 1);
    for (std::size_t e = 0; e < elements; ++e) ram_.insert(ram_.end(), sets, definition.factoryOf(e));
  }
  eeprom_ = ram_;
}

void ParameterStore::resetToFactory() noexcept {
  for (std::size_t d = 0; d < definitions_.size(); ++d) {
    const std::size_t end = d + 1 < first_.size() ? first_[d + 1] : ram_.size();
    const std::size_t sets = definitions_[d].per_set ? kSets : 1;
    for (std::size_t at = first_[d]; at < end; ++at) {
      ram_[at] = eeprom_[at] = definitions_[d].factoryOf((at - first_[d]) / sets);
    }
  }
}

const ParameterDefinition* ParameterStore::find(unsigned number) const noexcept {
  if (number >= index_.size() || index_[number] < 0) return nullptr;
  return &definitions_[static_cast<std::size_t>(index_[number])];
}

std::optional<std::size_t> ParameterStore::slot(unsigned number, unsigned set, unsigned element) const noexcept {
  const ParameterDefinition* definition = find(number);
  if (definition == nullptr) return std::nullopt;
  const unsigned sets = definition->per_set ? kSets : 1;
  const unsigned elements = std::max<unsigned>(definition->elements, 1);
  if (!definition->per_set) set = 0;
  if (set >= sets || element >= elements) return std::nullopt;
  return first_[static_cast<std::size_t>(index_[number])] + std::size_t{element} * sets + set;
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
