#include <algorithm>
#include <cmath>

#include "campaign/axes.h"
#include "campaign/player.h"

namespace nord_driver::test {

using cycle::RequestKind;
using std::chrono::milliseconds;
using std::chrono::seconds;

// "drive": amount and extra are % of the full speed of a wheel, along and around; "turn": of the drive it names. "go" and
// "onward": a target and an increment of an axis, amount is % of its upper limit. Requests:
// extra is what the act says, of all drives or of one. "stall": amount ms. "respawn": the driver ends without a word and
// begins anew amount ms later.
const std::vector<Act>& userActs() {
  constexpr Range kNone{0, 0};
  constexpr auto act = [](const char* name, unsigned weight, Range span, Range amount, Range extra) {
    return Act{name, weight, "", Place::kDrive, Cuts::kNothing, span, amount, extra, nullptr, nullptr, false, false};
  };
  static const std::vector<Act> acts{
      act("drive", 8, {200, 2500}, {-45, 45}, {-45, 45}),
      act("turn", 8, {200, 2500}, {-90, 90}, kNone),
      act("go", 8, kNone, {-120, 120}, kNone),
      act("onward", 4, kNone, {-60, 60}, kNone),
      act("home", 2, kNone, kNone, kNone),
      act("enable", 8, kNone, {0, 3}, kNone),
      act("disable", 3, kNone, {0, 3}, kNone),
      act("quick_stop", 2, kNone, {0, 3}, kNone),
      act("acknowledge", 4, kNone, {0, 3}, kNone),
      act("select_set", 2, kNone, {1, 4}, kNone),
      act("reset_odometry", 1, kNone, kNone, kNone),
      act("clients", 4, {100, 2500}, {1, 6}, kNone),
      act("stall", 3, kNone, {10, 2000}, kNone),
      act("respawn", 2, kNone, {0, 1500}, kNone),
      act("end_node", 1, kNone, kNone, kNone),
      act("kill", 1, kNone, kNone, kNone),
  };
  return acts;
}

void Player::beginUser(const Event& event) {
  const std::string& act = event.act;
  const Instant until = now() + milliseconds{event.span};
  // Of all drives, as a rule.
  const DriveIndex drive = event.amount == 0 ? event.drive : cycle::kAllDrives;
  const Duration patience = seconds{3};
  if (act == "drive") {
    base_command_.until = until;
    base_command_.linear = 0.01 * event.amount * kFullSpeed * kWheelRadius;
    base_command_.angular = 0.01 * event.extra * kFullSpeed * kWheelRadius * 2.0 / kSeparation;
  } else if (act == "turn") {
    drive_commands_[event.drive].until = until;
    drive_commands_[event.drive].velocity = 0.01 * event.amount * kFullSpeed;
  } else if (act == "go" || act == "onward") {
    move(event.drive, {act == "onward", 0.01 * event.amount * kAxisLimit});
  } else if (act == "home") {
    submit(RequestKind::kHome, event.drive, kHomingTimeout + seconds{2});
  } else if (act == "enable") {
    submit(RequestKind::kEnable, drive, patience);
  } else if (act == "disable") {
    submit(RequestKind::kDisable, drive, patience);
  } else if (act == "quick_stop") {
    submit(RequestKind::kQuickStop, drive, patience);
  } else if (act == "acknowledge") {
    submit(RequestKind::kAcknowledge, drive, patience);
  } else if (act == "reset_odometry") {
    submit(RequestKind::kResetOdometry, cycle::kAllDrives, patience);
  } else if (act == "select_set") {
    cycle::Request request;
    request.kind = RequestKind::kSelectParameterSet;
    request.drive = event.drive;
    request.parameter_set = static_cast<std::uint8_t>(event.amount);
    request.patience = patience;
    submit(request);
  } else if (act == "clients") {
    for (int i = 0; i < event.amount; ++i) clients_.push_back({until, event.drive, 0});
  } else if (act == "stall") {
    disturbed_ = now();
    losses_.clear();
    pass(milliseconds{event.amount});
    disturbed_ = now();
  } else if (act == "respawn") {
    respawn(milliseconds{event.amount});
  } else if (act == "end_node") {
    endNode();
  } else if (act == "kill") {
    kill();
  } else {
    fail("Scenario", "", "there is no act " + act);
  }
}

// One topic for each; what is sent once counts.
void Player::move(DriveIndex drive, const AskedMove& move) {
  if (!moment_.axes[drive].is_axis) return;
  cycle::CyclePorts& ports = rig_->robot().ports();
  const bool sent = move.onward ? ports.commandIncrement(drive, move.value) : ports.commandPosition(drive, move.value);
  if (sent) moment_.axes[drive].asked.push_back(move);
}

// SIGTERM, SIGINT, an exception: ramp, OFF1, "ready to switch on" seen; then the exchange ends.
void Player::endNode() {
  submit(RequestKind::kShutDown, cycle::kAllDrives, seconds{12});
  const std::size_t call = calls_.size() - 1;
  for (const Instant end = now() + seconds{13}; goesOn() && now() < end && !calls_[call].answered;) {
    endOver(sinceStart());
    tick();
  }
  if (!goesOn()) return;
  if (!calls_[call].answered) return fail("EveryCallAnswered", "a node ends in shutdown_timeout", "it never ends");
  moment_.judged = false;
  rig_->robot().transport().close();
  disturbed_ = now();
  pass(seconds{1});
}

// SIGKILL: the time-outs of the drives act. One that has just begun over turning wheels has fed them with words that only
// look: it is given the cycles it needs to say more.
void Player::kill() {
  letItSayMore();
  moment_.judged = false;
  for (GroupWish& group : moment_.groups) group.asked = group.confirmed = false;
  disturbed_ = now();
  pass(seconds{2});
}

void Player::letItSayMore() {
  while (goesOn() && began_ && now() - *began_ < byWords()) tick();
}

// An exception nobody caught, and roslaunch starts the node again, maybe over wheels that turn: it knows nothing. Its
// transport is the one before, as the bus behind it is.
void Player::respawn(Duration gone) {
  letItSayMore();
  if (!goesOn()) return;
  for (GroupWish& group : moment_.groups) group.asked = group.confirmed = false;
  for (Call& call : calls_) call.answered = true;  // ended with the node
  first_open_ = calls_.size();
  disturbed_ = now();
  losses_.clear();
  pass(gone);
  disturbed_ = now();
  reborn_->beginAnew();
  rig_->robot().restartDriver();
  began_ = now();
  moment_.snapshot = nullptr;
  forgetMoves();
  for (auto& invariant : invariants_) invariant->driverBegan();
}

std::uint32_t Player::submit(RequestKind kind, DriveIndex drive, Duration patience) {
  cycle::Request request;
  request.kind = kind;
  request.drive = drive;
  request.patience = patience;
  return submit(request);
}

std::uint32_t Player::submit(cycle::Request request) {
  request.id = next_id_++;
  request.asked = now();
  if (!rig_->robot().ports().submit(request)) return 0;  // told at once: the queue is full
  Call call;
  call.request = request;
  call.submitted = request.asked;
  calls_.push_back(call);
  wish(request);
  return request.id;
}

void Player::wish(const cycle::Request& request) {
  const bool stops = request.kind == RequestKind::kDisable || request.kind == RequestKind::kQuickStop ||
                     request.kind == RequestKind::kShutDown;
  if (!stops && request.kind != RequestKind::kEnable) return;
  for (GroupWish& group : moment_.groups) {
    if (!concerns(request, group)) continue;
    if (!stops) {
      group.asked = true;
      group.interrupted = false;
    } else {
      group.asked = group.confirmed = false;
    }
  }
}

void Player::runClients() {
  for (Client& client : clients_) {
    if (now() >= client.until) continue;
    if (client.waits_for != 0) {
      const auto call = std::find_if(calls_.begin() + static_cast<std::ptrdiff_t>(first_open_), calls_.end(),
                                     [&](const Call& open) { return open.request.id == client.waits_for; });
      if (call != calls_.end() && !call->answered) continue;
    }
    askParameter(client);
  }
}

// Ramps: P102 of any set, read or written to the RAM.
void Player::askParameter(Client& client) {
  dice_ = dice_ * 1664525u + 1013904223u;
  cycle::Request request;
  const unsigned roll = dice_ >> 16;
  request.kind = roll % 4 == 0 ? RequestKind::kWriteParameter : RequestKind::kReadParameter;
  request.drive = client.drive;
  request.patience = milliseconds{500 + 500 * (roll % 5)};
  request.parameter.number = roll % 3 == 0 ? 105 : 102;
  request.parameter.shape = profile::ParameterShape::kPerSet;
  request.parameter.parameter_set = static_cast<std::uint8_t>(1 + roll / 8 % 4);
  if (request.kind == RequestKind::kWriteParameter) {
    request.parameter.number = 102;
    request.parameter.action = profile::ParameterAction::kWriteRam;
    request.parameter.raw = static_cast<std::int32_t>(100 + roll / 32 % 200);
  }
  client.waits_for = submit(request);
}

}  // namespace nord_driver::test
