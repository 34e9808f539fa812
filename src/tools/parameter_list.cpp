#include "tools/parameter_list.h"

#include <cstdio>
#include <utility>
#include <vector>

#include "catalogue/parameter_text.h"
#include "config/driver_settings.h"
#include "tools/json_text.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

using catalogue::DriveCatalogue;
using catalogue::ParameterEntry;

namespace {

// Drives of one series behind the same kind of module have the same parameters.
struct Kind {
  DriveCatalogue known;
  std::string drives;  ///< "left, right"
};

std::vector<Kind> kindsOf(const ToolConfig& config, const Transport& transport,
                          const catalogue::Catalogues& catalogues) {
  std::vector<Kind> kinds;
  std::vector<std::pair<profile::Series, bool>> seen;
  for (DriveIndex i = 0; i < config.drives.size(); ++i) {
    const cycle::DriveSetup& setup = config.cycle.drives[i];
    const bool module = transport.identity(i).timeout_owner == TimeoutOwner::kModule;
    std::size_t at = 0;
    while (at < seen.size() && seen[at] != std::make_pair(setup.series, module)) ++at;
    if (at < seen.size()) {
      kinds[at].drives += ", " + setup.name;
      continue;
    }
    seen.emplace_back(setup.series, module);
    kinds.push_back({catalogue::driveCatalogue(catalogues, setup.series, shortTransportName(config.transport), module),
                     setup.name});
  }
  return kinds;
}

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

std::string namesText(const catalogue::ValueNames& names, const std::string& indent) {
  std::string text;
  for (const auto& [first, value] : names) {
    const std::string numbers =
        std::to_string(first) + (value.last == first ? "" : " to " + std::to_string(value.last));
    text += indent + formatted("%-8s ", numbers.c_str()) + value.name + "\n";
  }
  return text;
}

void writeNames(JsonText& json, const catalogue::ValueNames& names) {
  if (names.empty()) return;
  json.key("values").begin('[');
  for (const auto& [first, value] : names) {
    json.begin('{').key("first").whole(first).key("last").whole(value.last).key("name").text(value.name).end('}');
  }
  json.end(']');
}

void writeRange(JsonText& json, const std::optional<catalogue::Limits>& range) {
  if (range) json.key("lowest").number(range->lowest).key("highest").number(range->highest);
}

void writeEntry(JsonText& json, const ParameterEntry& entry) {
  json.begin('{').key("parameter").text(formatted("P%03u", unsigned{entry.number})).key("number").whole(entry.number);
  json.key("name").text(entry.title()).key("unit").text(entry.unit.value_or("")).key("resolution").number(entry.step());
  writeRange(json, entry.range);
  if (entry.default_value) json.key("default").number(*entry.default_value);
  if (entry.per_set) json.key("per_set").boolean(*entry.per_set);
  json.key("may_write").boolean(entry.mayWrite());
  writeNames(json, entry.values);
  if (entry.elements) {
    json.key("elements").begin('[');
    for (unsigned index = 1; index <= *entry.elements; ++index) {
      json.begin('{').key("index").whole(index);
      if (const catalogue::Element* element = entry.element(index)) {
        json.key("name").text(element->name);
        writeRange(json, element->range);
        if (element->default_value) json.key("default").number(*element->default_value);
        writeNames(json, element->values);
      }
      json.end('}');
    }
    json.end(']');
  }
  json.key("source").begin('[');
  for (const std::string& source : entry.source) json.text(source);
  json.end(']').end('}');
}

std::string line(const char* what, const std::string& text) {
  return text.empty() ? "" : formatted("  %-10s ", what) + text + "\n";
}

}  // namespace

std::string listText(const ToolConfig& config, const Transport& transport, const catalogue::Catalogues& catalogues) {
  std::string text = "Drives:\n";
  for (DriveIndex i = 0; i < config.drives.size(); ++i) {
    const cycle::DriveSetup& setup = config.cycle.drives[i];
    const DriveIdentity identity = transport.identity(i);
    text += formatted("  %-12s %-24s %-8s parameter channel: %s\n", setup.name.c_str(), identity.address.c_str(),
                      profile::toString(setup.series), identity.parameter_channel.c_str());
  }
  for (const Kind& kind : kindsOf(config, transport, catalogues)) {
    text += std::string("\nParameters known of ") + profile::toString(kind.known.series()) + " (" + kind.drives +
            "); others are read and written raw:\n";
    for (const ParameterEntry* entry : kind.known.all()) {
      text += formatted("  P%03u  %-33s %-22s %s\n", unsigned{entry->number}, entry->title().c_str(),
                        catalogue::rangeText(*entry).c_str(), catalogue::kindText(*entry).c_str());
    }
  }
  return text;
}

std::string descriptionText(const ToolConfig& config, const Transport& transport,
                            const catalogue::Catalogues& catalogues, const std::string& name) {
  std::string text, error;
  for (const Kind& kind : kindsOf(config, transport, catalogues)) {
    const catalogue::Lookup found = kind.known.look(name);
    if (found.entry == nullptr) {
      error = found.error;
      continue;
    }
    text += std::string(text.empty() ? "" : "\n") + profile::toString(kind.known.series()) + " (" + kind.drives +
            "): " + descriptionOf(*found.entry);
  }
  if (text.empty()) throw UsageError(error);
  return text;
}

std::string listJson(const ToolConfig& config, const Transport& transport, const catalogue::Catalogues& catalogues,
                     const std::string& name) {
  JsonText json;
  json.begin('{').key("drives").begin('[');
  for (DriveIndex i = 0; i < config.drives.size(); ++i) {
    const cycle::DriveSetup& setup = config.cycle.drives[i];
    const DriveIdentity identity = transport.identity(i);
    json.begin('{').key("name").text(setup.name).key("address").text(identity.address);
    json.key("series").text(profile::toString(setup.series));
    json.key("parameter_channel").text(identity.parameter_channel).end('}');
  }
  json.end(']').key("known").begin('[');
  bool found = name.empty();
  std::string error;
  for (const Kind& kind : kindsOf(config, transport, catalogues)) {
    json.begin('{').key("series").text(profile::toString(kind.known.series())).key("drives").text(kind.drives);
    json.key("parameters").begin('[');
    if (name.empty()) {
      for (const ParameterEntry* entry : kind.known.all()) writeEntry(json, *entry);
    } else {
      const catalogue::Lookup look = kind.known.look(name);
      if (look.entry != nullptr) writeEntry(json, *look.entry);
      found = found || look.entry != nullptr;
      error = look.error;
    }
    json.end(']').end('}');
  }
  if (!found) throw UsageError(error);
  return json.end(']').end('}').str() + "\n";
}

std::string descriptionOf(const ParameterEntry& entry) {
  std::string text = formatted("P%03u ", unsigned{entry.number}) + entry.title() + "\n";
  text += line("range", catalogue::rangeText(entry));
  if (const auto factory = entry.defaultOf(1)) {
    text += line("default", catalogue::valueText(entry, static_cast<std::int32_t>(entry.rawOf(*factory))));
  }
  text += line("access", catalogue::kindText(entry));
  text += line("note", entry.note.value_or(""));
  text += line("erratum", entry.erratum.value_or(""));
  for (const std::string& source : entry.source) text += line("source", source);
  if (!entry.values.empty()) text += "  values\n" + namesText(entry.values, "    ");
  for (const catalogue::OtherValues& other : entry.other_values) {
    text += "  values, " + other.source + "\n" + namesText(other.values, "    ");
  }
  if (!entry.bits.empty()) text += "  bits\n";
  for (const auto& [first, field] : entry.bits) {
    const std::string bits = std::to_string(first) + (field.last == first ? "" : " to " + std::to_string(field.last));
    text += "    " + formatted("%-8s ", bits.c_str()) + field.name + "\n" + namesText(field.values, "             ");
  }
  if (!entry.element_infos.empty()) text += "  elements\n";
  for (const auto& [index, element] : entry.element_infos) {
    text += formatted("    [-%02u]    ", index) + element.name;
    if (element.range) text += ", " + catalogue::rangeText(entry, index);
    if (element.default_value) {
      text += ", default " +
              catalogue::valueText(entry, static_cast<std::int32_t>(entry.rawOf(*element.default_value)), index);
    }
    text += "\n" + namesText(element.values, "             ");
  }
  return text;
}

}  // namespace nord_driver::tools
