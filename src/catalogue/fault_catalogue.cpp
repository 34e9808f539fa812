#include "catalogue/fault_catalogue.h"

#include <cmath>
#include <cstdio>
#include <set>

#include "catalogue/catalogue_file.h"
#include "config/nearest_name.h"

namespace nord_driver::catalogue {

namespace {

// `stands_for` of these names numbers of P700, which are printed divided by ten.
bool behindIsP700(FaultCodes codes) noexcept {
  return codes == FaultCodes::kEmcy || codes == FaultCodes::kDrivecom;
}

FaultCodes readCodes(YamlMap& map) {
  const auto name = map.text("codes");
  std::vector<std::string> names;
  std::string list;
  for (const FaultCodes codes : kAllFaultCodes) {
    if (name && *name == toString(codes)) return codes;
    names.emplace_back(toString(codes));
    list += (list.empty() ? "" : ", ") + names.back();
  }
  if (!name) throw map.missing("codes", "one of " + list);
  const std::string nearest = nearestName(*name, names);
  throw map.wrong("codes", nearest.empty() ? "one of " + list : "perhaps \"" + nearest + "\"");
}

std::optional<std::uint32_t> rawNumber(const std::string& text, double resolution) {
  const auto value = decimalNumber(text);
  if (!value) return std::nullopt;
  const double raw = *value / resolution;
  if (raw < 0.0 || raw > 4294967295.0 || std::abs(raw - std::round(raw)) > 1e-6) return std::nullopt;
  return static_cast<std::uint32_t>(std::llround(raw));
}

FaultEntry readFault(const std::string& file, const YAML::Node& node, FaultCodes codes, double resolution) {
  const YAML::Node key = YamlMap(file, "faults", node).node("number");
  if (!key.IsDefined()) throw YamlMap(file, "faults", node).missing("number", "the number of the fault");
  const auto number = key.IsScalar() ? rawNumber(key.Scalar(), resolution) : std::nullopt;
  if (!number) {
    throw wrongValue(file, key, "faults: number",
                     resolution < 1.0 ? "a number as it is printed (10.2)" : "a whole number");
  }
  YamlMap map(file, "number " + key.Scalar(), node);
  map.node("number");
  FaultEntry fault;
  fault.number = *number;
  fault.name = map.text("name");
  fault.cause = map.text("cause");
  fault.remedy = map.text("remedy");
  fault.note = map.text("note");
  fault.erratum = map.text("erratum");
  for (const std::string& behind : map.texts("stands_for")) {
    const auto raw = rawNumber(behind, behindIsP700(codes) ? 0.1 : 1.0);
    if (!raw) throw map.wrong("stands_for", "a list of numbers");
    fault.stands_for.push_back(*raw);
  }
  fault.source = map.texts("source");
  fault.place = map.place();
  map.rejectUnknown();
  return fault;
}

FaultEntry laidOver(FaultEntry lower, const FaultEntry& upper) {
  lower.number = upper.number;
  if (upper.name) lower.name = upper.name;
  if (upper.cause) lower.cause = upper.cause;
  if (upper.remedy) lower.remedy = upper.remedy;
  if (upper.note) lower.note = upper.note;
  if (upper.erratum) lower.erratum = upper.erratum;
  if (!upper.stands_for.empty()) lower.stands_for = upper.stands_for;
  if (!upper.source.empty()) lower.source = upper.source;
  lower.place = upper.place;
  return lower;
}

}  // namespace

const char* toString(FaultCodes codes) noexcept {
  switch (codes) {
    case FaultCodes::kP700:
      return "p700";
    case FaultCodes::kP170:
      return "p170";
    case FaultCodes::kEmcy:
      return "emcy";
    case FaultCodes::kDrivecom:
      return "drivecom";
    case FaultCodes::kPkw:
      return "pkw";
    case FaultCodes::kDpv1:
      return "dpv1";
    case FaultCodes::kDpv1Abort:
      return "dpv1_abort";
    case FaultCodes::kSdoAbort:
      return "sdo_abort";
    case FaultCodes::kDevicenetGeneral:
      return "devicenet_general";
    case FaultCodes::kDevicenetAllocate:
      return "devicenet_allocate";
  }
  return "";
}

FaultCatalogue FaultCatalogue::load(const std::vector<std::string>& files) {
  FaultCatalogue catalogue;
  for (const std::string& file : files) {
    YamlMap map(file, "", loadMap(file));
    const FaultCodes codes = readCodes(map);
    const double resolution = map.number("resolution").value_or(1.0);
    if (resolution <= 0.0 || resolution > 1.0) throw map.wrong("resolution", "a number above 0 and up to 1");
    const std::vector<Device> devices = readDevices(map);
    const YAML::Node list = map.node("faults");
    if (!list.IsDefined()) throw map.missing("faults", "a list of faults");
    if (!list.IsSequence()) throw map.wrong("faults", "a list of faults");
    map.node("parameters");  // a user's file may hold both
    map.rejectUnknown();
    std::vector<std::optional<Device>> holds_for(devices.begin(), devices.end());
    if (holds_for.empty()) holds_for.emplace_back(std::nullopt);
    std::set<std::uint32_t> numbers;
    for (const YAML::Node& item : list) {
      const FaultEntry upper = readFault(file, item, codes, resolution);
      const std::string printed = "number " + item["number"].Scalar();
      if (!numbers.insert(upper.number).second) {
        throw wrongPlace(upper.place, printed + " stands twice in this file, expected it once");
      }
      for (const auto& device : holds_for) {
        auto& entries = catalogue.entries_[{codes, device}];
        // Of one device: over what holds for all, so that a name alone keeps cause and remedy.
        if (device && entries.count(upper.number) == 0) {
          if (const FaultEntry* of_all = catalogue.find(codes, upper.number)) entries[upper.number] = *of_all;
        }
        FaultEntry& entry = entries[upper.number];
        entry = laidOver(entry, upper);
        if (!entry.name) throw wrongPlace(entry.place, printed + ": name is missing, expected the name of the fault");
        if (entry.source.empty()) {
          throw wrongPlace(entry.place, printed + ": source is missing, expected where this is known from");
        }
      }
    }
  }
  return catalogue;
}

const FaultEntry* FaultCatalogue::find(FaultCodes codes, std::uint32_t number) const {
  const auto entries = entries_.find({codes, std::nullopt});
  if (entries == entries_.end()) return nullptr;
  const auto entry = entries->second.find(number);
  return entry == entries->second.end() ? nullptr : &entry->second;
}

const FaultEntry* FaultCatalogue::find(FaultCodes codes, std::uint32_t number, const Device& device) const {
  const auto entries = entries_.find({codes, device});
  if (entries != entries_.end()) {
    const auto entry = entries->second.find(number);
    if (entry != entries->second.end()) return &entry->second;
  }
  return find(codes, number);
}

std::vector<const FaultEntry*> FaultCatalogue::all(FaultCodes codes, const std::optional<Device>& device) const {
  std::vector<const FaultEntry*> list;
  const auto entries = entries_.find({codes, device});
  if (entries == entries_.end()) return list;
  for (const auto& [number, entry] : entries->second) list.push_back(&entry);
  return list;
}

std::string faultLabel(FaultCodes codes, std::uint32_t number) {
  char text[24];
  switch (codes) {
    case FaultCodes::kP700:
      std::snprintf(text, sizeof(text), "E%u.%u", number / 10u, number % 10u);
      break;
    case FaultCodes::kEmcy:
    case FaultCodes::kDrivecom:
      std::snprintf(text, sizeof(text), "%04Xh", number);
      break;
    case FaultCodes::kSdoAbort:
      std::snprintf(text, sizeof(text), "%08Xh", number);
      break;
    case FaultCodes::kDpv1:
    case FaultCodes::kDevicenetGeneral:
    case FaultCodes::kDevicenetAllocate:
      std::snprintf(text, sizeof(text), "%02Xh", number);
      break;
    case FaultCodes::kP170:
    case FaultCodes::kPkw:
    case FaultCodes::kDpv1Abort:
      std::snprintf(text, sizeof(text), "%u", number);
      break;
  }
  return text;
}

}  // namespace nord_driver::catalogue
