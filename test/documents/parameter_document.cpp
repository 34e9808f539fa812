#include "documents/parameter_document.h"

#include <optional>
#include <set>
#include <stdexcept>

#include "config/driver_settings.h"
#include "config/yaml_settings.h"
#include "documents/bus_readers.h"
#include "documents/recording_settings.h"
#include "node/node_config.h"

namespace nord_driver::documents {

namespace {

using Reader = void (*)(const Settings&, const std::vector<DriveSettings>&, double);

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> kReaders{{"profibus_dp", readProfibus},
                                                      {"canopen", readCanopen},
                                                      {"devicenet", readDevicenet},
                                                      {"interbus", readInterbus}};
  return kReaders;
}

void readOne(const YAML::Node& configuration, RecordsByTransport& all) {
  const YamlSettings settings{"~", configuration};
  const std::string transport = shortTransportName(readTransportName(settings));
  const RecordingSettings recording{settings, all[transport]};
  const node::NodeConfig config = node::readNodeConfig(recording, "");
  readers().at(transport)(*config.bus, config.drives, config.cycle.cycle_rate);
}

/// A section of doc/parameters.yaml and what it may say.
class Section {
 public:
  Section(const YAML::Node& source, const RecordsByTransport& records, std::vector<std::string>& problems)
      : source_(source), records_(records), problems_(problems) {}

  std::string text() {
    std::string text = "\n## " + source_["title"].as<std::string>() + "\n\n";
    if (source_["about"]) text += source_["about"].as<std::string>() + "\n\n";
    text += "| Key | Value | Default | Meaning |\n|---|---|---|---|\n";
    return text + rows("node", Group::kNode, "") + rows("bus", Group::kBus, "bus/") +
           rows("drive", Group::kDrive, "drives/<name>/");
  }

 private:
  std::string rows(const char* part, Group group, const std::string& prefix) {
    std::string text;
    for (const auto& entry : source_[part]) {
      text += row(entry.first.as<std::string>(), entry.second, group, prefix);
    }
    return text;
  }

  std::string row(const std::string& key, const YAML::Node& said, Group group, const std::string& prefix) {
    const std::string name = prefix + key;
    const std::optional<KeyRecord> record = find(key, group);
    if (!record) {
      problem(name, "is described and nobody reads it");
      return "";
    }
    const bool plain = said.IsScalar();
    const auto words = [&](const char* what) { return plain || !said[what] ? "" : said[what].as<std::string>(); };
    const std::string unit = words("unit"), range = words("range"), fallback = words("default");
    if (record->values().empty()) problem(name, "is asked for and never read: no configuration of the test has it");
    if (record->valuesVary() != !range.empty()) {
      problem(name, range.empty() ? "has a range that depends on other keys: say how, as \"range\""
                                  : "has a range in the code, and a second one in the document");
    }
    if (record->fallbackVaries() && fallback.empty()) {
      problem(name, "has a default that depends on other keys: say how, as \"default\"");
    }
    if (!record->fallbackVaries() && !record->fallback().empty() && !fallback.empty()) {
      problem(name, "has a default in the code, and a second one in the document");
    }
    const bool text = record->asked_as.count("a text") + record->asked_as.count("a text or a list of texts") != 0;
    if (record->notes.empty() && !text && fallback.empty()) {
      problem(name, "is read without a note of its default (booleanOr, numberOr, ...): say it, as \"default\"");
    }
    std::string usual = record->fallback().empty() ? record->isRequired() ? "required" : "none" : record->fallback();
    if (!fallback.empty()) usual = fallback;
    const std::string values = range.empty() ? record->values() : range;
    return "| `" + name + "` | " + values + (unit.empty() ? "" : " " + unit) + " | " + usual + " | " +
           (plain ? said.as<std::string>() : words("meaning")) + " |\n";
  }

  /// Of the section's transport, or of all that have it.
  std::optional<KeyRecord> find(const std::string& key, Group group) const {
    std::optional<KeyRecord> found;
    const std::string transport = source_["transport"] ? source_["transport"].as<std::string>() : "";
    for (const auto& [name, groups] : records_) {
      if (!transport.empty() && name != transport) continue;
      const auto keys = groups.find(group);
      if (keys == groups.end()) continue;
      const auto at = keys->second.find(key);
      if (at == keys->second.end()) continue;
      if (!found) found.emplace();
      found->add(at->second);
    }
    return found;
  }

  void problem(const std::string& name, const std::string& what) {
    problems_.push_back(source_["title"].as<std::string>() + ": " + name + " " + what);
  }

  const YAML::Node source_;
  const RecordsByTransport& records_;
  std::vector<std::string>& problems_;
};

/// Names in `part` of the sections that speak of all transports, or of this one.
std::set<std::string> described(const YAML::Node& sections, const std::string& transport, const char* part,
                                std::vector<std::string>& problems) {
  std::set<std::string> names;
  for (const YAML::Node& section : sections) {
    if (section["transport"] && section["transport"].as<std::string>() != transport) continue;
    for (const auto& entry : section[part]) {
      if (names.insert(entry.first.as<std::string>()).second) continue;
      problems.push_back(transport + ": " + entry.first.as<std::string>() + " is described twice");
    }
  }
  return names;
}

void findUndescribed(const YAML::Node& sections, const RecordsByTransport& records,
                     std::vector<std::string>& problems) {
  const std::map<Group, const char*> parts{{Group::kNode, "node"}, {Group::kBus, "bus"}, {Group::kDrive, "drive"}};
  for (const auto& [transport, groups] : records) {
    for (const auto& [group, keys] : groups) {
      const std::set<std::string> names = described(sections, transport, parts.at(group), problems);
      for (const auto& entry : keys) {
        if (names.count(entry.first) != 0) continue;
        problems.push_back(transport + ": " + parts.at(group) + " key " + entry.first + " is read and not described");
      }
    }
  }
}

}  // namespace

RecordsByTransport readAll(const YAML::Node& configurations) {
  constexpr double kOtherRate = 20.0;  // Hz
  RecordsByTransport records;
  for (const YAML::Node& configuration : configurations) {
    readOne(configuration, records);
    YAML::Node slower = YAML::Clone(configuration);
    slower["cycle_rate"] = kOtherRate;
    readOne(slower, records);
  }
  return records;
}

Document makeDocument(const YAML::Node& meanings, const RecordsByTransport& records) {
  Document document;
  document.text = "# Parameters\n\n" + meanings["about"].as<std::string>() + "\n";
  for (const YAML::Node& section : meanings["sections"]) {
    document.text += Section{section, records, document.problems}.text();
  }
  findUndescribed(meanings["sections"], records, document.problems);
  return document;
}

Document documentOf(const std::string& folder) {
  return makeDocument(YAML::LoadFile(folder + "/doc/parameters.yaml"),
                      readAll(YAML::LoadFile(folder + "/test/documents/configurations.yaml")));
}

}  // namespace nord_driver::documents
