// Every order of requests, troubles and time-outs at what acknowledges faults and switches parameter sets: each request is
// answered once, in time and truly, nothing moves by it, no fault is acknowledged and no set switched unasked.
//
// In two parts, since all of it at both drives are more states than can be kept: every request and trouble at one of them,
// and faults and their acknowledging at both. Left out: switching sets at two drives at a time, and more than two requests
// that wait.
#include <string_view>
#include <vector>

#include "cycle/standstill_requests.h"
#include "explore/two_wheels.h"

namespace nord_driver::explore {

NORD_EXPLORE_MEMBER(standstillJobsOf, cycle::StandstillRequests, jobs_)
NORD_EXPLORE_MEMBER(standstillTokenOf, cycle::StandstillRequests, last_token_)

namespace {

using cycle::RequestKind;
using cycle::StandstillRequests;
using drive::Phase;

constexpr int kLongPatience = 8;  // ticks: an acknowledging whose telegrams are all answered takes six
constexpr int kShortPatience = 2;
constexpr int kAtOnce = 3;  // requests under way, at most

enum class What { kCycle, kAcknowledge, kSelectSet, kEnable, kQuickStop };

struct Event {
  What what = What::kCycle;
  WheelsCycle cycle;
  DriveIndex drive = 0;
  std::uint8_t set = 0;
  int patience = kLongPatience;
};

constexpr Trouble kNone = Trouble::kNone;

// The right one is there, and nothing comes of it.
std::vector<Event> ofOneDrive() {
  return {{What::kAcknowledge, {"request: acknowledge left"}},
          {What::kSelectSet, {"request: left to parameter set 2"}, 0, 2},
          {What::kSelectSet, {"request: left to parameter set 1, little patience"}, 0, 1, kShortPatience},
          {What::kEnable, {"left: enable"}},
          {What::kQuickStop, {"left: quick stop"}},
          {What::kCycle, {"cycle", {kNone, kNone}}},
          {What::kCycle, {"late cycle", {kNone, kNone}, 10}},
          {What::kCycle, {"cycle, left: not reached", {Trouble::kUnreached, kNone}}},
          {What::kCycle, {"cycle, left: fault", {Trouble::kFault, kNone}}},
          {What::kCycle, {"cycle, left: local control", {Trouble::kLocal, kNone}}},
          {What::kCycle, {"cycle, left: off and on", {Trouble::kOffAndOn, kNone}}}};
}

// Nobody enables, and there are no stops.
std::vector<Event> ofTwoDrives() {
  return {{What::kAcknowledge, {"request: acknowledge left"}},
          {What::kAcknowledge, {"request: acknowledge both, little patience"}, cycle::kAllDrives, 0, kShortPatience},
          {What::kSelectSet, {"request: left to parameter set 2"}, 0, 2},
          {What::kCycle, {"cycle", {kNone, kNone}}},
          {What::kCycle, {"late cycle", {kNone, kNone}, 10}},
          {What::kCycle, {"cycle, left: not reached", {Trouble::kUnreached, kNone}}},
          {What::kCycle, {"cycle, left: fault", {Trouble::kFault, kNone}}},
          {What::kCycle, {"cycle, left: fault whose cause stands", {Trouble::kLastFault, kNone}}},
          {What::kCycle, {"cycle, right: fault", {kNone, Trouble::kFault}}}};
}

class StandstillEvents {
 public:
  using Jobs = std::decay_t<decltype(standstillJobsOf(std::declval<StandstillRequests&>()))>;

  /// A request nobody has answered yet.
  struct Asked {
    bool waits = false;
    RequestKind kind = RequestKind::kAcknowledge;
    DriveIndex drive = 0;
    std::uint8_t set = 0;
    std::uint8_t age = 0, patience = 0;  // ticks
    bool idle = false;                   // the drives it asks had nothing else to do
  };

  struct World {
    TwoWheels wheels;
    Jobs jobs;
    std::uint32_t token = 0;
    std::array<Asked, kAtOnce> asked{};     // their id: the place, from 1 on
    std::array<bool, 2> may_acknowledge{};  // somebody asked, and it may still be under way
    std::uint8_t sets_asked = 0;            // of the left one, as bits: the same
    std::uint8_t set_before = 1;            // of the left one: commanded before
    std::uint8_t set_told = 1;              // by the left one, before the telegram
  };

  /// `at_once`: requests under way.
  StandstillEvents(std::vector<Event> alphabet, std::size_t at_once)
      : at_once_(at_once),
        drives_{drive::Drive{driveConfig()}, drive::Drive{driveConfig()}},
        requests_{drives_, {"left", "right"}, {0, 0}},
        events_(std::move(alphabet)) {}

  World initial() const {
    World world;
    for (drive::FakeInverter& inverter : world.wheels.inverters) inverter.set_delay = 1;
    return world;
  }
  std::size_t events() const { return events_.size(); }
  std::string name(std::size_t event) const { return events_[event].cycle.name; }

  bool apply(World& world, std::size_t number, Verdict& verdict) const {
    const Event& event = events_[number];
    drive::Drive& left = world.wheels.drives[0];
    switch (event.what) {
      case What::kCycle:
        cycle(world, event.cycle, verdict);
        return true;
      case What::kAcknowledge:
      case What::kSelectSet:
        return ask(world, event, verdict);
      case What::kEnable: {
        const bool ran = runs(left);
        left.requestEnable(world.wheels.now);
        if (!ran && runs(left)) world.wheels.watches[0].enableAccepted(left.report(), verdict);
        return true;
      }
      case What::kQuickStop:
        left.requestQuickStop(world.wheels.now);
        world.wheels.watches[0].quickStopAsked();
        return true;
    }
    return false;
  }

  void describe(const World& world, Key& key) const {
    world.wheels.describe(key);
    int waiting = 0;
    for (const Asked& asked : world.asked) waiting += asked.waits ? 1 : 0;
    key.add(static_cast<std::uint8_t>(waiting));
    key.add(world.may_acknowledge[0]).add(world.may_acknowledge[1]).add(world.sets_asked).add(world.set_before);
    key.add(world.set_told);
    // The places of the requests and the numbers of the tokens are only names.
    for (std::size_t i = 0; i < world.jobs.size(); ++i) {
      const auto& job = world.jobs[i];
      const Asked& asked = world.asked.at(job.request.id - 1);
      key.add(asked.waits).add(job.request.kind).add(job.request.drive).add(asked.set).add(asked.age);
      key.add(ticks(world.wheels.now, job.deadline, kTick, kLongPatience)).add(job.refusal.empty()).add(asked.idle);
      for (const drive::Drive& drive : world.wheels.drives) {
        const bool acknowledges = job.request.kind == RequestKind::kAcknowledge;
        const drive::RequestReport& report = acknowledges ? drive.report().acknowledge : drive.report().set_switch;
        key.add(report.token == job.token);
        if (report.token == job.token) key.add(report.state).add(report.refusal);
      }
    }
  }

  // With inverters that follow and no further request: everything asked is answered; then both can be acknowledged, and
  // the left one switched.
  void judge(const World& found, Verdict& verdict) const {
    World world = found;
    Verdict of_the_way;
    world.wheels.repair();
    for (int i = 0; i <= kLongPatience + 1 && waits(world); ++i) cycle(world, plain(), of_the_way);
    verdict.require(!waits(world), "a request has no answer, and the inverters follow");
    for (drive::Drive& drive : world.wheels.drives) drive.requestShutdown(world.wheels.now);
    for (int i = 0; i < 4 * kShutdownTimeout && (i < 2 || !atRest(world)); ++i) cycle(world, plain(), of_the_way);
    verdict.require(atRest(world), "no way to rest");
    const Event both{What::kAcknowledge, {""}, cycle::kAllDrives};
    verdict.require(isDone(world, both, of_the_way), "healthy drives at rest are not acknowledged");
    const Event set{What::kSelectSet, {""}, 0, 2};
    verdict.require(isDone(world, set, of_the_way), "a healthy drive at rest is not switched to another set");
    verdict.require(of_the_way.holds(), of_the_way.problem().c_str());
  }

 private:
  static WheelsCycle plain() { return {"cycle", {}}; }
  static bool runs(const drive::Drive& drive) {
    return drive::isEnabled(drive.report().phase) || drive.report().phase == Phase::kEnabling;
  }
  static bool waits(const World& world) {
    for (const Asked& asked : world.asked) {
      if (asked.waits) return true;
    }
    return world.jobs.size() != 0;
  }
  static bool atRest(const World& world) {
    for (const drive::Drive& drive : world.wheels.drives) {
      if (!drive.report().online || drive.report().phase != Phase::kIdle || !drive.isAtRest()) return false;
    }
    return true;
  }
  bool isDone(World& world, const Event& event, Verdict& verdict) const {
    success_ = false;
    if (!ask(world, event, verdict)) return false;
    for (int i = 0; i <= kLongPatience + 1 && waits(world); ++i) cycle(world, plain(), verdict);
    return success_;
  }

  /// Lends the object under test what the world keeps, and takes it back.
  template <typename Action>
  void lend(World& world, Action action) const {
    for (std::size_t i = 0; i < 2; ++i) drives_[i] = world.wheels.drives[i];
    standstillJobsOf(requests_) = world.jobs;
    standstillTokenOf(requests_) = world.token;
    action();
    for (std::size_t i = 0; i < 2; ++i) world.wheels.drives[i] = drives_[i];
    world.jobs = standstillJobsOf(requests_);
    world.token = standstillTokenOf(requests_);
  }

  bool ask(World& world, const Event& event, Verdict& verdict) const {
    std::size_t place = 0;
    while (place < at_once_ && world.asked[place].waits) ++place;
    if (place == at_once_) return false;
    cycle::Request request;
    request.id = static_cast<std::uint32_t>(place + 1);
    request.kind = event.what == What::kAcknowledge ? RequestKind::kAcknowledge : RequestKind::kSelectParameterSet;
    request.drive = event.drive;
    request.parameter_set = event.set;
    request.patience = event.patience * kTick;
    world.asked[place] = {true, request.kind, event.drive, event.set, 0, static_cast<std::uint8_t>(event.patience),
                          true};
    for (std::size_t i = 0; i < 2; ++i) {
      if (event.drive != cycle::kAllDrives && event.drive != i) continue;
      if (world.wheels.drives[i].report().phase != Phase::kIdle) world.asked[place].idle = false;
      if (event.what == What::kAcknowledge) world.may_acknowledge[i] = true;
    }
    if (event.what == What::kSelectSet)
      world.sets_asked = static_cast<std::uint8_t>(world.sets_asked | 1u << event.set);
    lend(world, [&] {
      requests_.handleRequest(request, world.wheels.now);
      takeCompletions(world, verdict);
    });
    noteAcknowledged(world);
    return true;
  }

  // A latched fault that stands no more is acknowledged without an edge.
  static void noteAcknowledged(World& world) {
    for (std::size_t i = 0; i < 2; ++i) {
      const drive::DriveReport& report = world.wheels.drives[i].report();
      if (report.acknowledge.state == drive::RequestState::kDone && !report.fault_latched) {
        world.wheels.watches[i].acknowledged();
      }
    }
  }

  void takeCompletions(World& world, Verdict& verdict) const {
    while (const auto completion = requests_.pollCompletion()) {
      const bool known = completion->id >= 1 && completion->id <= kAtOnce && world.asked[completion->id - 1].waits;
      verdict.require(known, "an answer to a request that has its answer");
      if (!known) continue;
      Asked& asked = world.asked[completion->id - 1];
      asked.waits = false;
      success_ = completion->success;
      const std::string_view words = completion->message.c_str();
      const bool busy = words.find(drive::toString(drive::Refusal::kBusy)) != std::string_view::npos;
      verdict.require(!asked.idle || !busy, "a drive is told to have been busy that had nothing to do");
      if (!completion->success) continue;
      for (DriveIndex i = 0; i < 2; ++i) {
        if (asked.drive != cycle::kAllDrives && asked.drive != i) continue;
        const drive::DriveReport& report = drives_[i].report();
        const bool faultless = !report.fault_latched && !profile::StatusWord{report.status_word}.fault();
        verdict.require(asked.kind != RequestKind::kAcknowledge || faultless,
                        "\"no fault stands\" was answered, and it is not so");
        verdict.require(asked.kind != RequestKind::kSelectParameterSet || report.parameter_set == asked.set,
                        "\"parameter set is active\" was answered, and it is not so");
      }
    }
  }

  // In the order of the bus cycle.
  void cycle(World& world, const WheelsCycle& cycle, Verdict& verdict) const {
    const std::uint8_t told = world.wheels.drives[0].report().parameter_set;
    if (told != 0) world.set_told = told;
    world.wheels.exchange(cycle, 0.0, verdict);
    std::array<bool, kAtOnce> overdue{};
    for (std::size_t i = 0; i < kAtOnce; ++i) {
      Asked& asked = world.asked[i];
      overdue[i] = asked.age >= asked.patience;
      asked.age = static_cast<std::uint8_t>(std::min<int>(asked.age + cycle.ticks, asked.patience));
    }
    lend(world, [&] {
      requests_.update(world.wheels.now);
      takeCompletions(world, verdict);
    });
    world.wheels.check(verdict);
    for (std::size_t i = 0; i < kAtOnce; ++i) {
      verdict.require(!world.asked[i].waits || !overdue[i],
                      "a request has no answer a cycle after its patience is over");
    }
    checkAcknowledging(world, verdict);
    checkSet(world, verdict);
  }

  static void checkAcknowledging(World& world, Verdict& verdict) {
    for (std::size_t i = 0; i < 2; ++i) {
      const drive::DriveReport& report = world.wheels.drives[i].report();
      verdict.require((report.output.control_word & 0x0080u) == 0 || world.may_acknowledge[i],
                      "a fault is acknowledged, and nobody asked");
      if (report.phase != Phase::kAcknowledging) world.may_acknowledge[i] = false;
    }
  }

  static void checkSet(World& world, Verdict& verdict) {
    const drive::DriveReport& report = world.wheels.drives[0].report();
    const Word word = report.output.control_word;
    if ((word & 0x0400u) == 0) return;
    const std::uint8_t set = profile::parameterSet(word);
    verdict.require(set == world.set_told || set == world.set_before || (world.sets_asked >> set & 1u) != 0,
                    "another parameter set is commanded, and nobody asked");
    world.set_before = set;
    if (report.phase != Phase::kSwitchingSet) world.sets_asked = 0;
  }

  std::size_t at_once_;
  mutable std::vector<drive::Drive> drives_;
  mutable StandstillRequests requests_;
  mutable bool success_ = false;  // of the last answer
  std::vector<Event> events_;
};

TEST(StandstillEventsTest, EveryOrderKeepsTheRules) {
  exploreAll(StandstillEvents{ofOneDrive(), 2}, "StandstillRequests of one drive", 1000);
}

TEST(StandstillEventsTest, EveryOrderOfFaultsAtTwoDrivesKeepsTheRules) {
  exploreAll(StandstillEvents{ofTwoDrives(), kAtOnce}, "StandstillRequests of two drives", 1000);
}

}  // namespace
}  // namespace nord_driver::explore
