#include "catalogue/parameter_entry.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "config/setting_checks.h"

namespace nord_driver::catalogue {

namespace {

template <typename T>
void replace(std::optional<T>& lower, const std::optional<T>& upper) {
  if (upper) lower = upper;
}

void replace(ValueNames& lower, const ValueNames& upper) {
  for (const auto& [first, value] : upper) lower[first] = value;
}

// A field takes the place of those it shares a bit with.
void replace(std::map<unsigned, BitField>& lower, const std::map<unsigned, BitField>& upper) {
  for (const auto& [first, field] : upper) {
    for (auto old = lower.begin(); old != lower.end();) {
      const bool shared = old->first <= field.last && first <= old->second.last;
      old = shared ? lower.erase(old) : std::next(old);
    }
    lower[first] = field;
  }
}

void layElement(Element& lower, const Element& upper) {
  if (!upper.name.empty()) lower.name = upper.name;
  replace(lower.unit, upper.unit);
  replace(lower.size, upper.size);
  replace(lower.range, upper.range);
  replace(lower.default_value, upper.default_value);
  replace(lower.values, upper.values);
}

ConfigError wrongEntry(const ParameterEntry& entry, const std::string& message) {
  return wrongPlace(entry.place, "number " + std::to_string(entry.number) + ": " + message);
}

std::string rangeText(const Limits& range) {
  return shortNumber(range.lowest) + " ... " + shortNumber(range.highest);
}

// What the raw values of a size can hold.
std::pair<std::int64_t, std::int64_t> limitsOf(unsigned size, bool is_signed) {
  if (size == 32) return {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()};
  const std::int64_t all = (std::int64_t{1} << size) - 1;
  return is_signed ? std::make_pair(-(all + 1) / 2, all / 2) : std::make_pair(std::int64_t{0}, all);
}

void checkElement(const ParameterEntry& entry, unsigned index, const std::string& where) {
  const auto range = entry.rangeOf(index);
  const auto [lowest, highest] = limitsOf(entry.sizeOf(index), entry.isSigned());
  if (range) {
    if (range->lowest > range->highest) {
      throw wrongEntry(entry,
                       where + "range: " + rangeText(*range) + " is upside down, expected the lowest value first");
    }
    if (entry.rawOf(range->lowest) < lowest || entry.rawOf(range->highest) > highest) {
      throw wrongEntry(entry, where + "range: " + rangeText(*range) + " needs more than " +
                                  std::to_string(entry.sizeOf(index)) + " bits, expected another size");
    }
  }
  const auto fallback = entry.defaultOf(index);
  if (fallback && range && (*fallback < range->lowest || *fallback > range->highest) &&
      nameOf(entry.valuesOf(index), static_cast<std::int32_t>(entry.rawOf(*fallback))) == nullptr) {
    throw wrongEntry(entry, where + "default: " + shortNumber(*fallback) + " is not valid, expected a value of " +
                                rangeText(*range) + " or one that has a name");
  }
}

}  // namespace

const std::string* nameOf(const ValueNames& names, std::int32_t raw) noexcept {
  const std::string* found = nullptr;
  std::int64_t shortest = std::numeric_limits<std::int64_t>::max();
  for (const auto& [first, value] : names) {
    if (first > raw) break;
    const std::int64_t length = std::int64_t{value.last} - first;
    if (raw > value.last || length >= shortest) continue;
    shortest = length;
    found = &value.name;
  }
  return found;
}

bool isReserved(const std::string& name) {
  return name.rfind("reserved", 0) == 0;
}

const std::string& ParameterEntry::title() const {
  static const std::string kNone;
  return name ? *name : kNone;
}

profile::ParameterShape ParameterEntry::shape() const {
  using profile::ParameterShape;
  if (elements) return per_set.value_or(false) ? ParameterShape::kArrayPerSet : ParameterShape::kArray;
  return per_set.value_or(mayWrite()) ? ParameterShape::kPerSet : ParameterShape::kPlain;
}

const Element* ParameterEntry::element(unsigned index) const {
  const auto found = element_infos.find(index);
  return found == element_infos.end() ? nullptr : &found->second;
}

std::string ParameterEntry::unitOf(unsigned index) const {
  const Element* own = element(index);
  return own != nullptr && own->unit ? *own->unit : unit.value_or("");
}

bool ParameterEntry::isUnitUnknown(unsigned index) const {
  return unit_unknown.value_or(false) && !resolution && unitOf(index).empty();
}

unsigned ParameterEntry::sizeOf(unsigned index) const {
  const Element* own = element(index);
  return own != nullptr && own->size ? *own->size : size.value_or(16);
}

std::optional<Limits> ParameterEntry::rangeOf(unsigned index) const {
  const Element* own = element(index);
  return own != nullptr && own->range ? own->range : range;
}

std::optional<double> ParameterEntry::defaultOf(unsigned index) const {
  const Element* own = element(index);
  return own != nullptr && own->default_value ? own->default_value : default_value;
}

const ValueNames& ParameterEntry::valuesOf(unsigned index) const {
  const Element* own = element(index);
  return own != nullptr && !own->values.empty() ? own->values : values;
}

bool ParameterEntry::isSigned() const {
  return is_signed.value_or(range && range->lowest < 0.0);
}

std::pair<std::int64_t, std::int64_t> ParameterEntry::rawRange(unsigned index) const {
  if (const auto known = rangeOf(index)) return {rawOf(known->lowest), rawOf(known->highest)};
  return limitsOf(sizeOf(index), isSigned());
}

std::int64_t ParameterEntry::rawOf(double value) const {
  return std::llround(value / step());
}

std::int32_t ParameterEntry::meant(std::int32_t raw, unsigned index) const {
  const unsigned width = sizeOf(index);
  if (width >= 32) return raw;
  const std::uint32_t mask = (std::uint32_t{1} << width) - 1u;
  const std::uint32_t low = static_cast<std::uint32_t>(raw) & mask;
  const bool negative = isSigned() && ((low >> (width - 1)) & 1u) != 0;
  return static_cast<std::int32_t>(negative ? low | ~mask : low);
}

bool ParameterEntry::takes(std::int64_t raw, unsigned index) const {
  if (raw < std::numeric_limits<std::int32_t>::min() || raw > std::numeric_limits<std::int32_t>::max()) return false;
  const auto [lowest, highest] = rawRange(index);
  return (raw >= lowest && raw <= highest) || nameOf(valuesOf(index), static_cast<std::int32_t>(raw)) != nullptr;
}

ParameterEntry laidOver(ParameterEntry lower, const ParameterEntry& upper) {
  replace(lower.name, upper.name);
  replace(lower.unit, upper.unit);
  replace(lower.resolution, upper.resolution);
  replace(lower.unit_unknown, upper.unit_unknown);
  replace(lower.range, upper.range);
  replace(lower.default_value, upper.default_value);
  replace(lower.per_set, upper.per_set);
  replace(lower.elements, upper.elements);
  for (const auto& [index, own] : upper.element_infos) layElement(lower.element_infos[index], own);
  if (!lower.element_infos.empty()) {
    lower.elements = std::max(lower.elements.value_or(0), lower.element_infos.rbegin()->first);
  }
  replace(lower.values, upper.values);
  if (!upper.other_values.empty()) lower.other_values = upper.other_values;
  replace(lower.bits, upper.bits);
  replace(lower.hex, upper.hex);
  replace(lower.is_signed, upper.is_signed);
  replace(lower.size, upper.size);
  replace(lower.read_only, upper.read_only);
  replace(lower.never_write, upper.never_write);
  replace(lower.supervisor, upper.supervisor);
  replace(lower.note, upper.note);
  replace(lower.erratum, upper.erratum);
  if (!upper.source.empty()) lower.source = upper.source;
  lower.place = upper.place;
  return lower;
}

void checkEntry(const ParameterEntry& entry) {
  if (!entry.name) throw wrongEntry(entry, "name is missing, expected the name of the parameter");
  if (entry.source.empty()) throw wrongEntry(entry, "source is missing, expected where this is known from");
  for (unsigned index = 1; !entry.element_infos.empty() && index <= entry.elements.value_or(0); ++index) {
    const Element* own = entry.element(index);
    if (own != nullptr && !own->name.empty()) continue;
    throw wrongEntry(entry, "elements: " + std::to_string(index) +
                                " has no name, expected one for every element of 1 ... " +
                                std::to_string(*entry.elements));
  }
  const unsigned bits = entry.sizeOf(1);
  for (const auto& [first, field] : entry.bits) {
    if (field.last >= bits) {
      throw wrongEntry(
          entry, "bits: " + std::to_string(field.last) + " is not valid, expected 0 ... " + std::to_string(bits - 1));
    }
  }
  if (!entry.elements) checkElement(entry, 1, "");
  for (unsigned index = 1; index <= entry.elements.value_or(0); ++index) {
    checkElement(entry, index, "elements: " + std::to_string(index) + ": ");
  }
}

}  // namespace nord_driver::catalogue
