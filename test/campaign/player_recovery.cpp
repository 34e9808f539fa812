#include <algorithm>
#include <cmath>
#include <sstream>

#include "campaign/axes.h"
#include "campaign/player.h"
#include "sim/rule_counts.h"

namespace nord_driver::test {

using cycle::RequestKind;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr double kNextTarget = 1.5;  // rad
constexpr double kStands = 0.1;      // Hz
constexpr int kWordsPass = 5;  // cycles, until those of a module that was in its time-out have reached its inverters

}  // namespace

bool Player::ask(RequestKind kind, const char* expectation) {
  const std::uint32_t id = submit(kind, cycle::kAllDrives, seconds{3});
  for (const Instant end = now() + seconds{4}; goesOn() && now() < end;) {
    tick();
    for (const cycle::Completion& answer : moment_.answers) {
      if (answer.id != id) continue;
      if (answer.success) return true;
      fail("BackInService", "back in service within 2 s of the cause's end, plus what the protocol demands",
           std::string{expectation} + ": " + answer.message.c_str());
      return false;
    }
  }
  return false;
}

// A station that answers too late breaks the rules of its bus itself, and so do two with one address.
void Player::judgeWire() {
  bool undisturbed = true;
  for (const Event& event : scenario_.events) {
    if (event.act == "late_answers" || event.act == "twin") return;
    const Act* const act = findAct(bus_, event.act);
    const bool holds = event.act == "stall" || event.act == "respawn" || event.act == "kill" || event.act == "end_node";
    undisturbed = undisturbed && act != nullptr && !act->disturbs && !holds;
  }
  const std::string report = rig_->referee(undisturbed);
  if (report == sim::kNoRuleBroken) return;
  fail("RulesOfTheBusKept", "what the standard of the bus demands of a master (the rules in src/sim)", report);
}

void Player::judgeAxes(Instant until) {
  const auto arrived = [this] {
    for (DriveIndex i = scenario_.layout.firstAxis(); i < moment_.axes.size(); ++i) {
      if (!moment_.snapshot->drives[i].position_reached) return false;
    }
    return true;
  };
  while (goesOn() && !arrived()) {
    if (now() >= until)
      return fail("BackInService", "the inverter travels there and holds it (Positions)", "never there");
    tick();
  }
}

// What happened last may show only when the time-outs have passed: until then, that all answer says nothing.
void Player::judgeRecovery() {
  const Instant ended = now();
  const Instant shown = ended + byTimeouts();
  Instant back = ended;
  while (goesOn() && (!allOnline() || now() < shown)) {
    const bool missing = !allOnline();
    tick();
    if (missing) back = now();
    if (!goesOn() || allOnline()) continue;
    if (now() - ended <= rig_->backWithin()) continue;
    std::ostringstream out;
    for (const cycle::DriveSnapshot& drive : moment_.snapshot->drives) {
      if (!drive.online) out << drive.text.c_str() << "; ";
    }
    return fail("BackInService", "back in service within 2 s of the cause's end, plus what the protocol demands",
                "not all drives answer: " + out.str() + moment_.snapshot->bus_text.c_str());
  }
  outcome_.recovery = toSeconds(back - ended);
  // The last command is too old, P105 of who came back is read, and what was under way is over.
  const auto complete = [this] {
    const auto& drives = moment_.snapshot->drives;
    return std::all_of(drives.begin(), drives.end(), [this](const cycle::DriveSnapshot& drive) {
      const auto& known = drive.device.max_frequency;
      const bool scaled = std::all_of(known.begin(), known.end(), [](const auto& value) { return value.has_value(); });
      return drive.device.complete && (scaled || !rig_->readsParameters());
    });
  };
  const auto open = [this] { return first_open_ < calls_.size(); };
  const Instant quiet = now() + milliseconds{600};
  const Instant give_up = now() + nord_driver::seconds(13.0 * scenario_.layout.slowness());
  while (goesOn() && (now() < quiet || !complete() || open())) {
    tick();
    if (now() < give_up) continue;
    return fail("BackInService", "P105 of every drive is read again", "not all parameters are read");
  }
  // As long as one inverter behind it has a fault a module stays in its time-out (BU 0220 4.2.3.2), and lets no other word
  // through: none of the others confirms anything before.
  const bool held = scenario_.layout.one_module;
  if (held) submit(RequestKind::kAcknowledge, cycle::kAllDrives, seconds{1});
  for (const Instant answered = now() + seconds{2}; held && goesOn() && now() < answered;) tick();
  if (!goesOn() || !ask(RequestKind::kDisable, "it cannot be disabled")) return;
  // Who was told to coast turns on for a while, and an axis that does so leaves its place.
  const auto coasts = [](const DriveTruth& drive) { return std::fabs(drive.rotor) > kStands; };
  const Instant at_rest = now() + seconds{20};
  while (goesOn() && now() < at_rest && std::any_of(moment_.drives.begin(), moment_.drives.end(), coasts)) tick();
  if (!ask(RequestKind::kAcknowledge, "faults cannot be acknowledged")) return;
  for (int i = 0; i < kWordsPass && held; ++i) tick();
  if (!ask(RequestKind::kEnable, "it cannot be enabled")) return;
  // Up to a slowest speed, along the limits of a base.
  const bool bounded = scenario_.layout.bounds() != 0;
  base_command_.until = now() + milliseconds{bounded ? 1500 : 300};
  base_command_.linear = 0.5 * kFullSpeed * kWheelRadius;
  base_command_.angular = 0.0;
  for (Command& command : drive_commands_) {
    command.until = base_command_.until;
    command.velocity = 0.5 * kFullSpeed;
  }
  for (DriveIndex i = scenario_.layout.firstAxis(); i < moment_.axes.size(); ++i) {
    const double from = std::clamp(moment_.drives[i].position, -kAxisLimit, kAxisLimit);
    move(i, {false, from > 0.0 ? from - kNextTarget : from + kNextTarget});
  }
  std::vector<bool> turned(moment_.drives.size());
  while (goesOn() && now() < base_command_.until) {
    tick();
    for (DriveIndex i = 0; i < turned.size(); ++i) {
      if (std::fabs(moment_.drives[i].frequency) > 1.0) turned[i] = true;
    }
  }
  for (DriveIndex i = 0; i < turned.size() && goesOn(); ++i) {
    if (turned[i]) continue;
    fail("BackInService", "back in service", "drive " + std::to_string(i) + " does not turn");
  }
  judgeAxes(now() + seconds{10});
  if (goesOn()) ask(RequestKind::kDisable, "it cannot be disabled");
}

}  // namespace nord_driver::test
