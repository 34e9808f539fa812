#include "catalogue/catalogue_file.h"

#include <algorithm>
#include <limits>
#include <set>

#include "config/nearest_name.h"

namespace nord_driver::catalogue {

namespace {

constexpr std::int64_t kMaxElements = 64;  // the sub-index of a set-dependent array has 6 bits (BU 2700 6.5.1.2)
constexpr std::int64_t kMaxBit = 31;

struct Row {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

// The key of a named value or bit: "4", "0xFF" or "13..16".
Row readRow(const std::string& file, const YAML::Node& key, const std::string& path, std::int64_t lowest,
            std::int64_t highest) {
  const std::string text = key.IsScalar() ? key.Scalar() : "";
  const std::size_t dots = text.find("..");
  const auto first = wholeNumber(text.substr(0, dots));
  const auto last = dots == std::string::npos ? first : wholeNumber(text.substr(dots + 2));
  if (!first || !last || *first > *last || *first < lowest || *last > highest) {
    throw wrongValue(file, key, path,
                     "a whole number of " + std::to_string(lowest) + " ... " + std::to_string(highest) +
                         ", or two of them with the lower one first (13..16)");
  }
  return {*first, *last};
}

// `rows` are those before it, by their first number.
template <typename Rows>
void rejectOverlap(const std::string& file, const YAML::Node& key, const std::string& path, const Row& row,
                   const Rows& rows) {
  for (const auto& [first, other] : rows) {
    if (row.first > std::int64_t{other.last} || std::int64_t{first} > row.last) continue;
    throw wrongValue(file, key, path, "every number once: it stands in two rows");
  }
}

ValueNames readNames(const std::string& file, const YAML::Node& node, const std::string& path) {
  ValueNames names;
  if (!node.IsDefined()) return names;
  YamlMap checked(file, path, node);
  for (const auto& member : node) {
    const Row row = readRow(file, member.first, path, std::numeric_limits<std::int32_t>::min(),
                            std::numeric_limits<std::int32_t>::max());
    rejectOverlap(file, member.first, path, row, names);
    names[static_cast<std::int32_t>(row.first)] = {static_cast<std::int32_t>(row.last),
                                                   checked.text(member.first.Scalar()).value_or("")};
  }
  return names;
}

std::optional<Limits> readRange(YamlMap& map) {
  const YAML::Node node = map.node("range");
  if (!node.IsDefined()) return std::nullopt;
  const std::string expected = "two numbers, the lowest and the highest value: [0, 10]";
  if (!node.IsSequence() || node.size() != 2 || !node[0].IsScalar() || !node[1].IsScalar()) {
    throw map.wrong("range", expected);
  }
  const auto lowest = decimalNumber(node[0].Scalar());
  const auto highest = decimalNumber(node[1].Scalar());
  if (!lowest || !highest) throw map.wrong("range", expected);
  if (*lowest > *highest) throw map.wrong("range", "the lowest value first");
  return Limits{*lowest, *highest};
}

std::optional<unsigned> readSize(YamlMap& map) {
  const auto size = map.integer("size");
  if (!size) return std::nullopt;
  if (*size != 8 && *size != 16 && *size != 32) throw map.wrong("size", "8, 16 or 32 bits");
  return static_cast<unsigned>(*size);
}

std::map<unsigned, BitField> readBits(YamlMap& map) {
  std::map<unsigned, BitField> bits;
  const YAML::Node node = map.node("bits");
  if (!node.IsDefined()) return bits;
  const std::string path = map.pathOf("bits");
  const YamlMap checked(map.file(), path, node);
  for (const auto& member : node) {
    const Row row = readRow(map.file(), member.first, path, 0, kMaxBit);
    rejectOverlap(map.file(), member.first, path, row, bits);
    BitField field;
    field.last = static_cast<unsigned>(row.last);
    if (member.second.IsMap()) {
      YamlMap inner(map.file(), path + ": " + member.first.Scalar(), member.second);
      const auto name = inner.text("name");
      if (!name) throw inner.missing("name", "a text");
      field.name = *name;
      field.values = readNames(map.file(), inner.node("values"), inner.pathOf("values"));
      inner.rejectUnknown();
    } else if (member.second.IsScalar()) {
      field.name = member.second.Scalar();
    } else {
      throw wrongValue(map.file(), member.second, path, "a name, or a group with name and values");
    }
    bits[static_cast<unsigned>(row.first)] = field;
  }
  return bits;
}

Element readElement(const std::string& file, const YAML::Node& node, const std::string& path) {
  Element element;
  if (node.IsScalar()) {
    element.name = node.Scalar();
    return element;
  }
  YamlMap map(file, path, node);
  element.name = map.text("name").value_or("");
  element.unit = map.text("unit");
  element.size = readSize(map);
  element.range = readRange(map);
  element.default_value = map.number("default");
  element.values = readNames(file, map.node("values"), map.pathOf("values"));
  map.rejectUnknown();
  return element;
}

// A number, when nothing is known of the elements but how many there are; a map otherwise.
void readElements(YamlMap& map, ParameterEntry& entry) {
  const YAML::Node node = map.node("elements");
  if (!node.IsDefined()) return;
  const std::string path = map.pathOf("elements");
  if (node.IsScalar()) {
    const auto count = wholeNumber(node.Scalar());
    if (!count || *count < 1 || *count > kMaxElements) {
      throw map.wrong("elements", "1 ... 64, or a name for every element");
    }
    entry.elements = static_cast<unsigned>(*count);
    return;
  }
  const YamlMap checked(map.file(), path, node);
  for (const auto& member : node) {
    const Row row = readRow(map.file(), member.first, path, 1, kMaxElements);
    if (row.first != row.last) throw wrongValue(map.file(), member.first, path, "one number");
    const auto index = static_cast<unsigned>(row.first);
    entry.element_infos[index] = readElement(map.file(), member.second, path + ": " + std::to_string(index));
  }
}

std::vector<OtherValues> readOtherValues(YamlMap& map) {
  std::vector<OtherValues> others;
  const YAML::Node node = map.node("other_values");
  if (!node.IsDefined()) return others;
  if (!node.IsSequence()) throw map.wrong("other_values", "a list of groups with source and values");
  for (const YAML::Node& item : node) {
    YamlMap inner(map.file(), map.pathOf("other_values"), item);
    const auto source = inner.text("source");
    if (!source) throw inner.missing("source", "a text");
    others.push_back({*source, readNames(map.file(), inner.node("values"), inner.pathOf("values"))});
    inner.rejectUnknown();
  }
  return others;
}

ParameterEntry readEntry(const std::string& file, const YAML::Node& node) {
  YamlMap unnamed(file, "parameters", node);
  const auto number = unnamed.integer("number");
  if (!number) throw unnamed.missing("number", "the number of the parameter");
  if (*number < 0 || *number > 0xFFFF) throw unnamed.wrong("number", "0 ... 65535");

  YamlMap map(file, "number " + std::to_string(*number), node);
  map.integer("number");
  ParameterEntry entry;
  entry.number = static_cast<std::uint16_t>(*number);
  entry.name = map.text("name");
  entry.unit = map.text("unit");
  entry.resolution = map.number("resolution");
  if (entry.resolution && *entry.resolution <= 0.0) throw map.wrong("resolution", "a number above 0");
  entry.unit_unknown = map.flag("unit_unknown");
  entry.range = readRange(map);
  entry.default_value = map.number("default");
  entry.per_set = map.flag("per_set");
  readElements(map, entry);
  entry.values = readNames(file, map.node("values"), map.pathOf("values"));
  entry.other_values = readOtherValues(map);
  entry.bits = readBits(map);
  if (const auto format = map.text("format")) {
    if (*format != "hex" && *format != "decimal") throw map.wrong("format", "hex or decimal");
    entry.hex = *format == "hex";
  }
  entry.is_signed = map.flag("signed");
  entry.size = readSize(map);
  entry.read_only = map.flag("read_only");
  entry.never_write = map.flag("never_write");
  entry.supervisor = map.flag("supervisor");
  entry.note = map.text("note");
  entry.erratum = map.text("erratum");
  entry.source = map.texts("source");
  entry.place = map.place();
  map.rejectUnknown();
  return entry;
}

}  // namespace

std::vector<Device> readDevices(YamlMap& map) {
  std::vector<Device> devices;
  for (const std::string& name : map.texts("devices")) {
    const auto device = deviceFrom(name);
    if (!device) {
      std::vector<std::string> names;
      std::string list;
      for (const Device& known : allDevices()) {
        names.push_back(toString(known));
        list += (list.empty() ? "" : ", ") + names.back();
      }
      const std::string nearest = nearestName(name, names);
      throw map.wrong("devices", nearest.empty() ? "some of " + list : "perhaps \"" + nearest + "\"");
    }
    if (std::find(devices.begin(), devices.end(), *device) != devices.end()) {
      throw map.wrong("devices", "every device once");
    }
    devices.push_back(*device);
  }
  return devices;
}

ParameterFile readParameterFile(const std::string& file) {
  YamlMap map(file, "", loadMap(file));
  ParameterFile result;
  result.devices = readDevices(map);
  if (result.devices.empty()) throw map.missing("devices", "a list of series or bus modules");
  const YAML::Node list = map.node("parameters");
  if (!list.IsDefined()) throw map.missing("parameters", "a list of parameters");
  if (!list.IsSequence()) throw map.wrong("parameters", "a list of parameters");
  // A user's file may hold faults as well; FaultCatalogue reads those.
  if (map.node("faults").IsDefined()) {
    for (const char* key : {"codes", "resolution"}) map.node(key);
  }
  map.rejectUnknown();
  std::set<std::uint16_t> numbers;
  for (const YAML::Node& item : list) {
    result.entries.push_back(readEntry(file, item));
    const ParameterEntry& entry = result.entries.back();
    if (!numbers.insert(entry.number).second) {
      throw wrongPlace(entry.place,
                       "number " + std::to_string(entry.number) + " stands twice in this file, expected it once");
    }
  }
  return result;
}

}  // namespace nord_driver::catalogue
