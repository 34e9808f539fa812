#include "tools/parameter_json.h"

#include <algorithm>

#include "tools/parameter_name.h"

namespace nord_driver::tools {

namespace {

unsigned indexOf(const catalogue::ParameterAddress& address) {
  return std::max<unsigned>(address.index, 1);
}

void writeList(JsonText& json, const std::string& key, const Dump& dump, bool settings,
               const catalogue::DriveCatalogue& known) {
  json.key(key).begin('[');
  for (const Dump::Value& value : dump.values) {
    if (isSetting(value.address) != settings) continue;
    json.begin('{');
    writeAddress(json, value.address, known);
    writeValue(json, value.address, value.raw, known);
    json.end('}');
  }
  json.end(']');
}

}  // namespace

void writeAddress(JsonText& json, const catalogue::ParameterAddress& address, const catalogue::DriveCatalogue& known) {
  json.key("parameter").text(parameterName(address)).key("number").whole(address.number);
  if (address.index != 0) json.key("index").whole(address.index);
  if (address.parameter_set != 0) json.key("set").whole(address.parameter_set);
  const std::string name = catalogue::fullName(known.find(address.number), indexOf(address));
  if (!name.empty()) json.key("name").text(name);
}

void writeValue(JsonText& json, const catalogue::ParameterAddress& address, std::int32_t raw,
                const catalogue::DriveCatalogue& known) {
  json.key("raw").whole(raw);
  const catalogue::ParameterEntry* entry = known.find(address.number);
  if (entry == nullptr) return;
  json.key("value").number(entry->valueOf(raw, indexOf(address))).key("unit").text(entry->unitOf(indexOf(address)));
  json.key("text").text(known.valueText(entry, raw, indexOf(address)));
}

std::string answerJson(const catalogue::ParameterAddress& address, const ParameterAnswer& answer,
                       const DriveParameters& drive) {
  catalogue::ParameterAddress meant = address;
  meant.parameter_set = answer.set;
  JsonText json;
  json.begin('{').key("drive").text(drive.name());
  writeAddress(json, meant, drive.known());
  writeValue(json, meant, answer.raw, drive.known());
  if (!answer.message.empty()) json.key("note").text(answer.message);
  return json.end('}').str() + "\n";
}

std::string dumpJson(const Dump& dump, const DriveParameters& drive, const std::string& missing_key,
                     const std::vector<catalogue::ParameterAddress>& missing) {
  JsonText json;
  json.begin('{').key("drive").text(drive.name()).key("address").text(drive.identity().address);
  json.key("series").text(profile::toString(dump.series));
  writeList(json, "settings", dump, true, drive.known());
  writeList(json, "information", dump, false, drive.known());
  json.key(missing_key).begin('[');
  for (const catalogue::ParameterAddress& address : missing) json.text(parameterName(address));
  return json.end(']').end('}').str() + "\n";
}

std::string differencesJson(const Differences& differences, const catalogue::DriveCatalogue& known,
                            const std::string& first, const std::string& second) {
  JsonText json;
  json.begin('{').key("first").text(first).key("second").text(second);
  json.key("compared").whole(static_cast<std::int64_t>(differences.compared)).key("differences").begin('[');
  for (const Difference& difference : differences.found) {
    json.begin('{');
    writeAddress(json, difference.address, known);
    const auto side = [&](const char* key, const std::optional<std::int32_t>& raw) {
      if (!raw) return;
      json.key(key).begin('{');
      writeValue(json, difference.address, *raw, known);
      json.end('}');
    };
    side("first", difference.first);
    side("second", difference.second);
    json.end('}');
  }
  return json.end(']').end('}').str() + "\n";
}

}  // namespace nord_driver::tools
