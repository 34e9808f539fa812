// A scenario of the campaign with real processes as data: what happens to driver, drives and users, and when.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nord_driver::test {

enum class ProcessAct {
  // Users.
  kDrive,        ///< cmd_vel: amount and extra are % of the fastest, along and around
  kSilence,      ///< no cmd_vel any more
  kEnable,       ///< ~enable true
  kDisable,      ///< ~enable false
  kQuickStop,    ///< ~quick_stop
  kAcknowledge,  ///< ~acknowledge_faults
  // The driver.
  kHold,  ///< SIGSTOP: the host stands still
  kKill,  ///< SIGKILL; roslaunch begins it anew `span` later
  kEnd,   ///< SIGTERM, likewise
  // A drive.
  kUnplug,        ///< module and mains off
  kPowerOff,      ///< the mains of the inverter
  kLinkCut,       ///< between module and inverter
  kMute,          ///< its answers are lost
  kLocalControl,  ///< the terminals control, and do not enable
  kTrip,          ///< amount: P700 raw; its cause stands for `span`, or not at all
  kCoast,         ///< a terminal says OFF2
  kLateAnswers,   ///< amount: ms
  kSilentParameters,
};

struct ProcessEvent {
  double at = 0.0;    ///< s after the start
  double span = 0.0;  ///< s that it lasts
  ProcessAct act = ProcessAct::kDrive;
  bool left = true;  ///< of the two drives
  int amount = 0;
  int extra = 0;
};

struct ProcessScenario {
  std::uint32_t seed = 0;
  double length = 0.0;               ///< s; then every cause ends
  std::vector<ProcessEvent> events;  ///< in the order of time; nothing overlaps with another thing at the same place
};

/// The same for the same seed. It begins with a base that is enabled and drives; `scale` stretches its times.
ProcessScenario makeProcessScenario(std::uint32_t seed, double scale = 1.0);
const char* toString(ProcessAct act) noexcept;
/// "0.40+0.75 unplug left 0 0", in s.
std::string toText(const ProcessEvent& event);
std::string toText(const ProcessScenario& scenario);

}  // namespace nord_driver::test
