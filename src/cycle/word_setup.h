// What users command and read in the process data beside the velocity, as configured: further setpoints and signals.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cycle/signal_setup.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/process_data.h"
#include "nord_driver/profile/series.h"
#include "nord_driver/transport/bus_report.h"
#include "profile/word_function.h"

namespace nord_driver::cycle {

/// Setpoint 1 is the velocity.
constexpr std::size_t kMaxExtraSetpoints = profile::kMaxProcessValues - 1;

/// A further setpoint that users command. Values are in its unit: Hz of a frequency, % of all others.
struct SetpointSetup {
  std::string name;
  profile::WordUse use = profile::WordUse::kTorqueLimit;
  /// What 16384 stands for; none: P105 of the parameter set in force.
  std::optional<double> nominal;
  std::optional<double> limit;    ///< none: 100 %
  std::optional<double> neutral;  ///< sent before the first command and after the time-out; none: `limit`
  Duration timeout{};             ///< 0: never
  bool moves = false;             ///< it can turn the motor: a command, as a velocity is one
  bool is_signed = false;         ///< from -limit, otherwise from 0
};

struct WordSetup {
  std::vector<SetpointSetup> setpoints;
  std::vector<SignalSetup> signals;
  std::optional<double> torque_at_limit;  ///< Nm of the motor that 100 % torque current, P112, stands for: for `effort`
  Duration release_after{};               ///< outputs that do not hold go off: cmd_vel_timeout; 0: never

  bool empty() const noexcept { return setpoints.empty() && signals.empty() && !torque_at_limit; }
};

/// "torque_limit", as configurations write it; "" for one that is none.
const char* setpointWord(profile::WordUse use) noexcept;

/// `cmd_vel_timeout` 0: never. Throws ConfigError.
WordSetup readWordSetup(const Settings& drive, profile::Series series, Duration cmd_vel_timeout);

/// Throws ConfigError where the bus does not carry enough words for what is configured.
void checkWordsCarried(const Settings& drive, const WordSetup& setup, const DriveIdentity& identity);

}  // namespace nord_driver::cycle
