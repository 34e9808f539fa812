#include "node/state_log.h"

#include <utility>

#include "cycle/user_messages.h"
#include "node/bus_publisher.h"
#include "node/recovery_hint.h"
#include "node/remembered_fault.h"
#include "profile/fault_number.h"

namespace nord_driver::node {

namespace {

using Level = LogLine::Level;

// P700 is read within a few cycles; a drive that does not tell its number has a fault all the same.
constexpr Duration kNumberAwaited = std::chrono::seconds{2};

// What tells one stop from another one. /diagnostics has the inverter's own reason as it is now.
std::string incidentIn(const std::string& stop) {
  const std::size_t at = stop.find(cycle::kOwnReason);
  const std::size_t end = stop.rfind(')');
  if (at == std::string::npos || end == std::string::npos || end < at) return stop;
  return stop.substr(0, at) + stop.substr(end);
}

}  // namespace

StateLog::StateLog(LoggedDrives drives) : drives_(std::move(drives)), faults_(drives_.names.size()) {}

std::vector<LogLine> StateLog::poll(const cycle::CycleSnapshot& snapshot, Instant now) {
  std::vector<LogLine> lines;
  pollBus(snapshot, now, lines);
  pollStop(snapshot, lines);
  for (std::size_t i = 0; i < faults_.size(); ++i) pollFault(snapshot.drives[i], i, now, lines);
  return lines;
}

void StateLog::pollBus(const cycle::CycleSnapshot& snapshot, Instant now, std::vector<LogLine>& lines) {
  std::string text = busSentence(snapshot, drives_.names);
  const bool of_the_device = !drives_.bus.empty() && text.compare(0, drives_.bus.size(), drives_.bus) == 0;
  if (!snapshot.connected && of_the_device) text += "; trying again (" + drives_.bus_key + ")";
  const auto line = bus_.poll(text, busIsWell(snapshot), now);
  if (line) lines.push_back({line->good ? Level::kInfo : Level::kWarn, line->text});
}

void StateLog::pollStop(const cycle::CycleSnapshot& snapshot, std::vector<LogLine>& lines) {
  const std::string stop = snapshot.base.text.str();
  const std::string incident = incidentIn(stop);
  if (incident == last_stop_) return;
  last_stop_ = incident;
  if (!snapshot.base.stopped) return;
  const bool asked = snapshot.base.stop_cause == drive::StopCause::kQuickStop;
  lines.push_back({asked ? Level::kInfo : Level::kError,
                   "the base is stopped: " + stop + "; to go on: " + recoveryHint(snapshot, drives_.names)});
}

void StateLog::pollFault(const cycle::DriveSnapshot& drive, std::size_t index, Instant now,
                         std::vector<LogLine>& lines) {
  FaultState& state = faults_[index];
  const bool met_now = drive.online && !state.met;
  if (drive.faults != state.seen) {
    state.seen = drive.faults;
    state.due = true;
    state.since = now;
    state.stood = met_now;
  }
  state.met = state.met || drive.online;
  const std::uint16_t number = drive.fault_number != 0 ? drive.fault_number : drive.last_fault_number;
  if (!state.due || (!profile::isFaultNumber(number) && now - state.since < kNumberAwaited)) return;
  state.due = false;
  const std::uint16_t told = profile::isFaultNumber(number) ? number : profile::kFaultNumberUnknown;
  lines.push_back({Level::kError, faultSentence(index, told, rememberedFault(drive, told, drives_.faults[index]))});
}

std::string StateLog::faultSentence(std::size_t index, std::uint16_t number, const std::string& remembered) const {
  const std::string& name = drives_.names[index];
  const catalogue::FaultWords& faults = drives_.faults[index];
  std::string text = "drive " + name + ": " + catalogue::FaultWords::label(number) + ", " + faults.name(number);
  text += remembered;
  if (faults_[index].stood) text += ", which stood before this node started";
  if (!faults.cause(number).empty()) text += "; likely cause: " + faults.cause(number);
  if (!faults.remedy(number).empty()) text += "; remedy: " + faults.remedy(number);
  if (drives_.read_only) return text;
  const std::string call = "rosservice call " + drives_.node + "/";
  const std::string& enabled_as = drives_.enabled_as[index];
  const bool in_base = enabled_as.empty();
  text += "; then acknowledge it: " + call + (in_base ? "acknowledge_faults" : name + "/acknowledge_fault");
  return text + " and enable: " + call + (in_base ? "" : enabled_as + "/") + "enable true";
}

}  // namespace nord_driver::node
