#include "cycle/bus_cycle.h"

#include <algorithm>
#include <cmath>

#include "cycle/drive_snapshot.h"
#include "cycle/leaders.h"
#include "cycle/make_drives.h"
#include "cycle/user_messages.h"
#include "profile/status_word.h"

namespace nord_driver::cycle {

namespace {

constexpr Duration kLongestRampStep = std::chrono::milliseconds{100};
// What was measured before it and after it says nothing of the way between.
constexpr Duration kHoldUp = std::chrono::milliseconds{500};

std::vector<std::string> namesOf(const CycleConfig& config) {
  std::vector<std::string> names;
  for (const DriveSetup& setup : config.drives) names.push_back(setup.name);
  return names;
}

std::vector<std::optional<std::size_t>> modulesOf(const CycleConfig& config, const Transport& transport) {
  std::vector<std::optional<std::size_t>> modules;
  for (DriveIndex i = 0; i < config.drives.size(); ++i) modules.push_back(transport.identity(i).shared_module);
  return modules;
}

std::vector<bool> membersOfBase(const CycleConfig& config) {
  std::vector<bool> members(config.drives.size(), false);
  if (!config.base) return members;
  for (const DriveIndex drive : config.base->drives()) members[drive] = true;
  return members;
}

drive::StopCause causeOf(Interruption interruption) noexcept {
  if (interruption == Interruption::kSilent) return drive::StopCause::kSilent;
  if (interruption == Interruption::kContested) return drive::StopCause::kContested;
  return drive::StopCause::kInterrupted;
}

// Never too late.
bool stops(RequestKind kind) noexcept {
  return kind == RequestKind::kDisable || kind == RequestKind::kQuickStop || kind == RequestKind::kShutDown;
}

}  // namespace

BusCycle::BusCycle(const CycleConfig& config, Transport& transport, CyclePorts& ports, bool auto_enable, CycleRole role)
    : transport_(transport),
      ports_(ports),
      role_(role),
      gate_(role == CycleRole::kGuest),
      period_(config.period()),
      cmd_vel_timeout_(config.cmd_vel_timeout),
      names_(namesOf(config)),
      drives_(makeDrives(config, transport, role == CycleRole::kOnlooker)),
      start_acknowledge_(config.acknowledge_bus_timeouts && role == CycleRole::kDriver, drives_, names_,
                         groupsOf(config)),
      command_watch_(ports, config.cmd_vel_timeout, config.base.has_value(), names_, membersOfBase(config)),
      supervisor_(config, drives_, auto_enable, &start_acknowledge_, &command_watch_),
      standstill_requests_(drives_, names_, modulesOf(config, transport)),
      position_requests_(drives_, axes_, names_),
      outputs_(config.drives.size()),
      inputs_(config.drives.size()),
      snapshot_(config.drives.size()) {
  for (const DriveSetup& setup : config.drives) {
    addAxis(setup, role);
    leaders_.push_back(setup.leader);
  }
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    snapshot_.drives[i].joint_known = !drives_[i].positions();
    const std::size_t words = std::max<std::size_t>(transport_.identity(i).process_values, 1);
    snapshot_.drives[i].words = static_cast<std::uint8_t>(std::min(words, profile::kMaxProcessValues));
  }
  if (!config.base) return;
  addBase(*config.base);
}

void BusCycle::runOnce() noexcept {
  const Instant now = transport_.now();
  statistics_.handleCycleStart(now);
  takeRequests(now);
  command(now, rampTime(now));
  last_command_ = now;

  pollOutputs(now);
  gate_.holdBack(outputs_);
  if (role_ == CycleRole::kOnlooker) std::fill(outputs_.begin(), outputs_.end(), profile::ProcessOutput{});
  transport_.exchange(outputs_, inputs_);
  gate_.handleInputs(inputs_);

  const Instant after = transport_.now();
  handleInputs(after);
  const CommandState commands = command_watch_.look(after);
  snapshot_.base.commanded = role_ == CycleRole::kDriver && command_watch_.baseMoves(after);
  acknowledgeAtStart(commands.quiet, after);
  supervisor_.update(commands, after);
  standstill_requests_.update(after);
  while (const auto completion = supervisor_.pollCompletion()) ports_.complete(*completion);
  position_requests_.update(after);
  while (const auto completion = position_requests_.pollCompletion()) ports_.complete(*completion);
  while (const auto completion = standstill_requests_.pollCompletion()) ports_.complete(*completion);
  runParameters(after);
  measure(after, last_input_ ? after - *last_input_ : Duration::zero());
  last_input_ = after;
  publish(after);
}

// A cycle that was held up is no time the wheels had for their ramp: what it lasted would be a jump of the setpoint.
Duration BusCycle::rampTime(Instant now) const noexcept {
  if (!last_command_) return period_;
  return std::min(now - *last_command_, std::max(kLongestRampStep, 3 * period_));
}

void BusCycle::takeRequests(Instant now) noexcept {
  while (auto request = ports_.pollRequest()) {
    const Duration waited = request->asked == Instant{} ? Duration::zero() : now - request->asked;
    request->patience -= std::max(waited, Duration::zero());
    if (request->patience >= Duration::zero() || stops(request->kind)) {
      takeRequest(*request, now);
    } else {
      // Told that it failed, its asker must not see it succeed later.
      ports_.complete(answerTo(*request, false, "the bus cycle was held up for too long: not carried out"));
    }
  }
}

// Nobody here has enabled anything, so that there is nothing to stop and nothing to bring to rest.
bool BusCycle::refuseAsOnlooker(const Request& request) noexcept {
  if (role_ != CycleRole::kOnlooker || request.kind == RequestKind::kReadParameter ||
      request.kind == RequestKind::kResetOdometry) {
    return false;
  }
  Completion refused = answerTo(request, request.kind == RequestKind::kShutDown,
                                "read_only is true: this node looks on, it commands nothing and writes nothing");
  refused.parameter.outcome = profile::ParameterOutcome::kRefused;
  refused.parameter.reason = profile::ParameterReason::kDriver;
  ports_.complete(refused);
  return true;
}

void BusCycle::takeRequest(const Request& request, Instant now) noexcept {
  if (refuseAsOnlooker(request)) return;
  switch (request.kind) {
    case RequestKind::kReadParameter:
    case RequestKind::kWriteParameter:
      return accessParameter(request, now);
    case RequestKind::kAcknowledge:
      return standstill_requests_.handleRequest(request, now);
    case RequestKind::kSelectParameterSet:
      return selectParameterSet(request, now);
    case RequestKind::kHome:
      if (refuseHomeUnderWay(request)) return;
      return position_requests_.handleRequest(request, now);
    case RequestKind::kTeach:
    case RequestKind::kResetPosition:
      return position_requests_.handleRequest(request, now);
    case RequestKind::kResetOdometry:
      return ports_.complete(resetOdometry(request));
    case RequestKind::kEnable:
    case RequestKind::kDisable:
    case RequestKind::kQuickStop:
    case RequestKind::kShutDown:
      return supervisor_.handleRequest(request, command_watch_.look(now), now);
  }
}

// Written while it turns, P105 would be a step of the speed (the setpoint is a share of it), P104 a motion of its own.
void BusCycle::accessParameter(const Request& request, Instant now) noexcept {
  const std::optional<DriveIndex> moving = decidesMotion(request) ? movingBy(request, now) : std::nullopt;
  if (!moving) {
    axes_[request.drive].parameters.handleRequest(request, drives_[request.drive], now);
    holdForModule();
    return submitParameters(request.drive, now);  // it leaves with this cycle's exchange
  }
  Completion refused = answerTo(request, false, axes_[*moving].parameters.notWhileEnabled(request));
  refused.parameter.outcome = profile::ParameterOutcome::kRefused;
  refused.parameter.reason = profile::ParameterReason::kDriver;
  ports_.complete(refused);
}

// The drive whose motion the write would change. Whose brake a module's relay is wired to, and whom its terminals enable,
// nobody here knows; a drive that was lost while it turned may turn still.
std::optional<DriveIndex> BusCycle::movingBy(const Request& request, Instant now) noexcept {
  if (!isAtRest(request.drive)) return request.drive;
  if (!isOfAllBehindModule(request.parameter.number)) return std::nullopt;
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (!isAtRest(i) || drives_[i].stopsUnheard(now)) return i;
  }
  return std::nullopt;
}

// It was looked at when the write was asked for: until it has been carried out no other drive may begin to turn.
void BusCycle::holdForModule() noexcept {
  if (std::none_of(axes_.begin(), axes_.end(), [](const Axis& axis) { return axis.parameters.writesForModule(); }))
    return;
  for (drive::Drive& held : drives_) held.setParametersAwaited(true);
}

bool BusCycle::isAtRest(DriveIndex drive) noexcept {
  return supervisor_.groupOf(drive).report().phase == drive::GroupPhase::kDisabled && drives_[drive].isAtRest();
}

// A drive that is idle may still belong to a base that is on its way to rest: its set stays what it is until then.
void BusCycle::selectParameterSet(const Request& request, Instant now) noexcept {
  if (supervisor_.groupOf(request.drive).report().phase == drive::GroupPhase::kDisabled) {
    return standstill_requests_.handleRequest(request, now);
  }
  Sentence why;
  why.format("parameter sets are switched at standstill only: disable drive %s first", names_[request.drive].c_str());
  ports_.complete(answerTo(request, false, why));
}

Completion BusCycle::resetOdometry(const Request& request) noexcept {
  if (base_) base_->resetOdometry();
  if (steered_) steered_->resetOdometry();
  return answerTo(request, hasBase(), hasBase() ? "the pose is zero" : "there is no base");
}

void BusCycle::command(Instant now, Duration dt) noexcept {
  shareRest();
  if (base_) commandBase(now, dt);
  if (steered_) commandSteered(now, dt);
  commandSingles(now, dt);
}

void BusCycle::commandSingles(Instant now, Duration dt) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (supervisor_.inBase(i) || isLed(i)) continue;
    drive::DriveGroup& group = supervisor_.groupOf(i);
    if (drives_[i].positions()) {
      commandPosition(i, now);
      continue;
    }
    const JointCommand& newest = ports_.newestDriveCommand(i);
    const bool fresh = !isStale(newest, cmd_vel_timeout_, now);
    group.commandIsFresh(fresh, now);
    const bool follow = group.commandAllowed();
    const bool asked = follow && fresh;
    const double velocity = axes_[i].motion.pollVelocity(asked ? newest.velocity : 0.0, follow || group.wantsZeroRamp(),
                                                         boundsOf(i, !asked), dt);
    setVelocity(i, velocity);
    group.setpointIsZero(velocity == 0.0);
  }
}

void BusCycle::handleInputs(Instant now) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (inputs_[i].interruption != Interruption::kNone) {
      drives_[i].handleInterruption(causeOf(inputs_[i].interruption), now);
      axes_[i].words.handleInterruption();
      axes_[i].parameters.handleLoss(drives_[i]);
    }
    const drive::DriveReport& before = drives_[i].report();
    // A cycle without an answer says nothing of its reference: what was heard last counts while it is online.
    if (inputs_[i].inverter_answers && profile::StatusWord(inputs_[i].input.status_word).isUseful()) {
      drives_[i].setReferenced(
          axes_[i].bits.referenced(inputs_[i].input, axes_[i].parameters.device(), before.parameter_set));
    }
    drives_[i].handleModule(inputs_[i].inverter_missing, now);
    drives_[i].handleInput(inputs_[i].input, inputs_[i].inverter_answers, now);
    axes_[i].known = axes_[i].known || drives_[i].report().online;
    if (role_ != CycleRole::kOnlooker) axes_[i].terminals.update(drives_[i].report(), now);
    axes_[i].recorder.handleCycle({now, inputs_[i].inverter_answers, outputs_[i], inputs_[i].input});
  }
}

void BusCycle::acknowledgeAtStart(bool quiet, Instant now) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    start_acknowledge_.update(i, axes_[i].parameters.faults().lastNumber(), quiet, now);
  }
  while (const auto event = start_acknowledge_.pollEvent()) ports_.tell(*event);
}

void BusCycle::runParameters(Instant now) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) axes_[i].parameters.handleState(drives_[i], now);
  holdForModule();
  submitAllParameters(now);
  bool answered = false;
  while (const auto result = transport_.pollResult()) {
    answered = true;
    for (Axis& axis : axes_) {
      if (axis.parameters.handleResult(*result)) break;
    }
  }
  // What follows an answer leaves with the next exchange, not with the one after it.
  if (answered) submitAllParameters(now);
  for (Axis& axis : axes_) {
    axis.parameters.endOverdue(now);
    while (const auto completion = axis.parameters.pollCompletion()) ports_.complete(*completion);
    if (!axis.parameters.takeModuleWrite()) continue;
    for (Axis& other : axes_) other.parameters.readModuleAgain();
  }
}

void BusCycle::submitAllParameters(Instant now) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) submitParameters(i, now);
}

void BusCycle::submitParameters(DriveIndex drive, Instant now) noexcept {
  if (!drives_[drive].report().online) return;
  DriveParameters& parameters = axes_[drive].parameters;
  while (const auto request = parameters.pollRequest(now)) {
    if (transport_.submit(drive, *request)) continue;
    profile::ParameterResult busy;
    busy.id = request->id;
    busy.outcome = profile::ParameterOutcome::kBusy;
    parameters.handleResult(busy);
    return;
  }
}

void BusCycle::measure(Instant now, Duration dt) noexcept {
  if (dt > std::max(kHoldUp, 3 * period_)) forgetSpeeds();
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    const drive::DriveReport& report = drives_[i].report();
    if (report.online && report.scaled) {
      axes_[i].joint.update(report.velocity.value, dt);
    } else {
      axes_[i].joint.rebase();
    }
    const bool own_velocity = !drives_[i].positions() && !isLed(i);
    axes_[i].speed.update(drive::isEnabled(report.phase) && report.scaled && own_velocity,
                          report.velocity_command.value, report.velocity.value,
                          drives_[i].maxVelocity().value_or(RadPerSec{}).value, now);
  }
  if (hasBase()) measureBase(dt);
}

void BusCycle::forgetSpeeds() noexcept {
  for (Axis& axis : axes_) axis.joint.rebase();
  if (base_) base_->handleGap();
  if (steered_) steered_->handleGap();
}

void BusCycle::publish(Instant now) noexcept {
  snapshot_.time = now;
  snapshot_.connected = transport_.connected();
  snapshot_.settled = supervisor_.settled();
  snapshot_.times = statistics_.times();
  snapshot_.counters = transport_.counters();
  snapshot_.bus_text = transport_.busText();
  while (const auto event = transport_.pollEvent()) ports_.tell(*event);
  tellChanges(now);
  for (DriveIndex i = 0; i < drives_.size(); ++i) fill(snapshot_.drives[i], i, now);
  if (hasBase()) publishBase();
  ports_.observe(outputs_, inputs_, snapshot_);
  ports_.publish(snapshot_);
}

// Against the snapshot of the last cycle.
void BusCycle::tellChanges(Instant now) noexcept {
  BusEvent enabled{false, {}};
  if (hasBase() && supervisor_.base()->commandAllowed() && !snapshot_.base.enabled) {
    enabled.text = "the base is enabled";
    ports_.tell(enabled);
  }
  if (const auto why = supervisor_.takeAutoEnableFailure()) {
    BusEvent failed{true, {}};
    failed.text.format("auto_enable has enabled nobody, and does not try again: %s", why->c_str());
    ports_.tell(failed);
  }
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    const drive::DriveReport& report = drives_[i].report();
    if (!supervisor_.inBase(i) && drive::isEnabled(report.phase) && !snapshot_.drives[i].enabled) {
      enabled.text.format("drive %s is enabled", names_[i].c_str());
      ports_.tell(enabled);
    }
    const auto news = axes_[i].terminals.poll(now);
    if (!news) continue;
    BusEvent event{true, terminalMessage(names_[i].c_str(), news->finding, report)};
    if (news->finding == TerminalFinding::kNone) {
      event.warning = false;
      event.text.format(news->before == TerminalFinding::kHeld ? "drive %s is not held at its terminals any more"
                                                               : "drive %s: the bus has control of it again",
                        names_[i].c_str());
    }
    ports_.tell(event);
  }
}

void BusCycle::fill(DriveSnapshot& to, DriveIndex drive, Instant now) const noexcept {
  const Axis& axis = axes_[drive];
  const bool beyond = supervisor_.inBase(drive) ? isSaturatedWheel(drive) : axis.motion.isSaturated();
  to.module_inputs = inputs_[drive].module_inputs;
  fillDriveSnapshot(to,
                    {drive, names_[drive].c_str(), drives_[drive].report(), outputs_[drive], axis,
                     inputs_[drive].module_answers, drives_[drive].positions(), beyond},
                    transport_, now);
}

}  // namespace nord_driver::cycle
