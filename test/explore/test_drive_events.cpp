// Every order of status words, losses, requests and time-outs at one Drive. Its inverter is not modelled: it may say
// anything at any time.
#include <array>
#include <vector>

#include "drive/fake_inverter.h"
#include "explore/drive_watch.h"

namespace nord_driver::explore {
namespace {

using drive::Drive;
using drive::Phase;
using drive::RequestState;

enum class Request { kNone, kEnable, kShutDown, kZero, kQuickStop, kCoast, kAcknowledge, kOtherSet, kVelocity, kRest };

struct Event {
  const char* name;
  Request request = Request::kNone;  // else: a cycle
  Word status_word = 0;              // 0: nothing useful
  std::int16_t actual_value = 0;
  bool missing = false;      // the bus module says that the inverter is off
  bool interrupted = false;  // its connection was reset
  int ticks = 1;
};

const std::vector<Event>& alphabet() {
  static const std::vector<Event> kEvents{
      {"request: enable", Request::kEnable},
      {"request: shut down (OFF1)", Request::kShutDown},
      {"request: setpoint zero", Request::kZero},
      {"request: quick stop", Request::kQuickStop},
      {"request: coast (OFF2)", Request::kCoast},
      {"request: acknowledge", Request::kAcknowledge},
      {"request: the other parameter set", Request::kOtherSet},
      {"command: a velocity", Request::kVelocity},
      {"command: velocity 0", Request::kRest},
      {"cycle: 0B30 not ready to switch on", Request::kNone, 0x0B30},
      {"cycle: 0B70 switch-on disabled", Request::kNone, 0x0B70},
      {"cycle: 0B60 switch-on disabled, OFF2 at terminals", Request::kNone, 0x0B60},
      {"cycle: 0B31 ready to switch on", Request::kNone, 0x0B31},
      {"cycle: 0BB1 ready to switch on, warning", Request::kNone, 0x0BB1},
      {"cycle: 0B33 switched on", Request::kNone, 0x0B33},
      {"cycle: 0B37 operation enabled", Request::kNone, 0x0B37},
      {"cycle: 0B37 operation enabled, turning", Request::kNone, 0x0B37, 0x2000},
      {"cycle: 0B17 quick stop active", Request::kNone, 0x0B17, 0x2000},
      {"cycle: 0B3F fault reaction", Request::kNone, 0x0B3F},
      {"cycle: 0B38 fault", Request::kNone, 0x0B38},
      {"cycle: 0931 local control, ready to switch on", Request::kNone, 0x0931},
      {"cycle: 0937 local control, operation enabled", Request::kNone, 0x0937},
      {"cycle: 4B31 set 2, ready to switch on", Request::kNone, 0x4B31},
      {"cycle: 4B37 set 2, operation enabled", Request::kNone, 0x4B37},
      {"cycle: no answer", Request::kNone},
      {"cycle: the module says that the inverter is off", Request::kNone, 0, 0, true},
      {"cycle: connection reset, no answer", Request::kNone, 0, 0, false, true},
      {"cycle: connection reset, 0B37 operation enabled", Request::kNone, 0x0B37, 0, false, true},
      {"late cycle: 0B37 operation enabled", Request::kNone, 0x0B37, 0, false, false, 10},
      {"late cycle: 0B31 ready to switch on", Request::kNone, 0x0B31, 0, false, false, 10},
  };
  return kEvents;
}

class DriveEvents {
 public:
  explicit DriveEvents(bool rests) : rests_(rests) {}

  struct World {
    Drive drive;
    DriveWatch watch;
    Instant now{std::chrono::hours{1}};
    std::uint8_t acknowledging = 0, switching = 0;  // ticks since they were asked for
  };

  World initial() const {
    drive::DriveConfig config = driveConfig();
    config.allow_minimum_frequency = rests_;
    World world{Drive{config}, DriveWatch{rests_}};
    if (rests_) {
      world.drive.setMinimumFrequency(1, Hertz{5.0});
      world.drive.setMinimumFrequency(2, Hertz{5.0});
    }
    return world;
  }
  std::size_t events() const { return alphabet().size(); }
  std::string name(std::size_t event) const { return alphabet()[event].name; }

  bool apply(World& world, std::size_t number, Verdict& verdict) const {
    const Event& event = alphabet()[number];
    if (event.request != Request::kNone) return ask(world, event.request, verdict);
    cycle(world, event, verdict);
    return true;
  }

  void describe(const World& world, Key& key) const {
    describeDrive(world.drive, world.now, key);
    world.watch.describe(key);
    key.add(world.acknowledging).add(world.switching);
  }

  // With a drive that follows, from everywhere: to rest, and from there up again when that is asked for.
  void judge(const World& found, Verdict& verdict) const {
    for (const bool turning : {false, true}) {
      World world = found;
      drive::FakeInverter inverter;
      if (turning) inverter = turningInverter();
      world.drive.requestShutdown(world.now);
      run(world, inverter, 3 * kShutdownTimeout);
      const drive::DriveReport& report = world.drive.report();
      verdict.require(report.phase == Phase::kIdle, "no way to rest: not idle");
      verdict.require((report.output.control_word & 0x3FFFu) == 0x047E, "no way to rest: not the idle word");
      verdict.require(report.state == profile::DriveState::kReadyToSwitchOn,
                      "no way to rest: not \"ready to switch on\"");
      world.drive.requestAcknowledge(world.now);
      world.drive.requestEnable(world.now);
      run(world, inverter, kEnableTimeout + 1);
      verdict.require(drive::isEnabled(world.drive.report().phase), "no way up again from rest");
    }
  }

 private:
  static drive::FakeInverter turningInverter() {
    drive::FakeInverter inverter;
    profile::ProcessOutput output;
    for (const Word word : std::array<Word, 5>{0x047E, 0x047F, 0x047F, 0x047F, 0x047F}) {
      output.control_word = word;
      output.setpoints[0] = 0x0800;
      inverter.exchange(output);
    }
    return inverter;
  }

  static void run(World& world, drive::FakeInverter& inverter, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      const profile::ProcessInput input = inverter.exchange(world.drive.pollOutput(world.now));
      world.now += kTick;
      world.drive.handleInput(input, true, world.now);
    }
  }

  static bool isRunning(Phase phase) {
    return drive::isEnabled(phase) || phase == Phase::kEnabling || phase == Phase::kHoldingZero;
  }

  bool ask(World& world, Request request, Verdict& verdict) const {
    Drive& drive = world.drive;
    const Phase before = drive.report().phase;
    const bool busy = before == Phase::kAcknowledging || before == Phase::kSwitchingSet;
    switch (request) {
      case Request::kEnable:
        drive.requestEnable(world.now);
        if (drive.report().refusal == drive::Refusal::kNone && !isRunning(before)) {
          world.watch.enableAccepted(drive.report(), verdict);
        }
        break;
      case Request::kShutDown:
        drive.requestShutdown(world.now);
        world.watch.stopped();
        break;
      case Request::kZero:
        drive.requestSetpointZero(world.now);
        world.watch.zeroAsked();
        break;
      case Request::kQuickStop:
        drive.requestQuickStop(world.now);
        world.watch.quickStopAsked();
        break;
      case Request::kCoast:
        drive.requestCoast(world.now);
        world.watch.stopped();
        break;
      case Request::kAcknowledge:
        if (busy) return false;
        drive.requestAcknowledge(world.now, 1);
        world.acknowledging = 0;
        break;
      case Request::kOtherSet:
        if (busy) return false;
        drive.requestParameterSet(drive.report().commanded_set == 1 ? 2 : 1, world.now, 1);
        world.switching = 0;
        break;
      case Request::kVelocity:
        drive.setVelocity(RadPerSec{3.0});
        break;
      case Request::kRest:
        drive.setVelocity(RadPerSec{0.0});
        break;
      case Request::kNone:
        break;
    }
    if (drive.report().acknowledge.state == RequestState::kDone && request == Request::kAcknowledge) {
      world.watch.acknowledged();
    }
    world.watch.checkReport(drive.report(), 0, verdict);
    return true;
  }

  void cycle(World& world, const Event& event, Verdict& verdict) const {
    Drive& drive = world.drive;
    const bool online = drive.report().online;
    const bool acknowledging = drive.report().acknowledge.state == RequestState::kRunning;
    world.watch.checkOutput(drive.pollOutput(world.now), online, verdict);
    world.now += event.ticks * kTick;
    if (event.interrupted) {
      world.watch.lost();
      drive.handleInterruption(drive::StopCause::kInterrupted, world.now);
    }
    if (event.missing) drive.handleModule(true, world.now);
    profile::ProcessInput input;
    input.status_word = event.status_word;
    input.actual_values[0] = event.actual_value;
    if (event.status_word != 0) {
      world.watch.heard(profile::StatusWord{event.status_word});
    } else {
      world.watch.silence(event.ticks);
    }
    drive.handleInput(input, event.status_word != 0, world.now);
    if (acknowledging && drive.report().acknowledge.state == RequestState::kDone) world.watch.acknowledged();
    world.watch.checkReport(drive.report(), event.ticks, verdict);
    // Low, high and low again, each until it was answered twice, and as long as that may be silent in between.
    constexpr int kLevel = drive::AcknowledgeEdge::kAnswers * (kDriveTimeout + 1);
    checkEnd(drive.report().acknowledge, 3 * kLevel + kAcknowledgeTime, "acknowledging has no end", world.acknowledging,
             verdict);
    checkEnd(drive.report().set_switch, kEnableTimeout + 1, "switching the set has no end", world.switching, verdict);
  }

  static void checkEnd(const drive::RequestReport& request, int most, const char* problem, std::uint8_t& cycles,
                       Verdict& verdict) {
    cycles = request.state == RequestState::kRunning ? static_cast<std::uint8_t>(cycles + 1) : std::uint8_t{0};
    verdict.require(cycles <= most, problem);
  }

  bool rests_;
};

TEST(DriveEventsTest, EveryOrderKeepsTheRules) {
  exploreAll(DriveEvents{false}, "Drive", 1000);
}

TEST(DriveEventsTest, EveryOrderKeepsTheRulesWithAMinimumFrequency) {
  exploreAll(DriveEvents{true}, "Drive with P104 > 0", 1000);
}

}  // namespace
}  // namespace nord_driver::explore
