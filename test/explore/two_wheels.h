// Two drives of one base, an inverter behind each that follows or gives trouble, and what is judged of the pair.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "drive/fake_inverter.h"
#include "explore/drive_watch.h"

namespace nord_driver::explore {

NORD_EXPLORE_MEMBER(lowOf, drive::FakeInverter, low_)
NORD_EXPLORE_MEMBER(setOf, drive::FakeInverter, set_)
NORD_EXPLORE_MEMBER(waitedOf, drive::FakeInverter, waited_)
NORD_EXPLORE_MEMBER(acknowledgeBitOf, drive::FakeInverter, acknowledge_)
NORD_EXPLORE_MEMBER(frequencyOf, drive::FakeInverter, frequency_)

constexpr int kStandstillTimeout = 2;

/// What an inverter does in one cycle.
enum class Trouble : std::uint8_t {
  kNone,
  kSilent,     ///< it hears, and is not heard
  kUnreached,  ///< neither
  kFault,      ///< whose cause is gone at once
  kLastFault,  ///< whose cause stands
  kLocal,      ///< control at its terminals
  kStuck,      ///< does not go on upwards
  kEndless,    ///< does not come down an OFF1 ramp
  kOffAndOn,   ///< leaves "operation enabled" unasked
};

struct WheelsCycle {
  std::string name;
  std::array<Trouble, 2> trouble{};
  int ticks = 1;
  bool ramps = false;  ///< the layer above has not brought the setpoint to zero yet
};

/// Each trouble at one wheel, those that end a motion by themselves at the other one too, some at both.
inline std::vector<WheelsCycle> wheelsCycles() {
  constexpr Trouble kNone = Trouble::kNone;
  return {{"cycle", {kNone, kNone}},
          {"late cycle", {kNone, kNone}, 10},
          {"cycle, setpoint not down yet", {kNone, kNone}, 1, true},
          {"cycle, left: heard nothing of", {Trouble::kSilent, kNone}},
          {"cycle, right: heard nothing of", {kNone, Trouble::kSilent}},
          {"cycle, both: not reached", {Trouble::kUnreached, Trouble::kUnreached}},
          {"cycle, left: fault", {Trouble::kFault, kNone}},
          {"cycle, right: fault", {kNone, Trouble::kFault}},
          {"cycle, right: fault whose cause stands", {kNone, Trouble::kLastFault}},
          {"cycle, left: local control", {Trouble::kLocal, kNone}},
          {"cycle, right: stuck", {kNone, Trouble::kStuck}},
          {"cycle, left: off and on", {Trouble::kOffAndOn, kNone}},
          {"cycle, both: ramp no lower", {Trouble::kEndless, Trouble::kEndless}}};
}

struct TwoWheels {
  std::array<drive::Drive, 2> drives{drive::Drive{driveConfig()}, drive::Drive{driveConfig()}};
  std::array<drive::FakeInverter, 2> inverters;
  std::array<DriveWatch, 2> watches{DriveWatch{false}, DriveWatch{false}};
  Instant now{std::chrono::hours{1}};

  TwoWheels() {
    for (auto& inverter : inverters) inverter.ramp = 0x1000;
  }

  /// One exchange; the layer above decides after it. The wheels are commanded `velocity` rad/s.
  void exchange(const WheelsCycle& cycle, double velocity, Verdict& verdict) {
    std::array<profile::ProcessOutput, 2> outputs;
    for (std::size_t i = 0; i < 2; ++i) {
      drives[i].setVelocity(RadPerSec{velocity});
      const bool online = drives[i].report().online;
      outputs[i] = drives[i].pollOutput(now);
      watches[i].checkOutput(outputs[i], online, verdict);
    }
    checkPair(outputs, verdict);
    now += cycle.ticks * kTick;
    for (std::size_t i = 0; i < 2; ++i) {
      answer(i, outputs[i], cycle.trouble[i], cycle.ticks);
      watches[i].checkReport(drives[i].report(), cycle.ticks, verdict);
    }
  }
  /// After the layer above has decided.
  void check(Verdict& verdict) {
    for (std::size_t i = 0; i < 2; ++i) watches[i].checkReport(drives[i].report(), 0, verdict);
  }
  /// One is commanded to run, or will be by itself.
  bool oneRuns() const {
    for (const drive::Drive& drive : drives) {
      const drive::Phase phase = drive.report().phase;
      if (drive::isEnabled(phase) || phase == drive::Phase::kEnabling || phase == drive::Phase::kHoldingZero)
        return true;
    }
    return false;
  }
  bool bothRun() const { return watches[0].runs() && watches[1].runs(); }
  /// Mains off and on at an inverter with a fault: it is healthy.
  void repair() {
    for (auto& inverter : inverters) {
      inverter.cause = false;
      if (inverter.fault) inverter.switchOffAndOn();
    }
  }

  void describe(Key& key) const {
    for (std::size_t i = 0; i < 2; ++i) {
      describeDrive(drives[i], now, key);
      watches[i].describe(key);
      const drive::FakeInverter& inverter = inverters[i];
      key.add(lowOf(inverter)).add(setOf(inverter)).add(waitedOf(inverter)).add(acknowledgeBitOf(inverter));
      key.add(frequencyOf(inverter)).add(inverter.fault);
    }
  }

 private:
  void checkPair(const std::array<profile::ProcessOutput, 2>& outputs, Verdict& verdict) {
    const auto runs = [&](std::size_t i) { return (outputs[i].control_word & 0x040Fu) == 0x040Fu; };
    const bool one_alone = runs(0) != runs(1);
    verdict.require(!one_alone || (outputs[0].setpoints[0] == 0 && outputs[1].setpoints[0] == 0),
                    "one wheel is commanded to turn while the other is not enabled");
  }

  void answer(std::size_t i, const profile::ProcessOutput& output, Trouble trouble, int passed) {
    drive::FakeInverter& inverter = inverters[i];
    inverter.local = trouble == Trouble::kLocal;
    inverter.stuck = trouble == Trouble::kStuck;
    inverter.endless = trouble == Trouble::kEndless;
    inverter.cause = trouble == Trouble::kLastFault;
    inverter.fault = inverter.fault || trouble == Trouble::kFault || trouble == Trouble::kLastFault;
    const bool silent = trouble == Trouble::kSilent || trouble == Trouble::kUnreached;
    profile::ProcessInput input;
    if (trouble != Trouble::kUnreached) input = inverter.exchange(output);
    if (trouble == Trouble::kOffAndOn) {
      inverter.switchOffAndOn();
      input = inverter.exchange({});
    }
    const bool was_latched = drives[i].report().fault_latched;
    if (silent) {
      watches[i].silence(passed);
    } else {
      watches[i].heard(profile::StatusWord{input.status_word});
    }
    drives[i].handleInput(input, !silent, now);
    if (was_latched && drives[i].report().acknowledge.state == drive::RequestState::kDone) watches[i].acknowledged();
  }
};

}  // namespace nord_driver::explore
