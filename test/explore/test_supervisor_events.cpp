// Every order of requests, troubles and time-outs at the supervisor of a base with two wheels: what users ask is done
// or told to have failed, once, in time and truly.
#include <vector>

#include "cycle/supervisor.h"
#include "explore/group_members.h"

namespace nord_driver::explore {

NORD_EXPLORE_MEMBER(groupsOf, cycle::Supervisor, groups_)
NORD_EXPLORE_MEMBER(jobsOf, cycle::Supervisor, jobs_)
NORD_EXPLORE_MEMBER(autoEnableOf, cycle::Supervisor, auto_enable_)
NORD_EXPLORE_MEMBER(shuttingDownOf, cycle::Supervisor, shutting_down_)

namespace {

using cycle::RequestKind;
using cycle::Supervisor;
using drive::DriveGroup;
using drive::GroupPhase;

constexpr int kPatience = 4;  // ticks: longer than an enable takes, shorter than a ramp that ends in a quick stop
constexpr int kAtOnce = 2;    // requests under way
constexpr std::int16_t kRamp = 0x4000;

enum class What { kCycle, kEnable, kEnableEarly, kDisable, kQuickStop, kShutDown, kAcknowledge, kMove, kRest };

struct Event {
  What what = What::kCycle;
  WheelsCycle cycle;
};

std::vector<Event> alphabet() {
  std::vector<Event> events{
      {What::kEnable, {"request: enable"}},
      {What::kEnableEarly, {"request: enable, commands are listened to for one more tick"}},
      {What::kDisable, {"request: disable"}},
      {What::kQuickStop, {"request: quick stop of the left wheel"}},
      {What::kShutDown, {"request: shut down"}},
      {What::kAcknowledge, {"drives: acknowledge"}},
      {What::kMove, {"command: a velocity"}},
      {What::kRest, {"command: too old"}},
  };
  constexpr Trouble kNone = Trouble::kNone;
  events.push_back({What::kCycle, {"cycle", {kNone, kNone}}});
  events.push_back({What::kCycle, {"late cycle", {kNone, kNone}, 10}});
  events.push_back({What::kCycle, {"cycle, left: silent", {Trouble::kUnreached, kNone}}});
  events.push_back({What::kCycle, {"cycle, right: fault", {kNone, Trouble::kFault}}});
  events.push_back({What::kCycle, {"cycle, right: local control", {kNone, Trouble::kLocal}}});
  events.push_back({What::kCycle, {"cycle, left: stuck", {Trouble::kStuck, kNone}}});
  events.push_back({What::kCycle, {"cycle, both: ramp no lower", {Trouble::kEndless, Trouble::kEndless}}});
  return events;
}

cycle::CycleConfig cycleConfig() {
  cycle::CycleConfig config;
  config.shutdown_timeout = kShutdownTimeout * kTick;
  for (const char* name : {"left", "right"}) {
    cycle::DriveSetup setup;
    setup.name = name;
    config.drives.push_back(setup);
  }
  config.base = cycle::BaseConfig{};
  config.base->left = {0};
  config.base->right = {1};
  return config;
}

class SupervisorEvents {
 public:
  using Jobs = std::decay_t<decltype(jobsOf(std::declval<Supervisor&>()))>;

  /// A request nobody has answered yet.
  struct Asked {
    bool waits = false;
    RequestKind kind = RequestKind::kEnable;
    std::uint8_t age = 0;  // ticks
  };

  /// The group is kept from one event to the next beside the one supervisor of the model, whose drives it points to.
  struct World {
    TwoWheels wheels;
    DriveGroup group;
    Jobs jobs;
    bool auto_enable = false, shutting_down = false;
    std::array<Asked, kAtOnce> asked{};  // their id: the place, from 1 on
    bool moves = false;                  // a velocity command is there
    std::uint8_t to_hear = 0;            // ticks
    bool allowed = false;                // an enable was answered with success, and nothing was asked against it since
  };

  explicit SupervisorEvents(bool auto_enable)
      : auto_enable_(auto_enable),
        drives_{drive::Drive{driveConfig()}, drive::Drive{driveConfig()}},
        supervisor_{cycleConfig(), drives_, auto_enable},
        events_(alphabet()) {}

  World initial() const {
    World world{{}, groupsOf(supervisor_).front().group, {}};
    for (drive::FakeInverter& inverter : world.wheels.inverters) inverter.ramp = kRamp;
    world.auto_enable = auto_enable_;
    world.allowed = auto_enable_;  // once
    return world;
  }
  std::size_t events() const { return events_.size(); }
  std::string name(std::size_t event) const { return events_[event].cycle.name; }

  bool apply(World& world, std::size_t number, Verdict& verdict) const {
    const Event& event = events_[number];
    switch (event.what) {
      case What::kCycle:
        cycle(world, event.cycle, verdict);
        return true;
      case What::kEnable:
      case What::kEnableEarly:
        if (event.what == What::kEnableEarly) world.to_hear = 1;
        return ask(world, RequestKind::kEnable, cycle::kAllDrives, verdict);
      case What::kDisable:
        return ask(world, RequestKind::kDisable, cycle::kAllDrives, verdict);
      case What::kQuickStop:
        return ask(world, RequestKind::kQuickStop, 0, verdict);
      case What::kShutDown:
        return ask(world, RequestKind::kShutDown, cycle::kAllDrives, verdict);
      case What::kAcknowledge:
        for (std::size_t i = 0; i < 2; ++i) {
          world.wheels.drives[i].requestAcknowledge(world.wheels.now, 1);
          if (!world.wheels.drives[i].report().fault_latched) world.wheels.watches[i].acknowledged();
        }
        return true;
      case What::kMove:
      case What::kRest:
        world.moves = event.what == What::kMove;
        return true;
    }
    return false;
  }

  void describe(const World& world, Key& key) const {
    world.wheels.describe(key);
    describeGroup(world.group, world.wheels.now, key);
    key.add(world.auto_enable).add(world.shutting_down).add(world.moves).add(world.to_hear).add(world.allowed);
    // The places of the requests are only names.
    int waiting = 0;
    for (const Asked& asked : world.asked) waiting += asked.waits ? 1 : 0;
    key.add(static_cast<std::uint8_t>(waiting));
    for (std::size_t i = 0; i < world.jobs.size(); ++i) {
      const auto& job = world.jobs[i];
      // Of nobody: the enabling by auto_enable.
      const Asked asked = job.request.id == 0 ? Asked{} : world.asked.at(job.request.id - 1);
      key.add(asked.waits).add(asked.kind).add(asked.age).add(job.request.kind).add(job.begun);
      key.add(ticks(world.wheels.now, job.deadline, kTick, kPatience));
      for (const drive::Drive& drive : world.wheels.drives) {
        key.add(job.enabled_at && drive.lastHeard() > *job.enabled_at);
      }
    }
  }

  // With inverters that follow and no further request: everything asked for is answered, and a disable is done.
  void judge(const World& found, Verdict& verdict) const {
    World world = found;
    Verdict of_the_way;
    const WheelsCycle plain{"cycle", {}};
    world.wheels.repair();
    world.moves = false;
    for (int i = 0; i <= kPatience + 1; ++i) {
      bool waits = false;
      for (const Asked& asked : world.asked) waits = waits || asked.waits;
      if (!waits) break;
      cycle(world, plain, of_the_way);
    }
    const bool taken = ask(world, RequestKind::kDisable, cycle::kAllDrives, of_the_way);
    for (int i = 0; i < 4 * kShutdownTimeout && (i < 2 || !isReady(world)); ++i) cycle(world, plain, of_the_way);
    verdict.require(taken && isReady(world), "no way to rest");
    verdict.require(of_the_way.holds(), of_the_way.problem().c_str());
  }

 private:
  static bool isReady(const World& world) {
    if (!world.group.settled() || world.jobs.size() != 0) return false;
    for (const drive::Drive& drive : world.wheels.drives) {
      if ((drive.report().output.control_word & 0x3FFFu) != 0x047E) return false;
      if (drive.report().state != profile::DriveState::kReadyToSwitchOn) return false;
    }
    return true;
  }

  cycle::CommandState commands(const World& world) const {
    cycle::CommandState state;
    if (world.moves) state.moving = "cmd_vel says move";
    state.to_hear = world.to_hear * kTick;
    state.quiet = !world.moves && world.to_hear == 0;
    return state;
  }

  /// Lends the supervisor what the world keeps, and takes it back.
  template <typename Action>
  void supervise(World& world, Action action) const {
    for (std::size_t i = 0; i < 2; ++i) drives_[i] = world.wheels.drives[i];
    groupsOf(supervisor_).front().group = world.group;
    membersOf(groupsOf(supervisor_).front().group) = {&drives_[0], &drives_[1]};
    jobsOf(supervisor_) = world.jobs;
    autoEnableOf(supervisor_) = world.auto_enable;
    shuttingDownOf(supervisor_) = world.shutting_down;
    action();
    for (std::size_t i = 0; i < 2; ++i) world.wheels.drives[i] = drives_[i];
    world.group = groupsOf(supervisor_).front().group;
    world.jobs = jobsOf(supervisor_);
    world.auto_enable = autoEnableOf(supervisor_);
    world.shutting_down = shuttingDownOf(supervisor_);
  }

  static bool isUnderWay(const DriveGroup& group) {
    return group.report().phase == GroupPhase::kEnabling || group.report().phase == GroupPhase::kEnabled;
  }

  /// The watches hear of an enable that was accepted, now or of one that had waited.
  void noteEnable(World& world, bool before, Verdict& verdict) const {
    if (before || !isUnderWay(world.group)) return;
    for (std::size_t i = 0; i < 2; ++i) {
      world.wheels.watches[i].enableAccepted(world.wheels.drives[i].report(), verdict);
    }
  }

  bool ask(World& world, RequestKind kind, DriveIndex drive, Verdict& verdict) const {
    std::size_t place = 0;
    while (place < kAtOnce && world.asked[place].waits) ++place;
    if (place == kAtOnce) return false;
    cycle::Request request;
    request.id = static_cast<std::uint32_t>(place + 1);
    request.kind = kind;
    request.drive = drive;
    request.patience = kPatience * kTick;
    world.asked[place] = {true, kind, 0};
    if (kind != RequestKind::kEnable) world.allowed = false;
    if (kind == RequestKind::kQuickStop) {
      for (DriveWatch& watch : world.wheels.watches) watch.quickStopAsked();
    }
    const bool before = isUnderWay(world.group);
    supervise(world, [&] {
      supervisor_.handleRequest(request, commands(world), world.wheels.now);
      takeCompletions(world, verdict);
    });
    if (kind == RequestKind::kEnable) {
      verdict.require(before || !isUnderWay(world.group) || !world.moves, "enabled under a command that moves");
      verdict.require(before || !isUnderWay(world.group) || !world.shutting_down, "enabled while the node ends");
      noteEnable(world, before, verdict);
    }
    return true;
  }

  void takeCompletions(World& world, Verdict& verdict) const {
    while (const auto completion = supervisor_.pollCompletion()) {
      const bool known = completion->id >= 1 && completion->id <= kAtOnce && world.asked[completion->id - 1].waits;
      verdict.require(known, "an answer to a request that has its answer");
      if (!known) continue;
      Asked& asked = world.asked[completion->id - 1];
      asked.waits = false;
      if (!completion->success) continue;
      if (asked.kind == RequestKind::kEnable) {
        verdict.require(supervisor_.base()->commandAllowed(), "\"enabled\" was answered, and it is not so");
        world.allowed = true;
        continue;
      }
      for (const drive::Drive& drive : drives_) {
        // An enable that was asked for after it may have begun since.
        const bool disabled = drive.report().online && drive.isAtRest();
        verdict.require(disabled || isUnderWay(*supervisor_.base()), "\"disabled\" was answered, and it is not so");
      }
    }
  }

  // In the order of the bus cycle.
  void cycle(World& world, const WheelsCycle& cycle, Verdict& verdict) const {
    world.group.commandIsFresh(world.moves, world.wheels.now);
    const bool follows = world.group.commandAllowed() && world.moves;
    world.group.setpointIsZero(!follows);
    world.wheels.exchange(cycle, follows ? 3.0 : 0.0, verdict);
    world.to_hear = static_cast<std::uint8_t>(std::max(world.to_hear - cycle.ticks, 0));
    std::array<bool, kAtOnce> overdue{};
    for (std::size_t i = 0; i < kAtOnce; ++i) {
      overdue[i] = world.asked[i].age >= kPatience;
      world.asked[i].age = static_cast<std::uint8_t>(std::min(world.asked[i].age + cycle.ticks, kPatience));
    }
    const bool before = isUnderWay(world.group);
    supervise(world, [&] {
      supervisor_.update(commands(world), world.wheels.now);
      takeCompletions(world, verdict);
    });
    noteEnable(world, before && isUnderWay(world.group), verdict);
    world.wheels.check(verdict);
    for (std::size_t i = 0; i < kAtOnce; ++i) {
      verdict.require(!world.asked[i].waits || !overdue[i],
                      "a request has no answer a cycle after its patience is over");
    }
    checkAllowed(world, verdict);
  }

  static void checkAllowed(World& world, Verdict& verdict) {
    bool enable_waits = false;
    for (const Asked& asked : world.asked)
      enable_waits = enable_waits || (asked.waits && asked.kind == RequestKind::kEnable);
    verdict.require(!world.group.commandAllowed() || world.allowed || enable_waits,
                    "commands are followed, and nobody has enabled or was told so");
    verdict.require(!world.group.commandAllowed() || world.wheels.bothRun(),
                    "commands are followed that no wheel may follow");
    if (!world.group.commandAllowed() && !world.auto_enable && !isUnderWay(world.group)) world.allowed = false;
  }

  bool auto_enable_;
  mutable std::vector<drive::Drive> drives_;
  mutable Supervisor supervisor_;
  std::vector<Event> events_;
};

TEST(SupervisorEventsTest, EveryOrderKeepsTheRules) {
  exploreAll(SupervisorEvents{false}, "Supervisor of a base of two", 1000);
}

TEST(SupervisorEventsTest, EveryOrderKeepsTheRulesWithAutoEnable) {
  exploreAll(SupervisorEvents{true}, "Supervisor of a base of two, auto_enable", 1000);
}

}  // namespace
}  // namespace nord_driver::explore
