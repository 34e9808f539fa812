#include "tools/counted_write.h"

#include <cstdlib>

#include "nord_driver/profile/series.h"
#include "state/state_file.h"

namespace nord_driver::tools {

using state::DriveEeprom;

state::EepromBudget eepromBudget(const EepromSettings& settings) {
  const std::string file = settings.state_file.empty() ? state::stateFilePath(std::getenv("ROS_HOME"),
                                                                              std::getenv("HOME"), "eeprom_writes.yaml")
                                                       : settings.state_file;
  return {file, settings.budget};
}

state::DrivePlace placeOf(const std::string& end_point, const std::string& transport, const DriveSettings& drive) {
  state::DrivePlace place;
  place.end_point = end_point.empty() ? transport : end_point;
  place.address = drive.settings->integer("address").value_or(0);
  place.inverter = static_cast<unsigned>(drive.settings->integer("inverter").value_or(1));
  const std::string written = drive.settings->text("series").value_or("");
  const auto series = profile::seriesFrom(written);  // one drive, one count: not by how somebody wrote its series
  place.series = series ? profile::toString(*series) : written;
  return place;
}

CountedWrite countedWrite(DriveEeprom& eeprom, const profile::ParameterRequest& parameter,
                          const std::function<std::optional<cycle::Completion>()>& write) {
  using Clock = std::chrono::system_clock;
  const bool persistent = parameter.action == profile::ParameterAction::kWritePersistent;
  const DriveEeprom::Storage storage = persistent ? DriveEeprom::Storage::kEeprom : DriveEeprom::Storage::kRam;
  CountedWrite result;
  const DriveEeprom::Permission permission = eeprom.ask(storage, Clock::now());
  result.refusal = permission.refusal;
  if (!result.refusal.empty()) return result;
  result.completion = write();
  DriveEeprom::Outcome outcome;
  outcome.eeprom_written = !result.completion || result.completion->parameter.eeprom_written;
  outcome.answered = result.completion && !result.completion->unanswered;
  if (result.completion) {
    const profile::ParameterResult& told = result.completion->parameter;
    outcome.success = result.completion->success;
    outcome.by_ram_order = !persistent && outcome.success && *told.note == '\0';
  }
  result.note = eeprom.settle(storage, permission, outcome, Clock::now());
  return result;
}

}  // namespace nord_driver::tools
