#include "catalogue/parameter_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

#include "config/nearest_name.h"
#include "config/setting_checks.h"
#include "profile/parameter_shape.h"

namespace nord_driver::catalogue {

namespace {

constexpr std::uint16_t kFirstObject = 0x2000;

std::string lowerCase(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string hexText(std::uint32_t value, unsigned digits) {
  char text[16];
  std::snprintf(text, sizeof(text), "%0*Xh", static_cast<int>(digits), value);
  return text;
}

std::uint32_t maskOf(unsigned bits) {
  return bits >= 32 ? 0xFFFFFFFFu : (1u << bits) - 1u;
}

int decimalsOf(double step) {
  int decimals = 0;
  for (double scaled = step; decimals < 6 && std::abs(scaled - std::round(scaled)) > 1e-9; scaled *= 10.0) ++decimals;
  return decimals;
}

std::string numberText(const ParameterEntry& entry, std::int32_t value, unsigned index) {
  if (entry.isHex()) {
    const unsigned size = entry.sizeOf(index);
    return hexText(static_cast<std::uint32_t>(value) & maskOf(size), size / 4);
  }
  char text[40];
  std::snprintf(text, sizeof(text), "%.*f", decimalsOf(entry.step()), value * entry.step());
  const std::string unit = entry.unitOf(index);
  return text + (unit.empty() ? "" : " " + unit);
}

std::string bitsText(const std::map<unsigned, BitField>& bits, std::uint32_t value) {
  std::string text;
  for (const auto& [first, field] : bits) {
    const auto part = static_cast<std::int32_t>((value >> first) & maskOf(field.last - first + 1));
    std::string words;
    if (const std::string* name = nameOf(field.values, part)) {
      words = field.name + " " + *name;
    } else if (part != 0) {
      words = field.last == first ? field.name : field.name + " " + std::to_string(part);
    }
    if (!words.empty()) text += (text.empty() ? "" : ", ") + words;
  }
  return text;
}

// Every number the name stands for, in this issue of the manual and in the others.
std::set<std::int64_t> numbersOf(const ValueNames& names, const std::string& wanted) {
  std::set<std::int64_t> numbers;
  for (const auto& [first, value] : names) {
    if (lowerCase(value.name) != wanted || isReserved(value.name)) continue;
    numbers.insert(first);
    numbers.insert(value.last);
  }
  return numbers;
}

std::string otherName(const ParameterEntry& entry, std::int32_t value, const std::string& own) {
  for (const OtherValues& other : entry.other_values) {
    const std::string* name = nameOf(other.values, value);
    if (name != nullptr && *name != own) return " (" + other.source + ": " + *name + ")";
  }
  return {};
}

RawValue refused(const ParameterEntry& entry, unsigned index, const std::string& text, const std::string& why) {
  return {std::nullopt, label(entry, index) + ": \"" + text + "\" is not valid, expected " + why};
}

std::vector<std::string> writableNames(const ParameterEntry& entry, unsigned index) {
  std::vector<std::string> names;
  for (const auto& [first, value] : entry.valuesOf(index)) {
    if (!isReserved(value.name)) names.push_back(value.name);
  }
  return names;
}

RawValue fromName(const ParameterEntry& entry, const std::string& text, unsigned index) {
  const std::string wanted = lowerCase(text);
  const std::set<std::int64_t> numbers = numbersOf(entry.valuesOf(index), wanted);
  if (numbers.empty()) {
    const std::vector<std::string> names = writableNames(entry, index);
    const std::string range = rangeText(entry, index);
    if (names.empty()) return refused(entry, index, text, range);
    std::vector<std::string> lower;
    lower.reserve(names.size());
    for (const std::string& name : names) lower.push_back(lowerCase(name));
    const std::string nearest = nearestName(wanted, lower);
    if (!nearest.empty()) {
      const auto at = std::find(lower.begin(), lower.end(), nearest) - lower.begin();
      return refused(entry, index, text, "perhaps \"" + names[static_cast<std::size_t>(at)] + "\"");
    }
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "\"" : "\", \"") + name;
    return refused(entry, index, text, range + " or one of " + list + "\"");
  }
  const auto raw = static_cast<std::int32_t>(*numbers.begin());
  if (numbers.size() > 1) return refused(entry, index, text, "a number: several values have this name");
  for (const OtherValues& other : entry.other_values) {
    const std::set<std::int64_t> there = numbersOf(other.values, wanted);
    const std::string* same = nameOf(other.values, raw);
    if ((!there.empty() && there != numbers) || (same != nullptr && lowerCase(*same) != wanted)) {
      return refused(entry, index, text, "a number: " + other.source + " names its values otherwise");
    }
  }
  return {raw, {}};
}

RawValue checked(const ParameterEntry& entry, const std::string& text, std::int64_t raw, unsigned index) {
  if (!entry.takes(raw, index)) return refused(entry, index, text, rangeText(entry, index));
  return {static_cast<std::int32_t>(raw), {}};
}

}  // namespace

std::string label(const ParameterEntry& entry, unsigned index) {
  char text[32];
  if (entry.number >= kFirstObject) {
    std::snprintf(text, sizeof(text), entry.elements ? "object %04Xh:%u" : "object %04Xh", unsigned{entry.number},
                  index);
  } else {
    std::snprintf(text, sizeof(text), entry.elements ? "P%03u[-%02u]" : "P%03u", unsigned{entry.number}, index);
  }
  return text;
}

std::string valueText(const ParameterEntry& entry, std::int32_t raw, unsigned index) {
  const std::int32_t value = entry.meant(raw, index);
  std::string text = numberText(entry, value, index);
  if (const std::string* name = nameOf(entry.valuesOf(index), value)) {
    return text + " " + *name + otherName(entry, value, *name);
  }
  const std::string bits = bitsText(entry.bits, static_cast<std::uint32_t>(value) & maskOf(entry.sizeOf(index)));
  return text + (bits.empty() ? "" : ": " + bits) + otherName(entry, value, "");
}

std::string assignment(const ParameterEntry& entry, std::int32_t raw, unsigned index) {
  return label(entry, index) + " = " + valueText(entry, raw, index);
}

RawValue rawFrom(const ParameterEntry& entry, const std::string& typed, unsigned index) {
  const std::string text = trimmed(typed);
  if (text.empty()) return refused(entry, index, text, "a value");
  if (!numbersOf(entry.valuesOf(index), lowerCase(text)).empty()) return fromName(entry, text, index);
  const std::size_t colon = entry.bits.empty() ? std::string::npos : text.find(": ");
  if (colon != std::string::npos) {
    RawValue value = rawFrom(entry, text.substr(0, colon), index);
    if (!value.raw || lowerCase(text) == lowerCase(valueText(entry, *value.raw, index))) return value;
    return refused(entry, index, text, "\"" + valueText(entry, *value.raw, index) + "\", or the number alone");
  }
  if (text.size() > 1 && text.back() == 'h') {
    if (const auto raw = wholeNumber("0x" + text.substr(0, text.size() - 1))) return checked(entry, text, *raw, index);
  }
  if (text.rfind("0x", 0) == 0 || text.rfind("0X", 0) == 0) {
    if (const auto raw = wholeNumber(text)) return checked(entry, text, *raw, index);
  }
  const std::size_t space = text.find(' ');
  const std::string unit = entry.unitOf(index);
  std::string number = text.substr(0, space);
  std::string rest = space == std::string::npos ? "" : trimmed(text.substr(space));
  if (rest.empty() && !unit.empty() && number.size() > unit.size() &&
      number.compare(number.size() - unit.size(), unit.size(), unit) == 0) {
    number.erase(number.size() - unit.size());
    rest = unit;
  }
  const auto value = decimalNumber(number);
  if (!value) return fromName(entry, text, index);
  const double steps = *value / entry.step();
  if (!isWholeStep(steps)) return {std::nullopt, notWhole(entry, text, index)};
  if (std::abs(steps) > 1e12) return refused(entry, index, text, rangeText(entry, index));
  RawValue result = checked(entry, text, std::llround(steps), index);
  if (!result.raw || rest.empty() || rest == unit) return result;
  const std::string full = valueText(entry, *result.raw, index);
  if (lowerCase(text) == lowerCase(full)) return result;
  const std::string* name = nameOf(entry.valuesOf(index), *result.raw);
  if (name != nullptr && lowerCase(*name) == lowerCase(rest)) return result;
  return refused(entry, index, text, "\"" + full + "\", or the number alone");
}

// A value may come from a float, which is exact to 6e-8 of itself; a hundredth of a step is no other value.
bool isWholeStep(double steps) {
  return std::abs(steps - std::round(steps)) <= 1e-6 + std::min(1e-7 * std::abs(steps), 0.01);
}

std::string notWhole(const ParameterEntry& entry, const std::string& text, unsigned index) {
  const std::string unit = entry.unitOf(index);
  return refused(entry, index, text, "a multiple of " + shortNumber(entry.step()) + (unit.empty() ? "" : " " + unit))
      .error;
}

std::string whyNotWritable(const ParameterEntry& entry) {
  char number[8];
  std::snprintf(number, sizeof(number), entry.number >= kFirstObject ? "%04Xh" : "P%03u", unsigned{entry.number});
  const std::string name = number + (entry.name ? " " + *entry.name : "");
  if (entry.read_only.value_or(false)) return name + " can only be read";
  if (!entry.mayWrite()) return name + " is never written: " + entry.note.value_or("it resets the device");
  return {};
}

std::string kindText(const ParameterEntry& entry) {
  std::string text;
  const auto add = [&text](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
  if (entry.elements) add("array of " + std::to_string(*entry.elements));
  if (profile::hasSets(entry.shape())) add(entry.per_set ? "sets 1 to 4" : "perhaps sets 1 to 4");
  if (!entry.mayWrite()) add(entry.read_only.value_or(false) ? "read only" : "never written");
  if (entry.isUnitUnknown(1)) add("unit not known");
  return text;
}

std::string stepText(const ParameterEntry& entry) {
  const std::string unit = entry.unit.value_or("");
  return shortNumber(entry.step()) + (unit.empty() ? "" : " " + unit);
}

std::string rangeText(const ParameterEntry& entry, unsigned index) {
  const auto [lowest, highest] = entry.rawRange(index);
  const std::string unit = entry.unitOf(index);
  if (entry.isHex()) {
    const unsigned digits = entry.sizeOf(index) / 4;
    return hexText(static_cast<std::uint32_t>(lowest), digits) + " to " +
           hexText(static_cast<std::uint32_t>(highest), digits);
  }
  return shortNumber(static_cast<double>(lowest) * entry.step()) + " to " +
         shortNumber(static_cast<double>(highest) * entry.step()) + (unit.empty() ? "" : " " + unit);
}

}  // namespace nord_driver::catalogue
