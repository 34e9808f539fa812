// One inverter as the user sees it: decides, each cycle, the control word and the setpoints.
//
// Sans-IO and without a clock. Its rules, in one place:
//  - Stop is the default, and the word that stops is 047E with the parameter set in force. Zeros stop nothing: with
//    bit 10 = 0 the inverter carries on (BU 2700 6.4.1 note 2, 7.1.1).
//  - 047E alone also says "parameter set 1". So 0000, which the inverter ignores, is sent until a status word has told
//    the set in force; from then on never again while it is online.
//  - An inverter that falls silent while it was not at rest may still hear us: the stop word is sent on unanswered, for
//    shutdown_timeout, and once at least; then the set is learned anew. When it answers it is idle, in the set it then
//    reports.
//  - One that is off behind a bus module that lives gets the idle word with the last set known of it: the module's P151
//    runs out when all its control words are invalid (BU 0220 4.2.3.2). Never known: 0000, which does not start P151.
//  - Whatever ends "operation enabled" without being asked ends in the idle word and stays so until the next enable.
//  - OFF1, asked for or in the idle word, that has not ended "operation enabled" after shutdown_timeout becomes OFF3.
//  - The set is switched at standstill only: setpoint 1 is a share of P105 of the set in force (BU 0020 7.3.5).
//  - With P104 > 0 the motor turns at setpoint 0. Such a drive is enabled only where the configuration accepts it; then
//    a command of zero is OFF1 (kResting), and the next one that is not zero leads up again through "ready to switch
//    on". With it do those that it leads or follows: they may hear one control word.
//  - A drive that positions (`position`) goes to a target instead of following a velocity: see PositionAxis. Setpoint 1,
//    where it is the frequency, is then the speed it travels at. Its way to rest is OFF1 from the first word on, for a
//    setpoint of zero would not stop it where the drive travels at P105.
//  - While a position is taught or reset it stays disabled: with teach-in a drive follows frequencies.
//  - Under local control the set follows the inverter: its terminals choose it, and our word acts when control returns.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/units.h"
#include "drive/acknowledge_edge.h"
#include "drive/drive_report.h"
#include "drive/missing_inverter.h"
#include "drive/position_axis.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/process_data.h"
#include "profile/control_word.h"
#include "profile/scaling.h"

namespace nord_driver::drive {

struct DriveConfig {
  profile::JointScaling joint;
  /// P105 of sets 1..4 where typed in; others come by setMaxFrequency().
  std::array<std::optional<Hertz>, 4> max_frequency;
  Duration drive_timeout = seconds(0.05);     ///< silence that counts as offline
  Duration enable_timeout = seconds(2.0);     ///< from the request to "operation enabled", or to the new parameter set
  Duration setup_timeout = seconds(2.0);      ///< of teaching a position, and of a reset; at least 8 answers
  Duration shutdown_timeout = seconds(10.0);  ///< OFF1 until "ready to switch on", then quick stop
  /// How long the acknowledge bit is held low and then high at least: what comes behind the bus, where answers do not tell
  /// it (the module's own cycle adds 5 ms, P153).
  Duration acknowledge_time = seconds(0.1);
  /// |actual value 1| that counts as standstill for switching the parameter set, of 16384.
  std::int16_t near_standstill = 164;
  /// How many parameter sets can be commanded: 4, or 1.
  std::uint8_t parameter_sets = 4;
  /// False: its profile has no OFF2 and OFF3. An ordinary stop stands in their place, and ends as one.
  bool has_quick_stop = true;
  /// False: its profile has no rotation to the left, a negative setpoint is 0: with P104 > 0 OFF1.
  bool reverses = true;
  /// P104 > 0 is no reason to refuse enabling.
  bool allow_minimum_frequency = false;
  /// Cross-check the sign of actual value 1 with status bits 11 and 12. No manual defines that sign in left rotation.
  bool check_direction = true;
  /// Another one commands it, and nothing we say reaches it: it is not stopped, and has the fault that it tells.
  bool onlooker = false;
  /// Its setpoint comes from another inverter: ours stops nothing.
  bool led = false;
  /// It goes to positions; none: it follows velocities.
  std::optional<PositionConfig> position = {};
};

/// Each cycle: pollOutput() before the exchange, handleInput() after it. Requests in between, from the same thread; the
/// answer to a request stands in report(): the phase, or the refusal.
class Drive {
 public:
  explicit Drive(const DriveConfig& config);

  /// `fresh`: the inverter answered in this cycle. An all-zero status word counts as no answer.
  void handleInput(const profile::ProcessInput& input, bool fresh, Instant now) noexcept;
  /// Before handleInput() of a cycle in which the connection to this inverter ended: what it heard last is not known.
  /// As after silence, but without drive_timeout, and also when the inverter answers again in this cycle. `cause`:
  /// kInterrupted, kSilent where the bus has found it silent, or kContested.
  void handleInterruption(StopCause cause, Instant now) noexcept;
  /// Before handleInput(). `inverter_missing`: its bus module took part in this cycle, and says that the inverter
  /// behind it does not.
  void handleModule(bool inverter_missing, Instant now) noexcept;
  profile::ProcessOutput pollOutput(Instant now) noexcept;

  /// Why requestEnable() would refuse now.
  Refusal enableRefusal() const noexcept;
  /// Refused while OFF1 or a quick stop runs: ask again when it has ended.
  void requestEnable(Instant now) noexcept;
  /// Enabled: setpoint 0 with 047F from here on, whatever setVelocity() says. Enabling, of a drive that positions, and
  /// of one that is led: as requestShutdown().
  void requestSetpointZero(Instant now) noexcept;
  /// These three latch `cause`; kNone: nothing, for a stop that needs no explanation.
  void requestShutdown(Instant now, StopCause cause = StopCause::kNone) noexcept;
  /// From every phase; offline it is what is sent on unanswered, and goes on when the drive answers again and turns.
  void requestQuickStop(Instant now, StopCause cause = StopCause::kQuickStop) noexcept;
  /// OFF2: the output goes off at once and the motor coasts, without any braking. From every phase; nothing but
  /// "switch-on disabled" (or a fault) ends it, a quick stop neither.
  void requestCoast(Instant now, StopCause cause = StopCause::kCoast) noexcept;
  /// Takes the latch away when no fault bit is set, else gives the inverter one acknowledge edge; only faults whose
  /// cause is gone follow it (BU 2700 6.4.1 bit 7). Refused outside kIdle. report().acknowledge tells the outcome, with
  /// the `token`; while an acknowledging runs, another is not begun and the report stays with the first.
  void requestAcknowledge(Instant now, std::uint32_t token = 0) noexcept;
  /// Commands set 1..4 from kIdle at standstill. report().set_switch is done when the status word shows the set;
  /// without that, after enable_timeout, the set in force is commanded again. While one runs, another is refused and
  /// the report stays with the first.
  void requestParameterSet(std::uint8_t set, Instant now, std::uint32_t token = 0) noexcept;

  /// Used only while enabled, and forgotten with it. What is no number becomes setpoint 0.
  void setVelocity(RadPerSec joint) noexcept;
  /// Of a drive that positions: go there, rad or m of the joint. Taken only while enabled, and forgotten with it; what
  /// is refused changes nothing, and stands in report().position.
  TargetRefusal setPosition(double joint) noexcept;
  /// Onward from its present target: rad or m.
  TargetRefusal movePosition(double increment) noexcept;
  /// Go where an element of its array is: `joint`, rad or m. By its number (PositionConfig::by_element), which then
  /// stands in report().position.element, or as any target.
  TargetRefusal setElement(std::uint8_t element, double joint) noexcept;
  /// A reference run of a drive that positions, from "enabled"; report().homing tells the outcome, with the `token`. The
  /// drive is asked for it while report().position.homing. It ends in a stop after PositionConfig::homing_timeout.
  void requestHoming(Instant now, std::uint32_t token = 0) noexcept;
  /// The drive that positions takes its position into its array, from "idle" at standstill; report().teaching tells the
  /// outcome, with the `token`. It is not enabled meanwhile, and whatever else is asked of it ends it. What is to be high
  /// stands in report().position.teach.
  void requestTeaching(Instant now, std::uint32_t token = 0) noexcept;
  /// The drive that positions sets its count anew where it stands, from "idle" at standstill; report().resetting tells the
  /// outcome, with the `token`. As teaching otherwise: the bit is report().position.reset.
  void requestPositionReset(Instant now, std::uint32_t token = 0) noexcept;
  /// Whether a bit of the drive says that its reference is known; none: there is no such bit.
  void setReferenced(std::optional<bool> referenced) noexcept;
  bool positions() const noexcept { return axis_.has_value(); }
  /// What the words of set 1..4 carry, as the inverter told their functions.
  void setPositionWords(std::uint8_t set, const profile::PositionWords& words) noexcept;
  /// P105 of set 1..4, as read from the inverter.
  void setMaxFrequency(std::uint8_t set, Hertz frequency) noexcept;
  std::optional<Hertz> maxFrequency(std::uint8_t set) const noexcept;
  /// P104 of set 1..4, as read from the inverter; 0 or no number: nothing to heed, or not known.
  void setMinimumFrequency(std::uint8_t set, Hertz frequency) noexcept;
  /// What P543 to P548, P600 or P610 of set 1..4 should not be; none when all are as expected or not known.
  void setUnexpectedFunction(std::uint8_t set, const std::optional<UnexpectedFunction>& function) noexcept;
  /// What P509 or P510 should not be; none when both are as expected or not known.
  void setUnexpectedSource(const std::optional<UnexpectedSource>& source) noexcept {
    report_.unexpected_source = source;
  }
  /// P104, P105, P509, P510, P543, P546 and P600 have not been asked for yet: it is not enabled before.
  void setParametersAwaited(bool awaited) noexcept { parameters_awaited_ = awaited; }
  /// P700 [-03], why the inverter does not become ready to switch on, as read from it; none when it gives no reason.
  void setSwitchOnReason(std::optional<std::uint16_t> reason) noexcept { report_.switch_on_reason = reason; }
  /// The joint speed 100 % stands for in the commanded set; beyond it one drive alone would saturate, and a base bend
  /// its path.
  std::optional<RadPerSec> maxVelocity() const noexcept;
  /// The joint speed P104 of the commanded set stands for: below it the motor turns at it all the same. 0: none known.
  RadPerSec minVelocity() const noexcept;
  /// +1 or -1: the only direction of the joint in which it can turn; 0: it turns in both.
  double onlyDirection() const noexcept;
  /// True: a velocity of 0 is OFF1 although its own P104 may be 0, because that of one which it leads or follows is not.
  void setRestsWithOthers(bool rests) noexcept { rests_with_others_ = rests; }
  /// On the way to rest by OFF1, for P104 > 0: a velocity would not be followed yet.
  bool comesToRest() const noexcept { return report_.phase == Phase::kResting && !phase_.ready_seen; }

  const DriveReport& report() const noexcept { return report_; }
  /// Nothing is being driven or stopped: idle (or offline), and the inverter confirms it by its state.
  bool isAtRest() const noexcept;
  /// It was lost while it turned, or a stop was asked for since: what stops it is sent on without an answer, at most for
  /// shutdown_timeout.
  bool stopsUnheard(Instant now) const noexcept { return report_.phase == Phase::kOffline && now < unanswered_.until; }
  /// When the newest useful status word came.
  Instant lastHeard() const noexcept { return last_useful_; }
  /// Online, and actual value 1 is near zero: what a motor without voltage does, nobody can tell by it.
  bool isNearStandstill() const noexcept;

 private:
  /// What is known of one parameter set of the inverter.
  struct ParameterSet {
    std::optional<Hertz> max_frequency;  // P105
    Hertz min_frequency;                 // P104; 0: nothing to heed, or not known
    std::optional<UnexpectedFunction> unexpected_function;
  };
  /// What begins anew with every phase.
  struct PhaseData {
    Instant since{};
    bool sent = false;        // its word went out at least once
    bool ready_seen = false;  // enabling, resting: "ready to switch on" was seen after the request
    RadPerSec wanted{};       // enabled: the velocity
  };
  /// Offline: the word that stops goes on without an answer, once at least.
  struct UnansweredWord {
    profile::Command command = profile::Command::kIgnored;
    bool due = false;  // it has not gone out yet
    Instant until{};
  };

  void handleUseful(const profile::ProcessInput& input, Instant now) noexcept;
  void handleSilence(Instant now) noexcept;
  void goOffline(StopCause cause, Instant now) noexcept;
  void learnSet(profile::StatusWord status, bool joined) noexcept;
  Phase phaseOnReturn(Instant now) const noexcept;
  /// Why its parameters, as far as they are known, keep it from being enabled.
  Refusal parameterRefusal() const noexcept;
  void checkStops(profile::StatusWord status, Instant now) noexcept;
  void follow(profile::StatusWord status, Instant now) noexcept;
  void followIdle(profile::StatusWord status, Instant now) noexcept;
  void followResting(profile::StatusWord status, Instant now) noexcept;
  void followResuming(profile::StatusWord status, Instant now) noexcept;
  void followEnabling(profile::StatusWord status, Instant now) noexcept;
  void followStopping(profile::DriveState state, Instant now) noexcept;
  /// A ramp that has not ended within shutdown_timeout ends in a quick stop.
  void boundRamp(Instant now) noexcept;
  void followOff2OrOff3(profile::DriveState state, Instant now) noexcept;
  void followAcknowledging(profile::StatusWord status, Instant now) noexcept;
  void followSwitchingSet(profile::StatusWord status, Instant now) noexcept;
  Refusal setRefusal(std::uint8_t set) const noexcept;
  void breakOff(Refusal why) noexcept;
  static void end(RequestReport& request, Refusal refusal) noexcept;
  void measure(bool fresh) noexcept;
  void measurePosition() noexcept;
  void handlePosition(Instant now) noexcept;
  void followHoming(Instant now) noexcept;
  /// A position is taught, or reset.
  bool isSettingUp() const noexcept { return axis_ && axis_->isSettingUp(); }
  Refusal setupRefusal() const noexcept;
  void followSetup(Instant now) noexcept;
  /// `taught`, `reset`: why it ends, of the one that runs.
  void endSetup(Refusal taught, Refusal reset) noexcept;
  void putPosition(profile::ProcessOutput& output, Instant now) noexcept;
  /// Of a drive that positions, why its position keeps it from being enabled.
  Refusal positionRefusal() const noexcept;
  /// What stands for the frequency, of 16384: actual value 1, or of a drive that positions what its words say.
  std::int16_t speedWord() const noexcept;
  void tellSet() noexcept;
  /// Between resting and driving, by the velocity wanted.
  void restOrResume(const profile::Setpoint& setpoint, Instant now) noexcept;
  bool restsAtZero() const noexcept { return !axis_ && (rests_with_others_ || report_.minimum_frequency.value > 0.0); }
  void enter(Phase phase, Instant now, RadPerSec wanted = {}) noexcept;
  void stop(StopCause cause, Instant now) noexcept;
  void latch(StopCause cause) noexcept;
  void refuse(Refusal refusal) noexcept;
  profile::Command command(Instant now) const noexcept;
  bool isRunning() const noexcept;  // 047F may be on the wire, or come by itself
  /// `set`: 1..4, else nullptr.
  ParameterSet* parameterSet(std::uint8_t set) noexcept;
  const ParameterSet* parameterSet(std::uint8_t set) const noexcept;

  DriveConfig config_;
  std::array<ParameterSet, 4> sets_{};
  bool parameters_awaited_ = false;
  bool rests_with_others_ = false;
  DriveReport report_;
  PhaseData phase_;  // of report_.phase
  UnansweredWord unanswered_;
  AcknowledgeEdge edge_;
  MissingInverter missing_;
  std::optional<PositionAxis> axis_;
  Instant last_useful_{};
};

}  // namespace nord_driver::drive
