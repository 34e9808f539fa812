#include "catalogue/parameter_access.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "catalogue/parameter_text.h"
#include "config/setting_checks.h"
#include "profile/parameter_shape.h"

namespace nord_driver::catalogue {

namespace {

constexpr std::uint16_t kLastNumber = 999;

// Nobody has said how an unknown parameter is indexed: as it was asked for.
profile::ParameterShape shapeOfUnknown(std::uint8_t set, std::uint8_t index) {
  if (set != 0) return index != 0 ? profile::ParameterShape::kArrayPerSet : profile::ParameterShape::kPerSet;
  return index != 0 ? profile::ParameterShape::kArray : profile::ParameterShape::kPlain;
}

std::string nameOf(std::uint16_t number) {
  char text[8];
  std::snprintf(text, sizeof(text), "P%03u", unsigned{number});
  return text;
}

std::string nameOf(const ParameterAccess& access) {
  return nameOf(access.request.number);
}

std::string whyNot(const ParameterAccess& access) {
  if (access.entry != nullptr) return whyNotWritable(*access.entry);
  if (!resetsDevice(access.request.number)) return {};
  return nameOf(access) + " is never written: it resets the device to its factory settings";
}

std::string beyond(const ParameterAccess& access, double value) {
  return "the value " + shortNumber(value) + " cannot be written to " + nameOf(access) + ", expected " +
         (access.entry != nullptr ? rangeText(*access.entry, access.request.index) : "a whole number of 32 bits");
}

std::string write(ParameterAccess& access, std::int64_t raw, double value, bool persistent) {
  profile::ParameterRequest& request = access.request;
  const bool fits = access.entry != nullptr ? access.entry->takes(raw, request.index)
                                            : raw >= std::numeric_limits<std::int32_t>::min() &&
                                                  raw <= std::numeric_limits<std::int32_t>::max();
  if (!fits) return beyond(access, value);
  request.action = persistent ? profile::ParameterAction::kWritePersistent : profile::ParameterAction::kWriteRam;
  request.raw = static_cast<std::int32_t>(raw);
  // Of an unknown one the value says how wide it has to be: cut to 16 bits it would be another value.
  request.double_word = access.entry != nullptr ? access.entry->sizeOf(request.index) > 16
                                                : raw < std::numeric_limits<std::int16_t>::min() ||
                                                      raw > std::numeric_limits<std::uint16_t>::max();
  return {};
}

}  // namespace

ParameterAccess accessTo(const ParameterAddress& address, const DriveCatalogue& known) {
  ParameterAccess access;
  if (address.number > kLastNumber) {
    access.error = "parameter " + std::to_string(address.number) + " does not exist, expected 0 to 999";
    return access;
  }
  if (address.parameter_set > 4) {
    access.error = "parameter set " + std::to_string(address.parameter_set) + " does not exist, expected 0 to 4";
    return access;
  }
  access.entry = known.find(address.number);
  profile::ParameterRequest& request = access.request;
  request.number = address.number;
  request.parameter_set = address.parameter_set;
  request.index = address.index == 0 ? std::uint8_t{1} : address.index;
  request.shape =
      access.entry != nullptr ? access.entry->shape() : shapeOfUnknown(address.parameter_set, address.index);
  if (access.entry != nullptr && !profile::isArray(request.shape) && address.index > 1) {
    access.error = nameOf(access) + " is no array, expected index 0, not " + std::to_string(address.index);
  }
  return access;
}

std::string whyUnitUnknown(const ParameterAccess& access) {
  const ParameterEntry* entry = access.entry;
  if (entry == nullptr) return nameOf(access) + " is not in the catalogue: its unit is not known";
  if (!entry->isUnitUnknown(access.request.index)) return {};
  return nameOf(access) + " " + entry->title() + ": its unit is not known";
}

std::string whyNotRaw(const ParameterAccess& access) {
  const std::string why = whyUnitUnknown(access);
  return why.empty() ? "" : why + ", and raw values need allow_raw_parameters: true";
}

std::string setValue(ParameterAccess& access, const ParameterWrite& write_as) {
  if (std::string why = whyNot(access); !why.empty()) return why;
  if (std::string why = whyNotRaw(access); !why.empty() && !write_as.allow_raw) return why;
  const double steps = access.entry != nullptr ? write_as.value / access.entry->step() : write_as.value;
  constexpr double kBeyondAll = 1e12;
  if (!(std::abs(steps) < kBeyondAll)) return beyond(access, write_as.value);
  const double raw = std::round(steps);
  if (access.entry == nullptr && raw != steps) return beyond(access, write_as.value);
  if (access.entry != nullptr && !isWholeStep(steps)) {
    return notWhole(*access.entry, shortNumber(write_as.value), access.request.index);
  }
  return write(access, static_cast<std::int64_t>(raw), write_as.value, write_as.persistent);
}

std::string setText(ParameterAccess& access, const std::string& text, bool persistent) {
  if (std::string why = whyNot(access); !why.empty()) return why;
  if (std::string why = whyUnitUnknown(access); !why.empty()) return why;
  const RawValue typed = rawFrom(*access.entry, text, access.request.index);
  if (typed.raw) return write(access, *typed.raw, access.entry->valueOf(*typed.raw, access.request.index), persistent);
  // The same sentence as for the same value by a service.
  if (const auto value = decimalNumber(text)) {
    ParameterAccess rounded = access;
    if (std::string why = setValue(rounded, {*value, persistent, false}); !why.empty()) return why;
  }
  return typed.error;
}

std::string setRaw(ParameterAccess& access, std::int64_t raw, bool persistent) {
  if (std::string why = whyNot(access); !why.empty()) return why;
  if (access.entry == nullptr) return write(access, raw, static_cast<double>(raw), persistent);
  // As transferred: on CAN and InterBus a word comes without its sign, and -1 is 65535.
  const unsigned width = access.entry->sizeOf(access.request.index);
  const bool is_word = width < 32 && raw >= 0 && raw < (std::int64_t{1} << width);
  if (is_word) raw = access.entry->meant(static_cast<std::int32_t>(raw), access.request.index);
  return write(access, raw, static_cast<double>(raw) * access.entry->step(), persistent);
}

double valueOf(const ParameterEntry* entry, std::int32_t raw, unsigned index) {
  return entry != nullptr ? entry->valueOf(raw, index) : raw;
}

std::string fullName(const ParameterEntry* entry, unsigned index) {
  if (entry == nullptr) return {};
  const Element* element = entry->element(index);
  const bool tells_more = element != nullptr && !element->name.empty() && element->name != entry->title();
  return entry->title() + (tells_more ? ", " + element->name : "");
}

std::string valueSentence(const ParameterAccess& access, std::int32_t raw, const DriveCatalogue& known) {
  const std::uint8_t index = access.request.index;
  if (access.entry == nullptr)
    return "P" + std::to_string(access.request.number) + " = " + std::to_string(raw) + " (raw)";
  return label(*access.entry, index) + " = " + known.valueText(access.entry, raw, index);
}

}  // namespace nord_driver::catalogue
