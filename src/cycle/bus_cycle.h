// One bus cycle: newest command in, process data out and back, newest state out.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cycle/axis.h"
#include "cycle/base_motion.h"
#include "cycle/command_watch.h"
#include "cycle/cycle_config.h"
#include "cycle/cycle_ports.h"
#include "cycle/cycle_statistics.h"
#include "cycle/guest_gate.h"
#include "cycle/position_requests.h"
#include "cycle/standstill_requests.h"
#include "cycle/start_acknowledge.h"
#include "cycle/steered_motion.h"
#include "cycle/supervisor.h"
#include "drive/drive.h"
#include "nord_driver/core/time.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::cycle {

enum class CycleRole : std::uint8_t {
  kDriver,
  /// Of a program that only reads and writes parameters: a GuestGate stands before the first word that acts, and the
  /// driver asks for no parameter but its users'. Without those nothing can be enabled.
  kGuest,
  /// Of a node that looks on (`read_only`): every word is 0000, which inverters ignore (BU 2700 6.4.1 note 2), their
  /// answers are shown, parameters are read. What would command or write is refused.
  kOnlooker,
};

/// Owns the drives and runs them over a configured transport. `runOnce` never waits for anybody but the bus, throws
/// nothing and, once every drive has been in data exchange, allocates nothing.
class BusCycle {
 public:
  /// `transport` is configured.
  BusCycle(const CycleConfig& config, Transport& transport, CyclePorts& ports, bool auto_enable,
           CycleRole role = CycleRole::kDriver);

  void runOnce() noexcept;
  Duration period() const noexcept { return period_; }
  bool inBase(DriveIndex drive) const noexcept { return supervisor_.inBase(drive); }
  /// Another drive leads it: it has no command of its own.
  bool isLed(DriveIndex drive) const noexcept { return leaders_[drive].has_value(); }

  // For a program that calls runOnce() itself.
  /// A parameter that decides motion may be written.
  bool isAtRest(DriveIndex drive) noexcept;
  const GuestGate& gate() const noexcept { return gate_; }
  void closeGate(std::size_t awaited = 1, bool reaches_others = true) { gate_.close(awaited, reaches_others); }

 private:
  void takeRequests(Instant now) noexcept;
  void takeRequest(const Request& request, Instant now) noexcept;
  /// What an onlooker must not do; false: it may.
  bool refuseAsOnlooker(const Request& request) noexcept;
  /// A reference run of a drive that steers a base under way; false: it may.
  bool refuseHomeUnderWay(const Request& request) noexcept;
  void selectParameterSet(const Request& request, Instant now) noexcept;
  std::optional<DriveIndex> movingBy(const Request& request, Instant now) noexcept;
  void holdForModule() noexcept;
  void accessParameter(const Request& request, Instant now) noexcept;
  Completion resetOdometry(const Request& request) noexcept;
  Duration rampTime(Instant now) const noexcept;
  void command(Instant now, Duration dt) noexcept;
  void addBase(const BaseConfig& config);
  bool hasBase() const noexcept { return supervisor_.base() != nullptr; }
  void commandBase(Instant now, Duration dt) noexcept;
  void commandSteered(Instant now, Duration dt) noexcept;
  /// What the steered base waits for: into the snapshot, and to the user unless it `passes` soon by itself.
  void tellWaits(const Sentence& waits, bool passes, Instant now) noexcept;
  robot::SteeringAngles steeringAngles() const noexcept;
  /// A wheel of a base that rests for P104 although a velocity is commanded, or is scaled into its wheels' 100 %.
  bool isSaturatedWheel(DriveIndex drive) const noexcept;
  bool wheelsTurn() const noexcept;
  double fastestWheel() const noexcept;
  void publishBase() noexcept;
  void commandSingles(Instant now, Duration dt) noexcept;
  void commandPosition(DriveIndex drive, Instant now) noexcept;
  void chooseElement(DriveIndex drive, std::uint8_t element, Instant now) noexcept;
  void awaitElement(DriveIndex drive, Instant now) noexcept;
  void refuseElement(DriveIndex drive, std::uint8_t element, const Sentence& why, Instant now) noexcept;
  void tellTarget(DriveIndex drive, const AskedPosition& asked, drive::TargetRefusal refusal, Instant now) noexcept;
  void setVelocity(DriveIndex drive, double velocity) noexcept;
  /// This drive, or one that follows it.
  bool isOrFollows(DriveIndex drive, DriveIndex leader) const noexcept {
    return drive == leader || leaders_[drive] == leader;
  }
  /// rad/s: the highest P104 of a drive and those that follow it.
  double minSpeed(DriveIndex drive) const noexcept;
  void shareRest() noexcept;
  /// +1 or -1: the only direction in which these can turn; 0: both.
  double onlyDirection(DriveIndex drive) const noexcept;
  bool comesToRest(DriveIndex drive) const noexcept;
  JointBounds boundsOf(DriveIndex drive, bool stops) const noexcept;
  void addAxis(const DriveSetup& setup, CycleRole role);
  void pollOutputs(Instant now) noexcept;
  void putWords(DriveIndex drive, Instant now) noexcept;
  /// The drive is enabled and does what its velocity command says, which is fresh.
  bool followsCommand(DriveIndex drive, Instant now) noexcept;
  robot::WheelSpeeds maxWheelSpeeds() const noexcept;
  MinimumSpeeds minWheelSpeeds() const noexcept;
  void handleInputs(Instant now) noexcept;
  void acknowledgeAtStart(bool quiet, Instant now) noexcept;
  void runParameters(Instant now) noexcept;
  void submitAllParameters(Instant now) noexcept;
  void submitParameters(DriveIndex drive, Instant now) noexcept;
  void measure(Instant now, Duration dt) noexcept;
  void measureBase(Duration dt) noexcept;
  /// The cycle was held up: the next sample starts anew.
  void forgetSpeeds() noexcept;
  void publish(Instant now) noexcept;
  void tellChanges(Instant now) noexcept;
  void fill(DriveSnapshot& to, DriveIndex drive, Instant now) const noexcept;

  Transport& transport_;
  CyclePorts& ports_;
  CycleRole role_;
  GuestGate gate_;
  Duration period_;
  Duration cmd_vel_timeout_;
  std::vector<std::string> names_;
  std::vector<drive::Drive> drives_;
  std::vector<Axis> axes_;
  std::optional<BaseMotion> base_;  // one of these two, or none
  std::optional<SteeredMotion> steered_;
  std::vector<std::optional<DriveIndex>> leaders_;  // of the drives that follow one
  std::vector<DriveIndex> wheels_;                  // the drives of the base, in the order of its wheel speeds
  std::vector<DriveIndex> steering_;                // and of its steering angles
  std::optional<Instant> waits_since_;
  std::optional<Instant> waits_told_at_;
  StartAcknowledge start_acknowledge_;  // before the supervisor, which asks it
  CommandWatch command_watch_;          // as well
  Supervisor supervisor_;
  StandstillRequests standstill_requests_;
  PositionRequests position_requests_;
  CycleStatistics statistics_;
  std::vector<profile::ProcessOutput> outputs_;
  std::vector<DriveExchange> inputs_;
  CycleSnapshot snapshot_;
  std::optional<Instant> last_command_;
  std::optional<Instant> last_input_;
};

}  // namespace nord_driver::cycle
