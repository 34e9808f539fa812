#include "node/diagnostics.h"

#include <algorithm>

#include "cycle/leaders.h"
#include "node/base_status.h"
#include "node/bus_publisher.h"
#include "node/remembered_fault.h"
#include "nord_driver/core/bytes.h"

namespace nord_driver::node {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

namespace {

// The updater asks for a diagnostic_period in each pass, takes any number and throws at infinity: here nobody sets one.
constexpr const char* kUpdaterParameters = "~diagnostics";

// "checksum_errors" as a line of /diagnostics.
std::string inWords(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

Diagnostics::Diagnostics(const NodeConfig& config, const std::vector<DriveIdentity>& identities,
                         const std::vector<catalogue::DriveCatalogue>& known, std::vector<DriveValues> values,
                         const std::string& where, const IgnoredCommands& ignored)
    : identities_(identities),
      known_(known),
      values_(std::move(values)),
      commissioning_(config, identities, known),
      device_(where),
      ignored_(ignored),
      snapshot_(config.drives.size()),
      updater_(ros::NodeHandle{}, ros::NodeHandle{kUpdaterParameters}),
      period_(seconds(config.publish.diagnostic_period)) {
  updater_.setHardwareID(device_);
  updater_.add("bus", [this](DiagnosticStatusWrapper& status) { reportBus(status); });
  if (config.cycle.base) {
    const bool sideways = config.cycle.base->movesSideways();
    updater_.add("base", [this, sideways](DiagnosticStatusWrapper& status) {
      reportBase(snapshot_, names_, sideways, ignored_.ofBase(), status);
    });
  }
  for (std::size_t i = 0; i < config.cycle.drives.size(); ++i) {
    names_.push_back(config.cycle.drives[i].name);
    series_.push_back(config.cycle.drives[i].series);
    protections_.emplace_back(identities[i], config.cycle.drives[i].series, config.cycle.cmd_vel_timeout,
                              config.cycle.period(), config.read_only);
    ramps_.emplace_back(config.cycle, i);
    updater_.add("drive " + names_.back(), [this, i](DiagnosticStatusWrapper& status) { reportDrive(i, status); });
  }
}

void Diagnostics::update(const cycle::CycleSnapshot& snapshot) {
  snapshot_ = snapshot;
  const Instant now = std::chrono::steady_clock::now();
  if (now < next_update_) return;
  for (const LogLine& line : commissioning_.update(snapshot_)) {
    if (line.level == LogLine::Level::kWarn) {
      ROS_WARN("nord_driver: %s", line.text.c_str());
    } else {
      ROS_INFO("nord_driver: %s", line.text.c_str());
    }
  }
  updater_.force_update();
  next_update_ = now + period_;
}

void Diagnostics::reportBus(DiagnosticStatusWrapper& status) const {
  status.summary(busLevel(snapshot_), busSentence(snapshot_, names_));
  status.add("device", device_);
  status.add("cycle time mean (s)", snapshot_.times.mean);
  status.add("cycle time p99 (s)", snapshot_.times.p99);
  status.add("cycle time max (s)", snapshot_.times.max);
  for (const NamedCounter& counter : snapshot_.counters) status.add(inWords(counter.name), counter.value);
}

void Diagnostics::summarize(std::size_t index, DiagnosticStatusWrapper& status) const {
  const cycle::DriveSnapshot& drive = snapshot_.drives[index];
  if (!drive.online) {
    status.summary(DiagnosticStatus::ERROR, drive.text.empty() ? "no answer" : drive.text.str());
  } else if (drive.fault_number != 0) {
    status.summary(DiagnosticStatus::ERROR, catalogue::FaultWords::label(drive.fault_number) + ": " +
                                                known_[index].faults().name(drive.fault_number));
  } else if (drive.stopped) {
    status.summary(DiagnosticStatus::ERROR, drive.text.str());
  } else {
    status.summary(DiagnosticStatus::OK, drive.text.empty() ? profile::toString(drive.state) : drive.text.str());
  }
}

// What does not stop the drive, but should be seen to.
void Diagnostics::warn(std::size_t index, const ProtectionReport& protection, DiagnosticStatusWrapper& status) const {
  const cycle::DriveSnapshot& drive = snapshot_.drives[index];
  if (drive.online && protection.level != ProtectionReport::Level::kFine) {
    const bool runs_on = protection.level == ProtectionReport::Level::kError;
    status.mergeSummary(runs_on ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN,
                        "if this computer died: " + protection.text);
  }
  if (drive.terminals != cycle::TerminalFinding::kNone) {
    const bool turns = drive.terminals == cycle::TerminalFinding::kTurned;
    status.mergeSummary(turns ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN, drive.terminals_text.str());
  }
  for (const std::string& text : commissioning_.of(index).warnings) status.mergeSummary(DiagnosticStatus::WARN, text);
  const std::string slow_ramp = ramps_[index].assess(drive.device, drive.parameter_set);
  if (drive.online && !slow_ramp.empty()) status.mergeSummary(DiagnosticStatus::WARN, slow_ramp);
  if (drive.not_following) {
    status.mergeSummaryf(DiagnosticStatus::WARN,
                         "it has been %.2f rad/s away from its setpoint for seconds: is the motor overloaded, or are "
                         "the inverter's ramps (P102, P103) longer than those of the commands?",
                         drive.speed_deviation);
  }
  if (!drive.position_refused.empty()) status.mergeSummary(DiagnosticStatus::WARN, drive.position_refused.str());
  if (drive.position_held_back) {
    status.mergeSummary(DiagnosticStatus::WARN, "its newest position cannot be: the one before is told");
  }
  if (drive.direction_contradiction) {
    status.mergeSummaryf(DiagnosticStatus::WARN, "%s and the direction bits of the status word contradict each other",
                         drive.position ? "its speed" : "actual value 1");
  }
  if (drive.owes_eeprom_switch) {
    status.mergeSummary(DiagnosticStatus::WARN,
                        "P560 was set to 0 for a parameter write and could not be put back yet");
  }
}

void Diagnostics::addFault(std::size_t index, DiagnosticStatusWrapper& status) const {
  const cycle::DriveSnapshot& drive = snapshot_.drives[index];
  const catalogue::FaultWords& words = known_[index].faults();
  const std::uint16_t fault = drive.fault_number != 0 ? drive.fault_number : drive.last_fault_number;
  if (fault == 0) return;
  status.add(drive.fault_number != 0 ? "fault" : "last fault",
             catalogue::FaultWords::label(fault) + ": " + words.name(fault) + rememberedFault(drive, fault, words));
  if (!words.cause(fault).empty()) status.add("likely cause", words.cause(fault));
  if (!words.remedy(fault).empty()) status.add("remedy", words.remedy(fault));
}

void Diagnostics::reportDrive(std::size_t index, DiagnosticStatusWrapper& status) const {
  const cycle::DriveSnapshot& drive = snapshot_.drives[index];
  const DriveIdentity& identity = identities_[index];
  const ProtectionReport protection = protections_[index].assess(drive.device);
  status.hardware_id = device_ + ", " + identity.address;
  summarize(index, status);
  warn(index, protection, status);
  addFault(index, status);
  if (drive.switch_on_reason) {
    status.addf("not ready to switch on, P700[-03]", "%u.%u", *drive.switch_on_reason / 10u,
                *drive.switch_on_reason % 10u);
  }
  status.add("fault latched", drive.fault_latched);
  status.add("EEPROM writes by this node", drive.eeprom_writes);
  status.add("address", identity.address);
  status.add("state", profile::toString(drive.state));
  status.add("status word", toHexWord(drive.input.status_word));
  status.add("control word", toHexWord(drive.output.control_word));
  status.add("parameter set", static_cast<int>(drive.parameter_set));
  if (drive.position) {
    status.add("position (rad or m)", *drive.position);
    status.add("target (rad or m)", drive.position_target ? std::to_string(*drive.position_target) : "none");
    status.add("target reached", drive.position_reached);
    status.add("homed", drive.homed);
  }
  status.add("frequency (Hz)", drive.frequency);
  status.add("velocity (rad/s)", drive.velocity);
  status.add("velocity commanded (rad/s)", drive.velocity_command);
  status.add("speed deviation (rad/s)", drive.speed_deviation);
  status.add("at speed", drive.at_speed);
  status.add("commands ignored", ignored_.of(index));
  status.add("bus module answers", drive.module_answers);
  status.add("parameter channel", identity.parameter_channel);
  status.add("protected by", protection.text);
  const Sentence leader = cycle::followsMessage(drive.device, series_[index]);
  if (!leader.empty()) status.add("follows", leader.c_str());
  for (const ParameterValue& value : values_[index].values(drive)) {
    status.add(value.name.empty() ? value.parameter : value.parameter + " " + value.name, value.text);
  }
  for (const std::string& text : commissioning_.of(index).notes) status.add("note", text);
}

}  // namespace nord_driver::node
