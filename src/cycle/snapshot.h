// What the bus cycle tells the rest of the node after every cycle: one copyable picture of everything.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "cycle/cycle_statistics.h"
#include "cycle/device_data.h"
#include "cycle/fault_history.h"
#include "cycle/fault_record.h"
#include "cycle/monitored_value.h"
#include "cycle/terminal_watch.h"
#include "drive/drive_report.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/process_data.h"
#include "nord_driver/transport/transport.h"
#include "profile/status_word.h"
#include "robot/odometry.h"
#include "robot/twist.h"

namespace nord_driver::cycle {

/// The process data of one drive in one cycle.
struct DriveSample {
  Instant time{};       ///< of the cycle
  bool online = false;  ///< fresh process data from the inverter itself
  profile::DriveState state = profile::DriveState::kUnknown;
  std::uint8_t parameter_set = 0;   ///< 0: not known
  profile::ProcessOutput output;    ///< as sent last
  profile::ProcessInput input;      ///< as received last
  std::uint8_t words = 3;           ///< actual values that the bus carries, the first ones of `input`; the others are 0
  double velocity_command = 0.0;    ///< rad/s at the joint
  double velocity = 0.0;            ///< rad/s at the joint
  double frequency = 0.0;           ///< Hz
  bool saturated = false;           ///< the velocity wanted is beyond P105, not zero and below P104, or needs a reverse
  std::uint16_t fault_number = 0;   ///< P700 raw; 0 = none, 65535 = its number is not known (yet)
  std::optional<double> position;   ///< rad or m of the joint, of a drive that positions; none while it is not known
  bool position_reached = false;    ///< it is enabled, and at its target
  bool position_following = false;  ///< it is enabled, and on its way to a target
  bool position_at_limit = false;   ///< it stands at, or beyond, a limit of its joint
  bool homed = false;               ///< its reference is known, as far as that can be told
};

struct DriveSnapshot : DriveSample {
  bool module_answers = false;                            ///< its bus module answers at least
  std::uint8_t module_inputs = 0;                         ///< of that module, DI1 in bit 0
  bool enabled = false;                                   ///< follows velocity commands
  bool stopped = false;                                   ///< stopped by a cause that is latched: `text` names it
  drive::StopCause stop_cause = drive::StopCause::kNone;  ///< that cause
  double speed_deviation = 0.0;  ///< rad/s, velocity minus velocity_command; 0 while not enabled
  bool at_speed = false;         ///< enabled, and the deviation is small
  bool not_following = false;    ///< enabled, and far from its command for seconds
  double joint_position = 0.0;   ///< rad, continuous; of a drive that positions its own, rad or m
  /// joint_position can be told: at once, or of a drive that positions when its position was first known.
  bool joint_known = true;
  std::optional<double> position_target;               ///< rad or m, of a drive that positions, while enabled
  bool position_held_back = false;                     ///< the newest position cannot be, the one before is told
  Sentence position_refused;                           ///< the newest target was refused, and why; empty: it was taken
  std::uint16_t last_fault_number = 0;                 ///< the last one there was, also when it vanished by itself
  std::optional<std::uint16_t> switch_on_reason;       ///< P700[-03] raw, while it keeps the drive from becoming ready
  bool fault_latched = false;                          ///< a fault was seen and not acknowledged since
  bool fault = false;                                  ///< the fault bit as seen last; a silent drive keeps it
  std::uint64_t faults = 0;                            ///< how often it rose, or came back as another one
  DriveSample at_fault;                                ///< then, with its number: the first idle word may end it
  FaultRecord fault_record;                            ///< the cycles up to that moment
  FaultHistory fault_history;                          ///< what the inverter remembers, of that moment
  std::uint64_t eeprom_writes = 0;                     ///< of this node, of 100 000 the EEPROM endures (BU 2700 6.5)
  bool owes_eeprom_switch = false;                     ///< P560 = 0 stands because of this node
  TerminalFinding terminals = TerminalFinding::kNone;  ///< who else has a say in a drive that is disabled here
  Sentence terminals_text;                             ///< that, in words; empty when nobody has
  bool direction_contradiction = false;                ///< the sign of actual value 1 against the direction bits
  Sentence text;                          ///< what it waits for or why it stopped; empty when there is nothing to say
  std::vector<MonitoredValue> monitored;  ///< in the order of DriveSetup::monitor
  DeviceData device;
};

struct BaseSnapshot {
  bool known = false;  ///< every drive of the base has answered at least once
  robot::Pose2d pose;
  robot::Twist2d velocity;  ///< measured
  robot::Twist2d command;   ///< after limiting
  bool enabled = false;
  /// The newest cmd_vel is not zero, and not older than cmd_vel_timeout; never of a node that looks on.
  bool commanded = false;
  bool stopped = false;
  drive::StopCause stop_cause = drive::StopCause::kNone;
  Sentence text;
  Sentence waits;  ///< why it does not drive as it is commanded to, though nothing stops it; of a steered base
};

struct CycleSnapshot {
  CycleSnapshot() = default;
  explicit CycleSnapshot(std::size_t drive_count) : drives(drive_count) {}

  Instant time{};
  bool connected = false;
  bool settled = false;  ///< no drive is enabled, enabling or on its way to rest
  std::vector<DriveSnapshot> drives;
  BaseSnapshot base;
  CycleTimes times;
  BusCounters counters;
  Sentence bus_text;
};

}  // namespace nord_driver::cycle
