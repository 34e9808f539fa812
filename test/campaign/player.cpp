#include "campaign/player.h"

#include <algorithm>

#include "campaign/wheels.h"

namespace nord_driver::test {

using std::chrono::milliseconds;

namespace {

constexpr Duration kTick = milliseconds{10};
// The longest time-out there is, of an explicit message (500 ms), which begins with a request that may come later.
constexpr Duration kLossShows = milliseconds{600};
constexpr Duration kCalm = milliseconds{1000};
// From half the full speed of a wheel to the same backward, along or around (wheels.h).
constexpr double kFullWay = kWheelRadius * Player::kFullSpeed;  // m/s
const double kLongestBaseRamp = std::max(kFullWay / kLinearLimit, 2.0 * kFullWay / kSeparation / kAngularLimit);
constexpr double kChangesOfAcceleration = 3.0 * kTimeToLimit;  // s: to none, to its limit, and to none again
// From 90 % to the same backward.
constexpr double kLongestJointRamp = 1.8 * Player::kFullSpeed / kJointLimit;

// A wheel of a base has no slowest one: along and around may make up for each other. Nor has what limits its jerk, which
// lets go of one acceleration and takes up another one.
SetpointRamp setpointRamp(const Layout& layout, bool wheel) {
  const double of_wheel = (kLinearLimit + kAngularLimit * kSeparation / 2.0) / kWheelRadius;
  const double fastest = Player::kHertzPerSpeed * (wheel ? of_wheel : kJointLimit);
  if (!wheel && !layout.limitsJerk()) return {fastest, fastest, {}};
  const double longest = wheel ? kLongestBaseRamp : kLongestJointRamp;
  return {SetpointRamp::kAtOnce, fastest,
          nord_driver::seconds(longest + (layout.limitsJerk() ? kChangesOfAcceleration : 0.0))};
}

}  // namespace

const Act* findAct(const CampaignBus& bus, const std::string& name) {
  for (const auto* acts : {&userActs(), &driveActs(), &bus.acts()}) {
    for (const Act& act : *acts) {
      if (name == act.name) return &act;
    }
  }
  return nullptr;
}

Player::Player(const Scenario& scenario, const CampaignBus& bus, const TransportWrap& wrap)
    : scenario_(scenario), bus_(bus), rig_(makeRig(wrap)), invariants_(allInvariants()), dice_(scenario.seed * 2 + 1) {
  std::stable_sort(scenario_.events.begin(), scenario_.events.end(),
                   [](const Event& a, const Event& b) { return a.at < b.at; });
  const std::size_t drives = scenario.layout.drives();
  drive_commands_.resize(drives);
  moment_.drives.resize(drives);
  moment_.wanted.resize(drives);
  moment_.renewed.resize(drives);
  moment_.cut.resize(drives);
  moment_.axes.resize(drives);
  places_.resize(drives);
  moment_.calls = &calls_;
  moment_.period = rig_->robot().config().period();
  moment_.full_wheel_speed = kFullSpeed;
  moment_.reads_scale = rig_->readsScaling();
  moment_.setpoint_ramps.resize(drives);
  if (scenario.layout.limitsAcceleration()) {
    for (DriveIndex i = 0; i < scenario.layout.firstAxis(); ++i) {
      moment_.setpoint_ramps[i] = setpointRamp(scenario.layout, i < scenario.layout.wheels);
    }
  }
  if (scenario.layout.limitsJerk() && scenario.layout.wheels != 0) moment_.between.resize(drives);
  if (scenario.layout.wheels != 0) {
    GroupWish base;
    base.is_base = true;
    for (DriveIndex i = 0; i < scenario.layout.wheels; ++i) base.members.push_back(i);
    moment_.groups.push_back(base);
  }
  for (DriveIndex i = scenario.layout.wheels; i < drives; ++i) {
    GroupWish single;
    single.members.push_back(i);
    single.is_axis = moment_.axes[i].is_axis = i >= scenario.layout.firstAxis();
    moment_.groups.push_back(single);
  }
}

std::unique_ptr<CampaignRig> Player::makeRig(const TransportWrap& wrap) {
  return bus_.make(scenario_.layout, [this, &wrap](std::unique_ptr<Transport> inner) {
    auto reborn = std::make_unique<RebornTransport>(wrap ? wrap(std::move(inner)) : std::move(inner));
    reborn_ = reborn.get();
    return reborn;
  });
}

void Player::presetSlowest(sim::DriveUnit& unit) {
  for (unsigned set = 0; set < 4; ++set) unit.parameters().preset(104, set, 0, kSlowest);
}

Outcome Player::play() {
  rig_->robot().step();  // the bus is made with the first cycle
  start_ = now();
  rig_->setUp();
  if (scenario_.layout.hasSlowest() && rig_->readsParameters()) {
    for (DriveIndex i = 0; i < scenario_.layout.firstAxis(); ++i) presetSlowest(rig_->unit(i));
    if (rig_->twin() != nullptr && scenario_.layout.firstAxis() != 0) presetSlowest(*rig_->twin());
  }
  for (DriveIndex i = 0; i < moment_.drives.size(); ++i) {
    // Each drive and set has a value of its own: an answer to somebody else's question shows.
    for (unsigned set = 0; set < 4; ++set) {
      rig_->unit(i).parameters().preset(102, set, 0, static_cast<std::int32_t>(150 + 10 * i + set));
      // 50, 50, 40 and 60 Hz.
      if (rig_->readsScaling() && set >= 2) rig_->unit(i).parameters().preset(105, set, 0, set == 2 ? 400 : 600);
    }
  }
  playEvents();
  if (goesOn() && moment_.judged) judgeRecovery();
  judgeWire();
  for (const auto& invariant : invariants_) {
    if (const auto* motion = dynamic_cast<const TurnsOnlyAsCommanded*>(invariant.get())) {
      outcome_.worst_stop = motion->worstStop();
    }
  }
  return outcome_;
}

void Player::playEvents() {
  while (goesOn() && moment_.judged && sinceStart() < scenario_.length) {
    const unsigned at = sinceStart();
    endOver(at);
    while (next_ < scenario_.events.size() && scenario_.events[next_].at <= at && goesOn() && moment_.judged) {
      begin(scenario_.events[next_++]);
    }
    if (goesOn() && moment_.judged) tick();
  }
  while (goesOn() && moment_.judged && mustLast(sinceStart())) tick();
  endAll();
}

// Nobody exchanges a drive within some milliseconds.
bool Player::mustLast(unsigned at) const {
  return std::any_of(active_.begin(), active_.end(), [at](const Active& active) {
    return at < active.event.at + std::min(active.event.span, static_cast<unsigned>(active.act->span.least));
  });
}

// One bus cycle, as everybody asks for something at the same time.
void Player::tick() {
  command();
  runClients();
  const Instant began = now();
  rig_->robot().step();
  look(began, true);
}

// Held up, or ended: time passes, and what the wheels do is looked at all the same.
void Player::pass(Duration span) {
  for (const Instant end = now() + span; now() < end && goesOn();) {
    const Instant began = now();
    rig_->passWithoutTheDriver(kTick);
    look(began, false);
  }
}

// --- what happens

bool Player::samePlace(const Active& active, const Event& event) {
  switch (active.act->place) {
    case Place::kBus:
      return true;
    case Place::kStation:
      return &rig_->unit(active.event.drive).module() == &rig_->unit(event.drive).module();
    case Place::kDrive:
      return active.event.drive == event.drive;
  }
  return true;
}

bool Player::excluded(const Event& event, const Act& act) {
  return std::any_of(active_.begin(), active_.end(), [&](const Active& active) {
    return std::string{active.act->slot} == act.slot && samePlace(active, event);
  });
}

void Player::begin(const Event& event) {
  const Act* const act = findAct(bus_, event.act);
  if (act == nullptr) return fail("Scenario", "", "there is no act " + event.act);
  if (act->begin == nullptr) return beginUser(event);
  if (excluded(event, *act) || (act->applies != nullptr && !act->applies(*rig_, event))) return;
  // A loss has to be counted where nothing else keeps telegrams from being sent.
  const bool calm = !disturbed_ || now() - *disturbed_ > kCalm;
  losses_.clear();
  const bool unknown = rig_->answersAreRepeated() && event.act == "lose_answers";
  if (act->counted && !unknown && calm && active_.empty() && allOnline())
    losses_.push_back({now() + kLossShows, counted(), act->name});
  act->begin(*rig_, event);
  if (act->disturbs) disturbed_ = now();
  if (event.span != 0 && act->end != nullptr) active_.push_back({event, act});
}

void Player::endOver(unsigned at) {
  for (std::size_t i = 0; i < active_.size();) {
    if (active_[i].event.at + active_[i].event.span > at) {
      ++i;
      continue;
    }
    active_[i].act->end(*rig_, active_[i].event);
    if (active_[i].act->disturbs) disturbed_ = now();
    active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

void Player::endAll() {
  for (const Active& active : active_) active.act->end(*rig_, active.event);
  if (!active_.empty()) disturbed_ = now();
  rig_->endLosses();
  active_.clear();
  clients_.clear();
  base_command_.until = {};
  for (Command& command : drive_commands_) command.until = {};
}

void Player::command() {
  const Instant at = now();
  if (scenario_.layout.wheels != 0 && at < base_command_.until) {
    rig_->robot().ports().commandBase({{base_command_.linear, base_command_.angular}, at, true});
    base_command_.given = at;
    base_command_.ever = true;
  }
  for (DriveIndex i = scenario_.layout.wheels; i < scenario_.layout.firstAxis(); ++i) {
    Command& command = drive_commands_[i];
    if (at >= command.until) continue;
    rig_->robot().ports().commandDrive(i, {command.velocity, at, true});
    command.given = at;
    command.ever = true;
  }
}

}  // namespace nord_driver::test
