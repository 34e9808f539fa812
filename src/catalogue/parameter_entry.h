// One parameter as the catalogue describes it: what a manual says, and nothing where it says nothing.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catalogue/yaml_map.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::catalogue {

/// A named raw value, or several in a row that share a name ("13..16: reserved").
struct NamedValue {
  std::int32_t last = 0;  ///< the first one is the key of the map
  std::string name;
};
using ValueNames = std::map<std::int32_t, NamedValue>;

/// The name of a raw value, of the shortest row that holds it; nullptr when it has none.
const std::string* nameOf(const ValueNames& names, std::int32_t raw) noexcept;
/// Nobody can mean a value that is reserved: such a name is shown and never taken for a number.
bool isReserved(const std::string& name);

/// Some bits of a value; `values` are the names of what several bits make together.
struct BitField {
  unsigned last = 0;  ///< the first one is the key of the map
  std::string name;
  ValueNames values;
};

/// The lowest and the highest value, in the parameter's unit.
struct Limits {
  double lowest = 0.0;
  double highest = 0.0;
};

/// What an array element has of its own; the rest is that of its parameter.
struct Element {
  std::string name;
  std::optional<std::string> unit;
  std::optional<unsigned> size;
  std::optional<Limits> range;
  std::optional<double> default_value;
  ValueNames values;
};

/// P152 and PNU 970 load the factory settings: nobody writes them over this driver, whatever a file says.
constexpr bool resetsDevice(std::uint16_t number) noexcept {
  return number == 152 || number == 970;
}

/// The names another issue of the manual, for another firmware, gives to the same numbers.
struct OtherValues {
  std::string source;
  ValueNames values;
};

struct ParameterEntry {
  std::uint16_t number = 0;  ///< the manual's: 102 for P102; from 2000h on the index of an object
  std::optional<std::string> name;
  std::optional<std::string> unit;
  std::optional<double> resolution;  ///< value = raw * resolution
  std::optional<Limits> range;
  std::optional<double> default_value;
  std::optional<bool> per_set;                ///< none: the manuals do not say whether it depends on the parameter set
  std::optional<unsigned> elements;           ///< of an array, [-01] to [-elements]; none: no array
  std::map<unsigned, Element> element_infos;  ///< by the manual's index, from 1 on
  ValueNames values;
  std::vector<OtherValues> other_values;
  std::map<unsigned, BitField> bits;
  std::optional<bool> hex;
  std::optional<bool> is_signed;
  std::optional<unsigned> size;  ///< bits: 8, 16, 32
  std::optional<bool> read_only;
  std::optional<bool> never_write;
  std::optional<bool> supervisor;
  std::optional<bool> unit_unknown;  ///< a quantity whose unit and resolution no source names
  std::optional<std::string> note;
  std::optional<std::string> erratum;
  std::vector<std::string> source;
  Place place;  ///< of the entry, or of the last one laid over it

  const std::string& title() const;
  double step() const { return resolution.value_or(1.0); }
  bool isHex() const { return hex.value_or(false); }
  bool mayWrite() const { return !read_only.value_or(false) && !never_write.value_or(false) && !resetsDevice(number); }
  /// As the requests of every bus need it. A parameter that can be written and of which it is not known whether it depends
  /// on the set counts as one that does: an order that names the set falls back by itself when it does not. An array counts
  /// as one that does not: it is indexed either way, so that no answer would tell.
  profile::ParameterShape shape() const;

  const Element* element(unsigned index) const;
  std::string unitOf(unsigned index) const;
  /// Its raw values have no known meaning: nobody can write a value, only a raw one. A unit or a resolution that a file
  /// lays over the entry ends that.
  bool isUnitUnknown(unsigned index) const;
  unsigned sizeOf(unsigned index) const;
  std::optional<Limits> rangeOf(unsigned index) const;
  std::optional<double> defaultOf(unsigned index) const;
  const ValueNames& valuesOf(unsigned index) const;
  /// How a word is read: the range tells, if it goes below zero, or the entry says so.
  bool isSigned() const;
  /// The lowest and highest raw value; those of the size where no range is known.
  std::pair<std::int64_t, std::int64_t> rawRange(unsigned index) const;
  /// The nearest raw value of a value in the parameter's unit.
  std::int64_t rawOf(double value) const;
  /// A raw value as the drive means it: what stands beyond its size is left out, the sign is spread.
  std::int32_t meant(std::int32_t raw, unsigned index) const;
  /// The value in the parameter's unit behind a raw one, whatever stands beyond its size.
  double valueOf(std::int32_t raw, unsigned index) const { return meant(raw, index) * step(); }
  /// Within the range, or a value that has a name.
  bool takes(std::int64_t raw, unsigned index) const;
};

/// `upper` laid over `lower`, field by field; named values, elements and bits one by one.
ParameterEntry laidOver(ParameterEntry lower, const ParameterEntry& upper);

/// Throws ConfigError when the entry as a whole is not complete or contradicts itself.
void checkEntry(const ParameterEntry& entry);

}  // namespace nord_driver::catalogue
