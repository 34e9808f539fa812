#include "commissioning/drive_under_check.h"

#include <algorithm>

#include "catalogue/parameter_access.h"
#include "catalogue/parameter_text.h"
#include "profile/parameter_shape.h"

namespace nord_driver::commissioning {

using profile::Series;

namespace {

unsigned elementOf(const ParameterKey& key) noexcept {
  return key.index == 0 ? 1u : key.index;
}

bool isManual(const std::string& source) {
  return source.rfind("BU ", 0) == 0;
}

}  // namespace

bool DriveUnderCheck::isDecentral() const noexcept {
  return asked_.series == Series::kSk1x0e || asked_.series == Series::kSk2xxe;
}

bool DriveUnderCheck::isOlderSeries() const noexcept {
  return asked_.series == Series::kSk300e || asked_.series == Series::kSk700e || asked_.series == Series::kSk750e;
}

ParameterKey DriveUnderCheck::key(std::uint16_t number, std::uint8_t set, std::uint8_t index) const {
  const catalogue::ParameterEntry* entry = known_->find(number);
  if (entry == nullptr) return {number, 0, 0};
  ParameterKey key{number, 0, 0};
  if (profile::hasSets(entry->shape())) key.set = set == 0 ? set_ : set;
  if (profile::isArray(entry->shape())) key.index = index;
  return key;
}

ParameterKey DriveUnderCheck::functionKey(std::uint16_t first, std::uint8_t place, std::uint8_t set) const {
  const catalogue::ParameterEntry* entry = known_->find(first);
  const bool is_array = entry != nullptr && profile::isArray(entry->shape());
  if (is_array) return key(first, set, static_cast<std::uint8_t>(place + 1));
  return key(static_cast<std::uint16_t>(first + place), set);
}

std::optional<std::int32_t> DriveUnderCheck::raw(const ParameterKey& key) const {
  const auto raw = facts_.raw(key);
  const catalogue::ParameterEntry* entry = known_->find(key.number);
  if (!raw || entry == nullptr) return raw;
  return entry->meant(*raw, elementOf(key));
}

std::optional<double> DriveUnderCheck::value(const ParameterKey& key) const {
  const auto raw = facts_.raw(key);
  if (!raw) return std::nullopt;
  return catalogue::valueOf(known_->find(key.number), *raw, elementOf(key));
}

std::string DriveUnderCheck::valueText(const ParameterKey& key, std::int32_t raw) const {
  return known_->valueText(known_->find(key.number), raw, elementOf(key));
}

std::string DriveUnderCheck::nameOf(const ParameterKey& key) const {
  if (key.number == 0) return "parameter set";
  std::string text = "P" + std::to_string(key.number);
  if (key.index != 0) text += std::string(key.index < 10 ? "[-0" : "[-") + std::to_string(key.index) + "]";
  if (key.set != 0) text += " set " + std::to_string(key.set);
  const std::string name = catalogue::fullName(known_->find(key.number), elementOf(key));
  return name.empty() ? text : text + " " + name;
}

std::string DriveUnderCheck::sourceOf(const ParameterKey& key) const {
  const catalogue::ParameterEntry* entry = known_->find(key.number);
  if (entry == nullptr) return {};
  const auto found = std::find_if(entry->source.begin(), entry->source.end(), isManual);
  return found == entry->source.end() ? std::string{} : *found;
}

Finding DriveUnderCheck::finding(const ParameterKey& key, Severity severity, const std::string& why,
                                 const std::string& source) const {
  Finding finding;
  finding.severity = severity;
  finding.drive = asked_.name;
  finding.key = key;
  finding.parameter = nameOf(key);
  finding.raw = raw(key);
  if (finding.raw) finding.value = valueText(key, *finding.raw);
  finding.why = why;
  finding.source = source;
  const std::string described = sourceOf(key);
  if (!described.empty() && source.find(described) == std::string::npos) {
    finding.source += (source.empty() ? "" : "; ") + described;
  }
  return finding;
}

Remedy DriveUnderCheck::remedy(const ParameterKey& key, double value) const {
  const catalogue::ParameterEntry* entry = known_->find(key.number);
  const auto raw = static_cast<std::int32_t>(entry != nullptr ? entry->rawOf(value) : static_cast<std::int64_t>(value));
  return {raw, valueText(key, raw)};
}

}  // namespace nord_driver::commissioning
