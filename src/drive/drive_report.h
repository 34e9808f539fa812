// What one inverter does and did, for everybody outside the cycle: plain values, copied once per cycle.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/units.h"
#include "drive/position_report.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/profile/process_data.h"
#include "profile/status_word.h"

namespace nord_driver::drive {

/// What the driver is doing with the inverter. The comment names what goes on the wire.
enum class Phase : std::uint8_t {
  kOffline,        ///< 0000 (ignored by the inverter) until a status word tells the set; after a loss: see Drive
  kIdle,           ///< 047E with the set in force
  kAcknowledging,  ///< 047E, 04FE for a while, 047E
  kEnabling,       ///< 047E until "ready to switch on", then 047F with setpoint 0 until "operation enabled"
  kEnabled,        ///< 047F and the setpoint
  kHoldingZero,    ///< 047F and setpoint 0: down the inverter's own ramp, torque stays on
  kStopping,       ///< OFF1: 047E until "ready to switch on"
  kQuickStopping,  ///< OFF3: 047B until "switch-on disabled"
  kSwitchingSet,   ///< 047E with another set, until the status word confirms it
  kCoasting,       ///< OFF2: 047D until "switch-on disabled"; the motor is not braked
  kResting,        ///< enabled, P104 > 0 (see Drive) and no velocity wanted: OFF1, 047E and setpoint 0
  kResuming,       ///< enabled, from rest to the velocity wanted: 047F and the setpoint until "operation enabled"
};

/// The user has it enabled: it follows velocity commands.
constexpr bool isEnabled(Phase phase) noexcept {
  return phase == Phase::kEnabled || phase == Phase::kResting || phase == Phase::kResuming;
}

/// Why the drive stopped, or was stopped by the driver, since it was last enabled. The first cause stays.
enum class StopCause : std::uint8_t {
  kNone,
  kFault,            ///< the fault bit
  kUnaskedExit,      ///< "operation enabled" left without being asked, and bits 4 and 5 do not say why
  kOff2,             ///< the same with status bit 4 = 0: OFF2 (coasting) at terminals
  kOff3,             ///< the same with status bit 5 = 0: OFF3 (quick stop, emergency stop) at terminals
  kLocalControl,     ///< status bit 9 = 0: terminals have taken over
  kSilent,           ///< no fresh status word for drive_timeout
  kInterrupted,      ///< its connection to the bus was reset or left operation: by others, or by itself
  kContested,        ///< another master commands it, too
  kParameterSet,     ///< another parameter set came into force without being asked for
  kQuickStop,        ///< the user's quick stop
  kShutdownTimeout,  ///< OFF1 did not end in shutdown_timeout: quick stop
  kCoast,            ///< OFF2 was asked for
  kCommandTimeout,   ///< no new velocity command came in time
  kPositionJump,     ///< its position changed faster than the motor can turn: the count has a new zero
  kHomingTimeout,    ///< a reference run did not end in time
  kStrayed,          ///< it goes by the elements of its array, and left the way to the one it was told
  kUnsuitable,       ///< a parameter that was read late keeps it from being enabled
  kNotResumed,       ///< from rest (P104 > 0) it did not reach "operation enabled" within enable_timeout
};

/// Why a request was not carried out.
enum class Refusal : std::uint8_t {
  kNone,
  kOffline,
  kFault,         ///< the fault bit is set, now
  kFaultLatched,  ///< a fault was seen and not acknowledged since, though its bit is gone
  kLocalControl,
  kStopping,             ///< OFF1 or a quick stop has not ended yet
  kBusy,                 ///< a fault is being acknowledged, or the parameter set switched
  kWrongState,           ///< from this state no enabling starts
  kParameterSet,         ///< the set in force is not the one commanded
  kMaxFrequencyUnknown,  ///< P105 of the set in force: nobody could say what a setpoint means
  kParametersAwaited,    ///< P104, P543, P546 and P600 are being read: what they are is not known yet
  kMinimumFrequency,     ///< P104 of the set in force is > 0, and nobody has accepted that
  kUnexpectedFunction,   ///< setpoint 1 or actual value 1 of the set in force is no frequency, or P600 does not fit
  kUnexpectedSource,     ///< it follows another inverter, or does not where it should (P509, P510)
  kEnableTimeout,        ///< the inverter did not follow within enable_timeout
  kStopped,              ///< enabling: a stop came before the inverter had followed
  kRequestStopped,       ///< acknowledging, or switching the set: a quick stop or OFF2 was asked for meanwhile
  kCauseStands,          ///< acknowledging: the fault is still there
  kNotDisabled,          ///< switching the set: the drive is enabled or being stopped
  kTurning,              ///< switching the set: actual value 1 is not near zero
  kNoSuchSet,            ///< the parameter sets are 1..4
  kOnlySet1,             ///< the profile it is commanded by has no bits for parameter sets
  kPositionUnknown,      ///< of a drive that positions: not told yet, or no word carries it
  kPositionBeyondRange,  ///< where it is, its setpoint cannot express: it could not be held there
  kNotEnabled,           ///< a reference run: the drive is not enabled
  kHomingTurning,        ///< a reference run: the motor turns
  kHomingTimeout,        ///< a reference run did not end within position/homing_timeout
  kHomingStopped,        ///< a reference run: the drive was stopped, or stopped by itself
  kTeachNotDisabled,     ///< teaching or resetting a position: the drive is enabled or being stopped
  kTeachTurning,         ///< teaching or resetting a position: the motor turns
  kTeachStopped,         ///< something else was asked of the drive while its position was taught
  kTeachTimeout,         ///< teaching a position: the drive did not answer often enough
  kResetStopped,         ///< something else was asked of the drive while its position was reset
  kResetTimeout,         ///< resetting the position: it did not become what it is to be
  kSetNotConfirmed,      ///< status bits 14 and 15 did not show the new set within enable_timeout
};

/// How far a request is that takes its time.
enum class RequestState : std::uint8_t { kNone, kRunning, kDone, kRefused };

struct RequestReport {
  std::uint32_t token = 0;  ///< of the request this is about: as its asker gave it
  RequestState state = RequestState::kNone;
  Refusal refusal = Refusal::kNone;  ///< with kRefused
};

/// A parameter P543 to P548 that gives a word another function than is needed: of setpoint 1 or actual value 1 the
/// frequency, of the others what is configured.
struct UnexpectedFunction {
  std::uint16_t number = 0;      ///< 543 to 548; 600 or 610: it does not position, or not by the bus, or is not to
  bool is_array = false;         ///< the series has it as an array
  std::uint16_t found = 0;       ///< the value read; FFFFh: it could not be read
  std::uint16_t expected = 0;    ///< the value to be set
  std::uint8_t index = 1;        ///< of the array
  const char* wanted = nullptr;  ///< the name of the function that no word carries; nullptr: word 1 is no frequency
  bool surplus = false;          ///< nothing is missing: what stands there must not, beside another word, or in P600
};

/// Control word or setpoint do not come from where the configuration says: from another inverter that leads by broadcast,
/// or the setpoint from neither a leader nor this bus.
struct UnexpectedSource {
  std::uint16_t number = 0;    ///< 509 or 510
  bool is_array = false;       ///< the series has it as an array, of which [-01] counts
  std::int32_t found = 0;      ///< the value read
  bool should_follow = false;  ///< true: it is configured as a follower, and hears this bus
  bool elsewhere = false;  ///< true: no broadcast; the setpoint comes from terminals, fixed frequencies or another bus
};

struct DriveReport {
  Phase phase = Phase::kOffline;
  bool online = false;                                        ///< a useful status word within drive_timeout
  profile::DriveState state = profile::DriveState::kUnknown;  ///< kUnknown while offline
  Word status_word = 0;                                       ///< the last useful one
  profile::ProcessInput input;                                ///< the last useful one
  profile::ProcessOutput output;                              ///< as sent last
  std::uint8_t parameter_set = 0;                             ///< in force, from the status word, 1..4; 0: not known
  std::uint8_t commanded_set = 0;                             ///< in the control word, 1..4; 0: not learned yet

  /// What stands for the output frequency, 16384 = P105: actual value 1; of a drive that positions the word that is the
  /// frequency, or what its position makes of it.
  std::int16_t speed = 0;
  /// `frequency` and `velocity` can be told: online, and P105 of the set was known before the newest word came.
  bool scaled = false;
  Hertz frequency;               ///< from actual value 1
  RadPerSec velocity;            ///< of the joint, from `speed`; m/s of a prismatic one
  RadPerSec velocity_command;    ///< of the joint, what setpoint 1 as sent stands for; m/s of a prismatic one
  bool saturated = false;        ///< the wanted velocity is beyond P105, below P104 and not zero, or needs a reverse
  bool command_invalid = false;  ///< the wanted velocity was not a number: setpoint 0 was sent
  bool direction_contradiction = false;  ///< the sign of actual value 1 against status bits 11 and 12

  bool fault_latched = false;  ///< a fault was seen and not acknowledged since
  StopCause stop_cause = StopCause::kNone;
  Word stop_status_word = 0;  ///< the last status word at that moment

  Refusal refusal = Refusal::kNone;  ///< of the last request

  Hertz minimum_frequency;                                ///< P104 of the commanded set; 0 where it is not known
  std::optional<UnexpectedFunction> unexpected_function;  ///< of the commanded set
  std::optional<UnexpectedSource> unexpected_source;

  std::optional<std::uint16_t> switch_on_reason;  ///< P700 [-03] raw: the inverter's own reason of not becoming ready

  RequestReport acknowledge;  ///< the last acknowledging; kCauseStands while the fault cannot be acknowledged
  RequestReport set_switch;   ///< the last switching of the parameter set

  PositionReport position;  ///< of a drive that positions
  RequestReport homing;     ///< its last reference run
  RequestReport teaching;   ///< its last teaching of a position
  RequestReport resetting;  ///< its last reset of the position
};

/// A clause: "a fault", "the drive fell silent".
const char* toString(StopCause cause) noexcept;
/// A clause: "the drive does not answer".
const char* toString(Refusal refusal) noexcept;

}  // namespace nord_driver::drive
