#include "node/drive_status.h"

#include <algorithm>
#include <limits>

namespace nord_driver::node {

void fillDriveStatus(const cycle::DriveSample& sample, const catalogue::FaultWords& faults, DriveStatus& status) {
  // Who reads a bit or a value without looking at `online` must not take the last moment of a drive for its state.
  const profile::StatusWord word{sample.online ? sample.input.status_word : Word{0}};
  status.online = sample.online;
  status.state = static_cast<std::uint8_t>(sample.online ? sample.state : profile::DriveState::kUnknown);
  status.state_text = profile::toString(sample.online ? sample.state : profile::DriveState::kUnknown);
  status.status_word = sample.input.status_word;
  status.control_word = sample.output.control_word;
  status.ready_to_switch_on = word.readyToSwitchOn();
  status.switched_on = word.switchedOn();
  status.operation_enabled = word.operationEnabled();
  status.fault = word.fault();
  status.voltage_enabled = word.voltageEnabled();
  status.quick_stop_inactive = word.quickStopInactive();
  status.switch_on_disabled = word.switchOnDisabled();
  status.warning = word.warning();
  status.setpoint_reached = word.setpointReached();
  status.bus_control = word.busControl();
  status.bit_10 = word.bit10();
  status.direction_right = word.directionRight();
  status.direction_left = word.directionLeft();
  status.bit_13 = word.bit13();
  status.parameter_set = sample.parameter_set;
  status.setpoints.assign(sample.output.setpoints.begin(), sample.output.setpoints.end());
  status.actual_values.assign(sample.input.actual_values.size(), 0);
  if (sample.online) {
    std::copy(sample.input.actual_values.begin(), sample.input.actual_values.end(), status.actual_values.begin());
  }
  status.velocity_command = sample.velocity_command;
  status.velocity = sample.velocity;
  status.frequency = sample.frequency;
  status.saturated = sample.saturated;
  status.position = sample.position.value_or(std::numeric_limits<double>::quiet_NaN());
  status.position_reached = sample.position_reached;
  status.position_following = sample.position_following;
  status.position_at_limit = sample.position_at_limit;
  status.homed = sample.homed;
  status.fault_number = sample.fault_number;
  status.fault_text.clear();
  if (sample.fault_number != 0) status.fault_text = faults.name(sample.fault_number);
}

bool hidesAFault(const cycle::DriveSnapshot& drive, std::uint64_t told) noexcept {
  return drive.faults != told && !(drive.fault && drive.online);
}

}  // namespace nord_driver::node
