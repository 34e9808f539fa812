#include "nord_driver/cycle/bus_cycle.h"

#include <algorithm>
#include <cmath>

#include "nord_driver/cycle/sentences.h"

namespace nord_driver::cycle {

namespace {

// Ids of the cycle's own parameter accesses, numbered through above the drive's index: an answer to a question from
// before a loss must not pass for the answer to a new one. The rest belongs to the callers.
constexpr std::uint32_t kDeviceReadId = 0x8000'0000u;
constexpr std::uint32_t kReadStep = 0x100u, kDriveMask = 0xFFu;

std::vector<drive::Drive> makeDrives(const CycleConfig& config) {
  std::vector<drive::Drive> drives;
  for (const DriveSetup& setup : config.drives) drives.emplace_back(setup.drive);
  return drives;
}

}  // namespace

BusCycle::BusCycle(const CycleConfig& config, Transport& transport, CyclePorts& ports, bool auto_enable)
    : transport_(transport),
      ports_(ports),
      period_(config.period()),
      cmd_vel_timeout_(config.cmd_vel_timeout),
      drives_(makeDrives(config)),
      supervisor_(config, drives_, auto_enable),
      outputs_(config.drives.size()),
      inputs_(config.drives.size()),
      snapshot_(config.drives.size()) {
  for (const DriveSetup& setup : config.drives) {
    names_.push_back(setup.name);
    axes_.emplace_back(setup);
  }
  if (!config.base) return;
  base_.emplace(*config.base, config.cmd_vel_timeout);
  wheels_ = config.base->wheels();
}

void BusCycle::runOnce() noexcept {
  const Instant now = transport_.now();
  statistics_.handleCycleStart(now);
  takeRequests(now);
  command(now, last_command_ ? now - *last_command_ : period_);
  last_command_ = now;

  for (DriveIndex i = 0; i < drives_.size(); ++i) outputs_[i] = drives_[i].pollOutput(now);
  transport_.exchange(outputs_, inputs_);

  const Instant after = transport_.now();
  handleInputs(after);
  supervisor_.update(movingCommand(after), after);
  while (const auto completion = supervisor_.pollCompletion()) ports_.complete(*completion);
  readDevices();
  measure(last_input_ ? after - *last_input_ : Duration::zero());
  last_input_ = after;
  publish(after);
}

void BusCycle::takeRequests(Instant now) noexcept {
  while (const auto request = ports_.pollRequest()) {
    if (request->kind == RequestKind::kReadParameter) {
      startParameterJob(*request);
    } else if (request->kind == RequestKind::kResetOdometry) {
      Completion completion;
      completion.id = request->id;
      completion.success = base_.has_value();
      completion.message = base_ ? "the pose is zero" : "there is no base";
      if (base_) base_->resetOdometry();
      ports_.complete(completion);
    } else {
      supervisor_.handleRequest(*request, movingCommand(now), now);
    }
  }
}

// A command that is not zero and not stale: nothing may be enabled under it.
Sentence BusCycle::movingCommand(Instant now) noexcept {
  Sentence text;
  const TwistCommand& base = ports_.newestBaseCommand();
  if (base_ && !isStale(base, cmd_vel_timeout_, now) && base.twist != robot::Twist2d{}) {
    text.format(
        "the newest cmd_vel is not zero (%.3f m/s, %.3f rad/s, %.2f s old): send zero first, or wait until it "
        "is older than cmd_vel_timeout",
        base.twist.linear_x, base.twist.angular_z, toSeconds(now - base.received));
    return text;
  }
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    const JointCommand& joint = ports_.newestDriveCommand(i);
    if (supervisor_.inBase(i) || isStale(joint, cmd_vel_timeout_, now) || joint.velocity == 0.0) continue;
    text.format(
        "the newest command of drive %s is not zero (%.3f rad/s): send zero first, or wait until it is older "
        "than cmd_vel_timeout",
        names_[i].c_str(), joint.velocity);
    return text;
  }
  return text;
}

void BusCycle::command(Instant now, Duration dt) noexcept {
  if (base_) commandBase(now, dt);
  commandSingles(now);
}

void BusCycle::commandBase(Instant now, Duration dt) noexcept {
  drive::DriveGroup& group = *supervisor_.base();
  const bool follow = group.commandAllowed();
  const bool driving = follow || group.wantsZeroRamp();
  const robot::WheelSpeeds wheels =
      base_->pollWheels(ports_.newestBaseCommand(), driving, follow, maxWheelSpeeds(), now, dt);
  for (std::size_t i = 0; i < wheels_.size(); ++i) drives_[wheels_[i]].setVelocity(RadPerSec{wheels[i]});
  group.setpointIsZero(robot::standsStill(wheels));
}

void BusCycle::commandSingles(Instant now) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (supervisor_.inBase(i)) continue;
    drive::DriveGroup& group = supervisor_.groupOf(i);
    const JointCommand& newest = ports_.newestDriveCommand(i);
    const bool follow = group.commandAllowed() && !isStale(newest, cmd_vel_timeout_, now);
    drives_[i].setVelocity(RadPerSec{follow ? newest.velocity : 0.0});
    group.setpointIsZero(!follow || newest.velocity == 0.0);
  }
}

robot::WheelSpeeds BusCycle::maxWheelSpeeds() const noexcept {
  robot::WheelSpeeds speeds;
  for (const DriveIndex i : wheels_) speeds.push_back(drives_[i].maxVelocity().value_or(RadPerSec{}).value);
  return speeds;
}

void BusCycle::handleInputs(Instant now) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    drives_[i].handleInput(inputs_[i].input, inputs_[i].inverter_answers, now);
    axes_[i].known = axes_[i].known || drives_[i].report().online;
  }
}

void BusCycle::readDevices() noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (!drives_[i].report().online) {
      axes_[i].reader.handleOffline();
      // Another inverter may come back in its place: nothing is enabled with what P105 was before.
      for (std::uint8_t set = 1; set <= 4; ++set) drives_[i].setMaxFrequency(set, Hertz{});
      continue;
    }
    auto request = axes_[i].reader.pollRequest();
    if (!request) continue;
    read_sequence_ += kReadStep;
    request->id = kDeviceReadId | read_sequence_ | static_cast<std::uint32_t>(i);
    axes_[i].read_id = request->id;
    if (!transport_.submit(i, *request)) {
      profile::ParameterResult busy;
      busy.outcome = profile::ParameterOutcome::kBusy;
      axes_[i].reader.handleResult(busy);
    }
  }
  while (const auto result = transport_.pollResult()) takeParameterResult(*result);
}

void BusCycle::startParameterJob(const Request& request) noexcept {
  profile::ParameterResult refused;
  refused.id = request.id;
  refused.outcome = profile::ParameterOutcome::kBusy;
  if (!drives_[request.drive].report().online) refused.outcome = profile::ParameterOutcome::kOffline;
  profile::ParameterRequest access = request.parameter;
  access.id = request.id;
  const std::uint8_t set_in_force = drives_[request.drive].report().parameter_set;
  if (request.active_set && set_in_force != 0) access.parameter_set = set_in_force;
  const bool startable = refused.outcome == profile::ParameterOutcome::kBusy && !parameter_jobs_.full();
  if (startable && transport_.submit(request.drive, access)) {
    parameter_jobs_.push_back({request, request.drive});
    return;
  }
  Completion completion;
  completion.id = request.id;
  completion.parameter = refused;
  completion.message = parameterSentence(names_[request.drive].c_str(), request.parameter.number, refused);
  ports_.complete(completion);
}

void BusCycle::takeParameterResult(const profile::ParameterResult& result) noexcept {
  if (result.id >= kDeviceReadId) {
    const DriveIndex drive = result.id & kDriveMask;
    if (drive >= axes_.size() || axes_[drive].read_id != result.id) return;
    axes_[drive].reader.handleResult(result);
    return scale(drive);
  }
  for (std::size_t i = 0; i < parameter_jobs_.size(); ++i) {
    const ParameterJob job = parameter_jobs_[i];
    if (job.request.id != result.id) continue;
    for (std::size_t j = i + 1; j < parameter_jobs_.size(); ++j) parameter_jobs_[j - 1] = parameter_jobs_[j];
    parameter_jobs_.resize(parameter_jobs_.size() - 1);
    Completion completion;
    completion.id = result.id;
    completion.success = result.outcome == profile::ParameterOutcome::kDone;
    completion.parameter = result;
    completion.message = parameterSentence(names_[job.drive].c_str(), job.request.parameter.number, result);
    ports_.complete(completion);
    return;
  }
}

// P105 as read; as typed where the drive does not tell it.
void BusCycle::scale(DriveIndex drive) noexcept {
  const Axis& axis = axes_[drive];
  for (std::uint8_t set = 1; set <= 4; ++set) {
    const auto& read = axis.reader.data().max_frequency[set - 1u];
    if (read) {
      drives_[drive].setMaxFrequency(set, Hertz{*read});
    } else if (axis.typed_max_frequency && axis.reader.maxFrequenciesAsked()) {
      drives_[drive].setMaxFrequency(set, Hertz{*axis.typed_max_frequency});
    }
  }
}

void BusCycle::measure(Duration dt) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    const drive::DriveReport& report = drives_[i].report();
    if (report.online && report.scaled) {
      axes_[i].joint.update(report.velocity.value, dt);
    } else {
      axes_[i].joint.rebase();
    }
  }
  if (base_) measureBase(dt);
}

void BusCycle::measureBase(Duration dt) noexcept {
  bool seen = true;
  robot::WheelSpeeds wheels;
  for (const DriveIndex i : wheels_) {
    seen = seen && drives_[i].report().online && drives_[i].report().scaled;
    wheels.push_back(drives_[i].report().velocity.value);
  }
  if (seen) {
    base_->handleWheels(wheels, dt);
  } else {
    base_->handleGap();
  }
}

void BusCycle::publish(Instant now) noexcept {
  snapshot_.time = now;
  snapshot_.connected = transport_.connected();
  snapshot_.settled = supervisor_.settled();
  snapshot_.times = statistics_.times();
  snapshot_.counters = transport_.counters();
  snapshot_.bus_text = transport_.busText();
  for (DriveIndex i = 0; i < drives_.size(); ++i) fill(snapshot_.drives[i], i);
  if (base_) {
    BaseSnapshot& base = snapshot_.base;
    base.known = true;
    for (DriveIndex i = 0; i < drives_.size(); ++i) {
      base.known = base.known && (axes_[i].known || !supervisor_.inBase(i));
    }
    base.pose = base_->odometry().pose();
    base.velocity = base_->odometry().velocity();
    base.command = base_->limited();
    base.enabled = supervisor_.base()->commandAllowed();
    base.text = supervisor_.baseStopSentence();
    base.stopped = !base.text.empty();
  }
  ports_.publish(snapshot_);
}

void BusCycle::fill(DriveSnapshot& to, DriveIndex drive) const noexcept {
  const drive::DriveReport& report = drives_[drive].report();
  to.online = report.online;
  to.module_answers = inputs_[drive].module_answers;
  to.enabled = report.phase == drive::Phase::kEnabled;
  to.state = report.state;
  to.parameter_set = report.parameter_set;
  to.output = report.output;
  to.input = report.input;
  to.velocity_command = report.velocity_command.value;
  to.velocity = report.velocity.value;
  to.frequency = report.frequency.value;
  to.joint_position = axes_[drive].joint.position();
  // The number stands in P700, which is read when faults are more than being lost.
  to.fault_number = profile::StatusWord{report.status_word}.fault() && report.online ? 65535 : 0;
  to.stopped = report.stop_cause != drive::StopCause::kNone;
  if (!report.online) {
    to.text = transport_.note(drive).text;
  } else {
    to.text = stopSentence(names_[drive].c_str(), report.stop_cause, report);
  }
  to.device = axes_[drive].reader.data();
  to.device.ident = transport_.identNumber(drive);
}

}  // namespace nord_driver::cycle
