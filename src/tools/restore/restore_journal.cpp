#include "tools/restore/restore_journal.h"

#include <yaml-cpp/yaml.h>

#include <filesystem>

#include "state/state_file.h"
#include "tools/parameter_name.h"

namespace nord_driver::tools {

namespace {

constexpr RestoreState kRestoreStates[] = {RestoreState::kWriting, RestoreState::kTakingBack, RestoreState::kVerified,
                                           RestoreState::kTakenBack};
constexpr ChangeState kChangeStates[] = {ChangeState::kPending, ChangeState::kBegun, ChangeState::kWritten,
                                         ChangeState::kTakenBack};

template <typename State, std::size_t kSize>
State stateFrom(const State (&states)[kSize], const std::string& word) {
  std::string expected;
  for (const State state : states) {
    if (word == toString(state)) return state;
    expected += (expected.empty() ? "" : ", ") + std::string(toString(state));
  }
  throw UsageError("state \"" + word + "\" is not known, expected one of " + expected);
}

std::string quoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

std::string whole(const std::string& key, const std::string& value) {
  return key + ": " + value + "\n";
}

RestoreRecord parse(const YAML::Node& file) {
  RestoreRecord record;
  const auto text = [&file](const char* key) { return file[key].as<std::string>(); };
  record.drive = text("drive");
  record.address = text("address");
  const auto series = profile::seriesFrom(text("series"));
  if (!series) throw UsageError("series \"" + text("series") + "\" is not known");
  record.series = *series;
  record.file = text("file");
  record.persistent = file["persistent"].as<bool>();
  record.state = stateFrom(kRestoreStates, text("state"));
  if (file["why"]) record.why = text("why");
  if (file["P560"]) record.eeprom_switch = file["P560"].as<std::int32_t>();
  for (const auto& entry : file["changes"]) {
    RestoreRecord::Change change;
    change.address = parseParameterName(entry["parameter"].as<std::string>());
    change.before = entry["before"].as<std::int32_t>();
    change.after = entry["after"].as<std::int32_t>();
    change.state = stateFrom(kChangeStates, entry["state"].as<std::string>());
    record.changes.push_back(change);
  }
  for (const auto& entry : file["same"]) {
    record.same.push_back({parseParameterName(entry.first.as<std::string>()), entry.second.as<std::int32_t>()});
  }
  return record;
}

}  // namespace

const char* toString(RestoreState state) noexcept {
  switch (state) {
    case RestoreState::kWriting:
      return "writing";
    case RestoreState::kTakingBack:
      return "taking back";
    case RestoreState::kVerified:
      return "done";
    case RestoreState::kTakenBack:
      return "taken back";
  }
  return "";
}

const char* toString(ChangeState state) noexcept {
  switch (state) {
    case ChangeState::kPending:
      return "pending";
    case ChangeState::kBegun:
      return "begun";
    case ChangeState::kWritten:
      return "written";
    case ChangeState::kTakenBack:
      return "taken back";
  }
  return "";
}

RestoreRecord recordOf(const RestorePlan& plan, const DriveParameters& drive, const std::string& file,
                       bool persistent) {
  RestoreRecord record;
  record.drive = drive.name();
  record.address = drive.identity().address;
  record.series = drive.series();
  record.file = file;
  record.persistent = persistent;
  for (const RestoreChange& change : plan.changes) record.changes.push_back({change, ChangeState::kPending});
  record.same = plan.same;
  return record;
}

std::string recordText(const RestoreRecord& record) {
  std::string text = "# nord_param restore: what it changes in drive " + record.drive +
                     ". --resume goes on, --take-back puts back what was there.\n";
  text += whole("drive", quoted(record.drive)) + whole("address", quoted(record.address));
  text += whole("series", profile::toString(record.series)) + whole("file", quoted(record.file));
  text += whole("persistent", record.persistent ? "true" : "false") + whole("state", toString(record.state));
  if (!record.why.empty()) text += whole("why", quoted(record.why));
  if (record.eeprom_switch) text += whole("P560", std::to_string(*record.eeprom_switch));
  text += record.changes.empty() ? "changes: []\n" : "changes:\n";
  for (const RestoreRecord::Change& change : record.changes) {
    text += "  - {parameter: \"" + parameterName(change.address) + "\", before: " + std::to_string(change.before) +
            ", after: " + std::to_string(change.after) + ", state: " + toString(change.state) + "}\n";
  }
  text += record.same.empty() ? "same: {}\n" : "same:\n";
  for (const Dump::Value& value : record.same) {
    text += "  \"" + parameterName(value.address) + "\": " + std::to_string(value.raw) + "\n";
  }
  return text;
}

RestoreRecord recordFrom(const std::string& text, const std::string& file) {
  try {
    return parse(YAML::Load(text));
  } catch (const YAML::Exception& error) {
    throw UsageError(file + " is no journal of nord_param restore: " + error.what());
  } catch (const UsageError& error) {
    throw UsageError(file + " is no journal of nord_param restore: " + error.what());
  }
}

std::optional<RestoreRecord> RestoreJournal::read() const {
  std::optional<std::string> text;
  // Looking alone makes no folder.
  std::error_code unreadable;
  if (!std::filesystem::exists(path_, unreadable)) return std::nullopt;
  try {
    text = state::StateFile{path_}.read();
  } catch (const state::StateError& error) {
    throw UsageError(error.what());
  }
  if (!text) return std::nullopt;
  return recordFrom(*text, path_);
}

void RestoreJournal::write(const RestoreRecord& record) const {
  try {
    state::StateFile{path_}.replace(recordText(record));
  } catch (const state::StateError& error) {
    throw Trouble(std::string(error.what()) +
                  "; nothing is written to the drive without this journal: --journal names another file");
  }
}

std::string journalPath(const char* ros_home, const char* home, const std::string& drive) {
  std::string path = state::stateFilePath(ros_home, home, "restore/" + drive + ".journal");
  if (path.empty()) {
    throw UsageError("neither ROS_HOME nor HOME says where the journal belongs: name it with --journal");
  }
  return path;
}

}  // namespace nord_driver::tools
