#include "cycle/drive_snapshot.h"

#include <optional>

#include "cycle/user_messages.h"
#include "profile/fault_number.h"

namespace nord_driver::cycle {

namespace {

Sentence sentenceOf(const DrivePictured& from, const Transport& transport) noexcept {
  const drive::DriveReport& report = from.report;
  if (!report.online) return transport.note(from.index).text;
  const Sentence stop = stopMessage(from.name, report.stop_cause, report);
  // Its bit may have vanished with our first idle word (BU 0020 8); enabling is refused for it all the same.
  if (!stop.empty() || !report.fault_latched) return stop;
  return refusalMessage(from.name, drive::Refusal::kFaultLatched, report);
}

void fillSample(DriveSample& to, const DrivePictured& from, Instant now) noexcept {
  const drive::DriveReport& report = from.report;
  to.time = now;
  to.online = report.online;
  to.state = report.state;
  to.parameter_set = report.parameter_set;
  to.output = from.sent;
  to.input = report.input;
  to.velocity_command = report.velocity_command.value;
  to.velocity = report.velocity.value;
  to.frequency = report.frequency.value;
  to.saturated = report.saturated || (drive::isEnabled(report.phase) && from.beyond_its_speed);
  to.fault_number = from.axis.parameters.faults().number();
  to.position = report.position.position;
  // One that was enabled in this cycle may have been taken back since: another drive refuses.
  to.position_reached = report.position.reached && drive::isEnabled(report.phase);
  to.position_following = report.position.following && drive::isEnabled(report.phase);
  to.position_at_limit = report.position.at_limit;
  to.homed = report.position.homed;
}

// It keeps its last position while it is silent.
void fillPosition(DriveSnapshot& to, const DrivePictured& from) noexcept {
  const drive::PositionReport& position = from.report.position;
  if (position.position) to.joint_position = *position.position;
  to.joint_known = to.joint_known || position.position.has_value();
  to.position_target = drive::isEnabled(from.report.phase) ? position.target : std::nullopt;
  to.position_held_back = position.held_back;
  to.position_refused = from.axis.targets.refused();
}

// One that was lost may come back with another fault: nobody has seen the bit fall, and its number alone tells.
void fillFault(DriveSnapshot& to, const Axis& axis) noexcept {
  to.fault_history = axis.parameters.faultHistory();
  if (!to.online) return;
  const bool fault = profile::StatusWord{to.input.status_word}.fault();
  const bool known = profile::isFaultNumber(to.fault_number);
  const bool another =
      known && profile::isFaultNumber(to.at_fault.fault_number) && to.fault_number != to.at_fault.fault_number;
  if (fault && (!to.fault || another)) {
    ++to.faults;
    to.at_fault = to;
    axis.recorder.write(to.fault_record);
  }
  if (fault && known) to.at_fault.fault_number = to.fault_number;
  to.fault = fault;
}

}  // namespace

void fillDriveSnapshot(DriveSnapshot& to, const DrivePictured& from, const Transport& transport, Instant now) noexcept {
  const drive::DriveReport& report = from.report;
  const Axis& axis = from.axis;
  fillSample(to, from, now);
  to.module_answers = from.module_answers;
  to.enabled = drive::isEnabled(report.phase);
  to.stopped = report.stop_cause != drive::StopCause::kNone || report.fault_latched;
  to.stop_cause = report.stop_cause;
  to.speed_deviation = axis.speed.deviation();
  to.at_speed = axis.speed.atSpeed();
  to.not_following = axis.speed.isNotFollowing();
  if (from.positions) {
    fillPosition(to, from);
  } else {
    to.joint_position = axis.joint.position();
  }
  to.last_fault_number = axis.parameters.faults().lastNumber();
  to.switch_on_reason = report.switch_on_reason;
  to.fault_latched = report.fault_latched;
  to.eeprom_writes = axis.parameters.eepromWrites();
  to.owes_eeprom_switch = axis.parameters.owesEepromSwitch();
  to.terminals = axis.terminals.finding();
  to.terminals_text = terminalMessage(from.name, to.terminals, report);
  to.direction_contradiction = report.direction_contradiction;
  to.text = sentenceOf(from, transport);
  fillFault(to, axis);
  to.monitored = axis.parameters.monitored();
  to.device = axis.parameters.device();
  to.device.ident = transport.identNumber(from.index);
}

}  // namespace nord_driver::cycle
