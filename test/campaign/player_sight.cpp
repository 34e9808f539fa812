#include <algorithm>
#include <cmath>

#include "campaign/axes.h"
#include "campaign/player.h"
#include "sim/inverter/words.h"
#include "support/work_counters.h"

namespace nord_driver::test {

using cycle::RequestKind;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

// Five questions of guarding (100 ms), and the stop words that follow.
constexpr Duration kToldApart = seconds{1};

}  // namespace

Duration Player::byWords() {
  return 3 * rig_->robot().config().period() + rig_->wireLatency();
}

Duration Player::byTimeouts() {
  const Duration drive_timeout = rig_->robot().config().drives.front().drive.drive_timeout;
  return rig_->silence() + drive_timeout + rig_->driveSideTimeout() + byWords();
}

Duration Player::reaction() {
  const bool disturbs =
      std::any_of(active_.begin(), active_.end(), [](const Active& active) { return active.act->disturbs; });
  if (disturbs) disturbed_ = now();
  return disturbed_ && now() - *disturbed_ <= byTimeouts() ? byTimeouts() : byWords();
}

// An interface that takes a frame now and then: until each drive and the guarding had its turn. A module keeps its inverters
// going meanwhile, whichever of them a frame is for.
Duration Player::slowestQueue() {
  for (const Active& active : active_) {
    if (active.event.act != "queue_slow") continue;
    const Duration turn = (moment_.drives.size() + 2) * milliseconds{active.event.amount};
    queue_turn_ = std::max(queue_turn_, turn);
    queue_slow_until_ = now() + queue_turn_;
  }
  if (now() >= queue_slow_until_) queue_turn_ = {};
  return queue_turn_;
}

void Player::seeTruth() {
  for (DriveIndex i = 0; i < moment_.drives.size(); ++i) {
    sim::DriveUnit& unit = rig_->unit(i);
    const sim::InverterModel& inverter = unit.inverter();
    DriveTruth& truth = moment_.drives[i];
    truth.state = inverter.state();
    truth.frequency = inverter.frequency();
    truth.wheel_speed = unit.wheelSpeed();
    truth.setpoint = static_cast<std::int16_t>(inverter.setpoint1());
    truth.bus_control = inverter.busControl();
    const double ramp = unit.parameters().scaled(103, inverter.parameterSet());
    const double shaft = unit.shaftAngle() / (2.0 * M_PI);
    truth.rotor = unit.shaftSpeed() * unit.config().motor.pole_pairs / (2.0 * M_PI);
    truth.position = unit.position() / kRevolutionsPerRadian;
    truth.zero = shaft - unit.position();
    const double rise = unit.parameters().scaled(102, inverter.parameterSet());
    truth.full = unit.parameters().scaled(105, inverter.parameterSet());
    truth.slowest = unit.parameters().scaled(104, inverter.parameterSet());
    truth.ramp = ramp > 0.0 ? truth.full / ramp : 1e6;
    truth.rise = rise > 0.0 ? truth.full / rise : 1e6;
    const double sense = unit.config().inverted ? -1.0 : 1.0;
    truth.along = sense * truth.frequency;
    // Without its mains, or where its module does not reach it, there is none to tell: the basic AC drive profile has 0 then.
    const bool tells = inverter.powered() && unit.inverterLink();
    if (scenario_.layout.otherProfile() && rig_->tellsShaft()) truth.shaft_along = tells ? sense * truth.rotor : 0.0;
    truth.told = sense * truth.full * truth.setpoint / sim::kFullScale;
  }
  if (const sim::DriveUnit* const twin = rig_->twin()) {
    if (std::any_of(active_.begin(), active_.end(), hidesTheFirst)) first_hidden_at_ = now();
    // Heard alone it cannot be told from the drive that it stands in for.
    const bool told_apart = !first_hidden_at_ || now() - *first_hidden_at_ > kToldApart;
    const bool enabled =
        twin->inverter().state() == sim::InverterState::kOperationEnabled && twin->inverter().busControl();
    moment_.twin_enabled = enabled && told_apart;
    moment_.stand_in_enabled = enabled && !told_apart;
    moment_.twin_position.reset();
    if (twin->plugged()) moment_.twin_position = twin->position() / kRevolutionsPerRadian;
    const bool silent = moment_.driver_ran && moment_.snapshot != nullptr && !moment_.snapshot->drives[0].online;
    moment_.stand_in_believed = (moment_.stand_in_believed && !silent) || (twin->plugged() && !told_apart);
  }
  seeWanted();
  moment_.cut.assign(moment_.cut.size(), false);
  for (DriveIndex i = scenario_.layout.firstAxis(); i < moment_.axes.size(); ++i) {
    const auto runs = [&](const Call& call) {
      return !call.answered && call.request.kind == RequestKind::kHome && call.request.drive == i;
    };
    moment_.axes[i].homing = std::any_of(calls_.begin() + static_cast<std::ptrdiff_t>(first_open_), calls_.end(), runs);
  }
  for (const Active& active : active_) {
    for (DriveIndex i = 0; i < moment_.drives.size(); ++i) {
      const bool station = &rig_->unit(active.event.drive).module() == &rig_->unit(i).module();
      const bool cut = active.act->cuts == Cuts::kAll || (active.act->cuts == Cuts::kStation && station) ||
                       (active.act->cuts == Cuts::kDrive && active.event.drive == i);
      if (cut) moment_.cut[i] = true;
    }
  }
}

void Player::seeWanted() {
  const auto of_wheel = [](DriveIndex i, double linear, double angular) {
    const double side = i % 2 == 0 ? -1.0 : 1.0;
    return (linear + side * angular * kSeparation / 2.0) / kWheelRadius * kHertzPerSpeed;
  };
  for (DriveIndex i = 0; i < moment_.drives.size(); ++i) {
    const bool wheel = i < scenario_.layout.wheels;
    const Command& command = wheel ? base_command_ : drive_commands_[i];
    const double speed = wheel ? of_wheel(i, command.linear, command.angular) : command.velocity * kHertzPerSpeed;
    moment_.wanted[i] = isFresh(command) && (speed > 0.0 || rig_->reverses()) ? speed : 0.0;
    moment_.renewed[i] = command.ever && moment_.driver_ran && command.given == moment_.began;
  }
  if (moment_.between.empty()) return;
  const double linear = isFresh(base_command_) ? base_command_.linear : 0.0;
  const double angular = isFresh(base_command_) ? base_command_.angular : 0.0;
  linear_.add(now(), {linear, linear});
  angular_.add(now(), {angular, angular});
  const Instant from = now() - moment_.setpoint_ramps.front().longest;
  const Span along = linear_.since(from), around = angular_.since(from);
  for (DriveIndex i = 0; i < moment_.drives.size(); ++i) {
    moment_.between[i] = {moment_.wanted[i], moment_.wanted[i]};
    if (i >= scenario_.layout.wheels) continue;
    for (const double v : {along.least, along.most}) {
      for (const double w : {around.least, around.most}) {
        moment_.between[i].least = std::min(moment_.between[i].least, of_wheel(i, v, w));
        moment_.between[i].most = std::max(moment_.between[i].most, of_wheel(i, v, w));
      }
    }
  }
}

void Player::seeAnswers() {
  moment_.answers.clear();
  const auto& all = rig_->robot().completions();
  for (; seen_answers_ < all.size(); ++seen_answers_) {
    const cycle::Completion& answer = all[seen_answers_];
    moment_.answers.push_back(answer);
    ++outcome_.answers;
    for (std::size_t i = first_open_; i < calls_.size(); ++i) {
      Call& call = calls_[i];
      if (call.request.id != answer.id) continue;
      call.answered = true;
      if (call.request.kind == RequestKind::kResetOdometry && answer.success) moment_.odometry_reset = true;
      if (call.request.kind != RequestKind::kEnable) continue;
      outcome_.enabled += answer.success ? 1 : 0;
      for (GroupWish& group : moment_.groups) {
        if (!concerns(call.request, group)) continue;
        if (answer.success && group.asked) group.confirmed = true;
        // Told that it failed, its asker must not see it succeed later. Who was enabled before stays so, or is taken back.
        if (!answer.success && !group.confirmed) group.asked = asksToEnable(group);
      }
    }
  }
  while (first_open_ < calls_.size() && calls_[first_open_].answered) ++first_open_;
}

bool Player::concerns(const cycle::Request& request, const GroupWish& group) const {
  if (request.drive == cycle::kAllDrives) return true;
  // A wheel of a base is enabled with it alone; a stop of one stops them all.
  if (group.is_base && request.kind == RequestKind::kEnable) return false;
  return std::find(group.members.begin(), group.members.end(), request.drive) != group.members.end();
}

bool Player::asksToEnable(const GroupWish& group) const {
  return std::any_of(calls_.begin() + static_cast<std::ptrdiff_t>(first_open_), calls_.end(), [&](const Call& call) {
    return !call.answered && call.request.kind == RequestKind::kEnable && concerns(call.request, group);
  });
}

bool Player::isFresh(const Command& command) {
  return command.ever && now() - command.given <= rig_->robot().config().cmd_vel_timeout;
}

Player::Command& Player::commandOf(const GroupWish& group) {
  return group.is_base ? base_command_ : drive_commands_[group.members.front()];
}

bool Player::hasRunOut(const GroupWish& group) {
  const Command& command = commandOf(group);
  return scenario_.layout.ways() != 0 && command.followed && !isFresh(command);
}

// What the driver has stopped by itself needs an enabling before it moves again.
void Player::seeStops() {
  for (GroupWish& group : moment_.groups) {
    const auto& snapshot = *moment_.snapshot;
    const bool enabled = group.is_base ? snapshot.base.enabled : snapshot.drives[group.members.front()].enabled;
    const bool runs = enabled && !hasRunOut(group);
    commandOf(group).followed = group.confirmed && runs && isFresh(commandOf(group));
    if (!group.confirmed || runs) continue;
    group.asked = group.confirmed = false;
    ++outcome_.stopped;
  }
}

void Player::seeInterruptions() {
  for (GroupWish& group : moment_.groups) {
    // Who is held up sees it when it runs again, and a word from before may be on its way until then.
    if (!moment_.driver_ran || !group.confirmed || asksToEnable(group)) continue;
    // It rests by OFF1 between two commands.
    if (scenario_.layout.hasSlowest() && !group.is_axis) continue;
    const auto turns = [this](DriveIndex i) { return moment_.drives[i].turnsByBus(); };
    if (!std::all_of(group.members.begin(), group.members.end(), turns)) group.interrupted = true;
  }
}

void Player::sampleParameters() {
  for (std::size_t i = first_open_; i < calls_.size(); ++i) {
    Call& call = calls_[i];
    const bool parameter =
        call.request.kind == RequestKind::kReadParameter || call.request.kind == RequestKind::kWriteParameter;
    if (call.answered || !parameter) continue;
    const std::int32_t value = rig_->unit(call.request.drive)
                                   .parameters()
                                   .value(call.request.parameter.number, call.request.parameter.parameter_set - 1u);
    if (call.held.empty() || call.held.back() != value) call.held.push_back(value);
    // Who has the address of the first one answers as well.
    sim::DriveUnit* const twin = call.request.drive == 0 ? rig_->twin() : nullptr;
    if (twin != nullptr && twin->plugged()) {
      call.held.push_back(
          twin->parameters().value(call.request.parameter.number, call.request.parameter.parameter_set - 1u));
    }
  }
}

std::uint64_t Player::counted() {
  std::uint64_t sum = 0;
  for (const NamedCounter& counter : rig_->robot().transport().counters()) {
    if (!countsWork(counter.name)) sum += counter.value;
  }
  return sum;
}

void Player::watchLosses() {
  for (std::size_t i = 0; i < losses_.size();) {
    if (now() < losses_[i].due) {
      ++i;
      continue;
    }
    if (counted() == losses_[i].counted) {
      fail("EveryLossCounted", "bus_status: retries, timeouts, checksum_errors, parity_errors, discarded_bytes, ...",
           losses_[i].act + ": no counter has moved since");
    }
    losses_.erase(losses_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

void Player::fail(const char* invariant, const char* sentence, std::string what) {
  if (!goesOn()) return;
  outcome_.violation = Violation{invariant, sentence, std::move(what), sinceStart()};
}

void Player::look(Instant began, bool driver_ran) {
  moment_.began = began;
  moment_.now = now();
  moment_.at = sinceStart();
  moment_.driver_ran = driver_ran;
  moment_.reaction = reaction();
  moment_.noticed_within = moment_.reaction + rig_->toldLate();
  moment_.heard_within = std::max(moment_.reaction, slowestQueue());
  moment_.told_within = std::max(moment_.reaction, byWords() + rig_->silence());
  moment_.odometry_reset = false;
  if (driver_ran) moment_.snapshot = &rig_->robot().snapshot();
  sampleParameters();
  seeAnswers();
  seeTruth();
  seeInterruptions();
  for (const auto& invariant : invariants_) {
    if (auto wrong = invariant->look(moment_)) return fail(invariant->name(), invariant->sentence(), *wrong);
  }
  if (driver_ran) forgetMoves();
  if (!driver_ran || !moment_.judged) return;
  watchLosses();
  seeStops();
  seeArrivals();
}

void Player::seeArrivals() {
  constexpr double kElsewhere = 0.1;  // rad
  for (DriveIndex i = scenario_.layout.firstAxis(); i < places_.size(); ++i) {
    const double place = moment_.drives[i].position;
    if (!moment_.snapshot->drives[i].position_reached || std::fabs(place - places_[i]) < kElsewhere) continue;
    places_[i] = place;
    ++outcome_.arrived;
  }
}

void Player::forgetMoves() {
  for (AxisWish& axis : moment_.axes) axis.asked.clear();
}

bool Player::allOnline() {
  if (moment_.snapshot == nullptr) return false;
  const auto& drives = moment_.snapshot->drives;
  return std::all_of(drives.begin(), drives.end(), [](const auto& drive) { return drive.online; });
}

}  // namespace nord_driver::test
