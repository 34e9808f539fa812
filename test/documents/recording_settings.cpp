#include "documents/recording_settings.h"

namespace nord_driver::documents {

RecordingSettings::RecordingSettings(const TreeSettings& settings, KeyRecords& records)
    : RecordingSettings(settings, records, Place::kNode, Group::kNode) {}

RecordingSettings::RecordingSettings(const TreeSettings& settings, KeyRecords& records, Place place, Group group)
    : TreeSettings(settings), records_(records), place_(place), group_(group) {}

KeyRecord& RecordingSettings::recordOf(const std::string& key) const {
  // Keys below names that users choose: one record for all of them.
  for (const auto& [group, name] : {std::pair{"setpoints/", "<setpoint>"}, {"signals/", "<signal>"}}) {
    const std::string begin{group};
    const std::size_t slash = key.find('/', begin.size());
    if (group_ == Group::kNode || key.compare(0, begin.size(), begin) != 0 || slash == std::string::npos) continue;
    return records_[group_][begin + name + key.substr(slash)];
  }
  return records_[group_][key];
}

// Nothing is said of a group: its keys are.
void RecordingSettings::ask(const std::string& key, const char* kind) const {
  if (place_ == Place::kDrives || (place_ == Place::kNode && key == "drives")) return;
  KeyRecord& record = recordOf(key);
  if (*kind != '\0') record.asked_as.insert(kind);
  if (!TreeSettings::has(key)) record.was_absent = true;
}

bool RecordingSettings::has(const std::string& key) const {
  ask(key, "");
  return TreeSettings::has(key);
}

std::optional<double> RecordingSettings::number(const std::string& key) const {
  ask(key, "a number");
  return TreeSettings::number(key);
}

std::optional<std::int64_t> RecordingSettings::integer(const std::string& key) const {
  ask(key, "a whole number");
  return TreeSettings::integer(key);
}

std::optional<bool> RecordingSettings::boolean(const std::string& key) const {
  ask(key, "true or false");
  return TreeSettings::boolean(key);
}

std::optional<std::string> RecordingSettings::text(const std::string& key) const {
  ask(key, "a text");
  return TreeSettings::text(key);
}

std::optional<std::vector<std::string>> RecordingSettings::texts(const std::string& key) const {
  ask(key, "a text or a list of texts");
  return TreeSettings::texts(key);
}

std::optional<std::vector<std::string>> RecordingSettings::words(const std::string& key) const {
  ask(key, "a text or a list of texts");
  return TreeSettings::words(key);
}

std::optional<std::vector<double>> RecordingSettings::numbers(const std::string& key) const {
  ask(key, "a list of numbers");
  return TreeSettings::numbers(key);
}

std::shared_ptr<TreeSettings> RecordingSettings::group(const std::string& key) const {
  const std::shared_ptr<TreeSettings> below = TreeSettings::group(key);
  const bool drives = place_ == Place::kNode && key == "drives";
  const Group group = place_ == Place::kDrives ? Group::kDrive : Group::kBus;
  return std::shared_ptr<TreeSettings>(
      new RecordingSettings(*below, records_, drives ? Place::kDrives : Place::kInside, group));
}

void RecordingSettings::listen(const std::string& key, const SettingNote& note) const {
  recordOf(key).add(note);
}

}  // namespace nord_driver::documents
