#include "catalogue/drive_catalogue.h"

#include <algorithm>

#include "catalogue/parameter_text.h"

namespace nord_driver::catalogue {

namespace {

constexpr std::uint16_t kFirstOfModule = 150, kLastOfModule = 199;
constexpr std::uint16_t kCurrentFault = 700, kLastFaults = 701;

bool isOfModule(std::uint16_t number) noexcept {
  return number >= kFirstOfModule && number <= kLastOfModule;
}

// [-02] of P700 is the warning and [-03] the reason of a switch-on block: numbers of their own (BU 0020 8).
bool isFaultNumber(std::uint16_t number, unsigned index) noexcept {
  return number == kLastFaults || (number == kCurrentFault && index == 1);
}

}  // namespace

DriveCatalogue::DriveCatalogue(const Catalogues& catalogues, profile::Series series, std::optional<Module> module)
    : parameters_(&catalogues.parameters), series_(series), module_(module), faults_(catalogues.faults, series) {}

const ParameterEntry* DriveCatalogue::find(std::uint16_t number) const {
  if (module_ && isOfModule(number)) return parameters_->find(*module_, number);
  return parameters_->find(series_, number);
}

std::vector<const ParameterEntry*> DriveCatalogue::all() const {
  std::vector<const ParameterEntry*> list = parameters_->all(series_);
  if (!module_) return list;
  list.erase(std::remove_if(list.begin(), list.end(), [](const auto* entry) { return isOfModule(entry->number); }),
             list.end());
  for (const ParameterEntry* entry : parameters_->all(*module_)) {
    if (isOfModule(entry->number)) list.push_back(entry);
  }
  std::sort(list.begin(), list.end(), [](const auto* a, const auto* b) { return a->number < b->number; });
  return list;
}

Lookup DriveCatalogue::look(const std::string& text) const {
  return lookIn(all(), text, toString(Device{series_}) + (module_ ? " or " + toString(Device{*module_}) : ""));
}

std::string DriveCatalogue::valueText(const ParameterEntry* entry, std::int32_t raw, unsigned index) const {
  if (entry == nullptr) return std::to_string(raw);
  std::string text = catalogue::valueText(*entry, raw, index);
  if (!isFaultNumber(entry->number, index)) return text;
  return text + " " + faults_.name(static_cast<std::uint16_t>(entry->meant(raw, index) & 0xFFFF));
}

DriveCatalogue driveCatalogue(const Catalogues& catalogues, profile::Series series, const std::string& transport,
                              bool module_in_front) {
  return {catalogues, series, module_in_front ? moduleOf(transport) : std::nullopt};
}

}  // namespace nord_driver::catalogue
