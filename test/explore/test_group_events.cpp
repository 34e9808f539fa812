// Every order of troubles, requests and time-outs at two drives that stand or fall together.
#include <vector>

#include "explore/group_members.h"

namespace nord_driver::explore {
namespace {

using drive::DriveGroup;
using drive::GroupPhase;

enum class Request { kEnable, kDisable, kQuickStop, kAcknowledge, kCommand, kNoCommand };

const std::vector<std::pair<Request, const char*>> kRequests{
    {Request::kEnable, "request: enable"},        {Request::kDisable, "request: disable"},
    {Request::kQuickStop, "request: quick stop"}, {Request::kAcknowledge, "request: acknowledge"},
    {Request::kCommand, "command: a velocity"},   {Request::kNoCommand, "command: too old"},
};

class GroupEvents {
 public:
  explicit GroupEvents(const drive::StopWays& ways) : ways_(ways), cycles_(wheelsCycles()) {}

  struct World {
    explicit World(const drive::StopWays& ways) : group{{&wheels.drives[0], &wheels.drives[1]}, groupConfig(ways)} {}
    // The group points to the drives beside it.
    World(const World& other) : wheels(other.wheels), group(other.group), fresh(other.fresh), in_phase(other.in_phase) {
      membersOf(group) = {&wheels.drives[0], &wheels.drives[1]};
    }
    World& operator=(const World&) = delete;

    TwoWheels wheels;
    DriveGroup group;
    bool fresh = false;         // a velocity command is there
    std::uint8_t in_phase = 0;  // cycles in a phase that must end
  };

  World initial() const { return World{ways_}; }
  std::size_t events() const { return kRequests.size() + cycles_.size(); }
  std::string name(std::size_t event) const {
    return event < kRequests.size() ? kRequests[event].second : cycles_[event - kRequests.size()].name;
  }

  bool apply(World& world, std::size_t event, Verdict& verdict) const {
    if (event >= kRequests.size()) {
      cycle(world, cycles_[event - kRequests.size()], verdict);
    } else {
      ask(world, kRequests[event].first, verdict);
    }
    return true;
  }

  void describe(const World& world, Key& key) const {
    world.wheels.describe(key);
    describeGroup(world.group, world.wheels.now, key);
    key.add(world.fresh).add(world.in_phase);
  }

  // With inverters that follow, from everywhere: both to rest, and up again when that is asked for.
  void judge(const World& found, Verdict& verdict) const {
    World world = found;
    Verdict of_the_way;
    const WheelsCycle plain = cycles_.front();
    world.wheels.repair();
    world.group.requestDisable(world.wheels.now);
    for (int i = 0; i < 4 * kShutdownTimeout && (i < 2 || !isReady(world)); ++i) cycle(world, plain, of_the_way);
    verdict.require(isReady(world), "no way to rest: not settled, or not with the idle word at \"ready to switch on\"");
    ask(world, Request::kAcknowledge, of_the_way);
    ask(world, Request::kEnable, of_the_way);
    for (int i = 0; i < kEnableTimeout + 1 && !world.group.commandAllowed(); ++i) cycle(world, plain, of_the_way);
    verdict.require(world.group.commandAllowed(), "no way up again from rest");
    verdict.require(of_the_way.holds(), "a rule is broken on the way to rest and up again");
  }

 private:
  static bool isReady(const World& world) {
    if (!world.group.settled()) return false;
    for (const drive::Drive& drive : world.wheels.drives) {
      if ((drive.report().output.control_word & 0x3FFFu) != 0x047E) return false;
      if (drive.report().state != profile::DriveState::kReadyToSwitchOn) return false;
    }
    return true;
  }

  void ask(World& world, Request request, Verdict& verdict) const {
    TwoWheels& wheels = world.wheels;
    switch (request) {
      case Request::kEnable: {
        const bool running = world.group.report().phase != GroupPhase::kDisabled;
        if (!world.group.requestEnable(wheels.now).accepted() || running) return;
        for (std::size_t i = 0; i < 2; ++i) wheels.watches[i].enableAccepted(wheels.drives[i].report(), verdict);
        return;
      }
      case Request::kDisable:
        return world.group.requestDisable(wheels.now);
      case Request::kQuickStop:
        world.group.requestQuickStop(wheels.now);
        for (DriveWatch& watch : wheels.watches) watch.quickStopAsked();
        return;
      case Request::kAcknowledge:
        for (std::size_t i = 0; i < 2; ++i) {
          wheels.drives[i].requestAcknowledge(wheels.now, 1);
          if (!wheels.drives[i].report().fault_latched) wheels.watches[i].acknowledged();
        }
        return;
      case Request::kCommand:
      case Request::kNoCommand:
        world.fresh = request == Request::kCommand;
        return;
    }
  }

  // In the order of the bus cycle.
  void cycle(World& world, const WheelsCycle& cycle, Verdict& verdict) const {
    DriveGroup& group = world.group;
    group.commandIsFresh(world.fresh, world.wheels.now);
    const bool ramps = group.wantsZeroRamp() && cycle.ramps;
    const bool moves = (group.commandAllowed() && world.fresh) || ramps;
    group.setpointIsZero(!moves);
    const GroupPhase before = group.report().phase;
    world.wheels.exchange(cycle, moves ? 3.0 : 0.0, verdict);
    group.update(world.wheels.now);
    world.wheels.check(verdict);
    verdict.require(!group.commandAllowed() || world.wheels.bothRun(),
                    "commands are followed that no wheel may follow");
    verdict.require(group.report().phase != GroupPhase::kDisabled || !world.wheels.oneRuns(),
                    "the group counts as disabled while a wheel runs");
    checkPhase(world, before, verdict);
  }

  // A phase that leads somewhere ends by itself, whatever the inverters do. A quick stop ends when they have stopped:
  // under local control nothing else is left to do.
  static void checkPhase(World& world, GroupPhase before, Verdict& verdict) {
    const GroupPhase phase = world.group.report().phase;
    bool ramps = false;
    for (const drive::Drive& drive : world.wheels.drives) {
      ramps = ramps || drive.report().phase == drive::Phase::kStopping;
    }
    const bool passes = phase == GroupPhase::kEnabling || phase == GroupPhase::kRampingDown ||
                        phase == GroupPhase::kHalting || (phase == GroupPhase::kStopping && ramps);
    world.in_phase = passes && phase == before ? static_cast<std::uint8_t>(world.in_phase + 1) : std::uint8_t{0};
    verdict.require(world.in_phase <= kShutdownTimeout + kDriveTimeout + 1, "a phase of the group has no end");
  }

  drive::StopWays ways_;
  std::vector<WheelsCycle> cycles_;
};

TEST(GroupEventsTest, EveryOrderKeepsTheRules) {
  exploreAll(GroupEvents{{}}, "DriveGroup of two", 1000);
}

TEST(GroupEventsTest, EveryOrderKeepsTheRulesWithQuickStops) {
  drive::StopWays ways;
  ways.command_timeout = ways.disable = ways.drive_stopped = drive::StopWay::kQuickStop;
  exploreAll(GroupEvents{ways}, "DriveGroup of two that stops by OFF3", 1000);
}

}  // namespace
}  // namespace nord_driver::explore
