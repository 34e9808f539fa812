#include "tools/parameter_dump.h"

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <system_error>

#include "config/setting_checks.h"
#include "tools/parameter_name.h"
#include "tools/patient_access.h"

namespace nord_driver::tools {

namespace {

// Refused for good, it is not there; anything else ends the whole.
ParameterAnswer readFrom(DriveParameters& drive, const catalogue::ParameterAddress& address,
                         const std::atomic<bool>& end_asked) {
  if (end_asked) throw Trouble("ended before all parameters were read");
  ParameterAnswer answer = askPatiently(drive, [&] { return drive.read(address); });
  if (!answer.success && !answer.refused) throw Trouble(answer.message);
  return answer;
}

unsigned indexOf(const catalogue::ParameterAddress& address) {
  return address.index == 0 ? 1u : address.index;
}

// As a text in double quotes.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') result += '\\';
    result += letter;
  }
  return result + "\"";
}

std::string line(const Dump::Value& value, const catalogue::DriveCatalogue& known) {
  const unsigned index = indexOf(value.address);
  const catalogue::ParameterEntry* entry = known.find(value.address.number);
  std::string text = "  \"" + parameterName(value.address) + "\": {raw: " + std::to_string(value.raw);
  if (entry != nullptr) {
    text += ", value: " + shortNumber(entry->valueOf(value.raw, index)) + ", unit: " + quoted(entry->unitOf(index)) +
            ", name: " + quoted(catalogue::fullName(entry, index));
    if (!entry->valuesOf(index).empty() || !entry->bits.empty()) {
      text += ", text: " + quoted(known.valueText(entry, value.raw, index));
    }
  }
  return text + "}\n";
}

std::string section(const Dump& dump, const catalogue::DriveCatalogue& known, const std::string& name, bool settings) {
  std::string text = name + ":\n";
  for (const Dump::Value& value : dump.values) {
    if (isSetting(value.address) == settings) text += line(value, known);
  }
  return text;
}

Dump parse(const YAML::Node& file) {
  Dump dump;
  if (!file.IsMap() || !file["series"].IsDefined() || !file["settings"].IsDefined())
    throw UsageError("expected the keys series and settings");
  const auto series = profile::seriesFrom(file["series"].as<std::string>());
  if (!series) throw UsageError("series \"" + file["series"].as<std::string>() + "\" is not known");
  dump.series = *series;
  for (const char* part : {"settings", "information"}) {
    for (const auto& entry : file[part]) {
      Dump::Value value;
      value.address = parseParameterName(entry.first.as<std::string>());
      value.raw = entry.second["raw"].as<std::int32_t>();
      dump.values.push_back(value);
    }
  }
  const YAML::Node& count = file["count"];
  if (count.IsDefined() && count.as<std::size_t>() != dump.values.size()) {
    throw UsageError("expected the " + count.as<std::string>() + " values that its count names, but it has " +
                     std::to_string(dump.values.size()) +
                     ": it was cut off; where values were taken out on purpose, take out the count, too");
  }
  return dump;
}

}  // namespace

Dump takeDump(DriveParameters& drive, const std::atomic<bool>& end_asked) {
  Dump dump;
  dump.series = drive.series();
  std::optional<std::uint16_t> unknown;
  for (const catalogue::ParameterAddress& address : knownParameters(drive.known())) {
    if (unknown == address.number) continue;
    const ParameterAnswer answer = readFrom(drive, address, end_asked);
    if (answer.success) {
      dump.values.push_back({address, answer.raw});
    } else if (answer.unknown) {
      unknown = address.number;
      catalogue::ParameterAddress whole;
      whole.number = address.number;
      dump.missing.push_back(whole);
    } else {
      dump.missing.push_back(address);
    }
  }
  return dump;
}

std::string dumpText(const Dump& dump, const catalogue::DriveCatalogue& known, const std::string& drive,
                     const std::string& address) {
  std::string text = "# What nord_param read from drive " + drive + ", " + address + "\n";
  text += std::string("series: ") + profile::toString(dump.series) + "\n";
  text += "count: " + std::to_string(dump.values.size()) + "\n";
  text += section(dump, known, "settings", true);
  text += "# changes by itself, is not compared\n";
  text += section(dump, known, "information", false);
  for (const catalogue::ParameterAddress& missing : dump.missing) {
    text += "# not in this inverter: " + parameterName(missing) + "\n";
  }
  return text;
}

Dump readDump(const std::string& file) {
  std::error_code unknown;
  if (std::filesystem::is_directory(file, unknown)) throw UsageError(file + ": it is a folder");
  try {
    return parse(YAML::LoadFile(file));
  } catch (const YAML::BadFile&) {
    std::error_code unreadable;
    throw UsageError(
        file + (std::filesystem::exists(file, unreadable) ? ": this file cannot be read" : ": there is no such file"));
  } catch (const YAML::Exception& error) {
    throw UsageError(file + " is no dump of nord_param: " + error.what());
  } catch (const UsageError& error) {
    throw UsageError(file + " is no dump of nord_param: " + error.what());
  }
}

Dump dumpFrom(const std::string& text, const std::string& name) {
  try {
    return parse(YAML::Load(text));
  } catch (const YAML::Exception& error) {
    throw UsageError(name + " is no dump of nord_param: " + error.what());
  } catch (const UsageError& error) {
    throw UsageError(name + " is no dump of nord_param: " + error.what());
  }
}

}  // namespace nord_driver::tools
