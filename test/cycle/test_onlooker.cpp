// The cycle of a node that looks on (read_only): it sends nothing that acts and refuses whatever would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/bus_cycle.h"
#include "cycle/cycle_bench.h"
#include "cycle/cycle_ports.h"
#include "cycle/scripted_transport.h"
#include "cycle/signal_values.h"
#include "profile/status_word.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

struct Onlooker {
  explicit Onlooker(const WordSetup& words = {})
      : transport{1}, ports{1}, cycle{config(words), transport, ports, false, CycleRole::kOnlooker} {}

  static CycleConfig config(const WordSetup& words) {
    CycleConfig config;
    config.service_timeout = std::chrono::seconds{1};
    DriveSetup setup;
    setup.name = "belt";
    setup.drive.joint.pole_pairs = 2;
    setup.words = words;
    config.drives.push_back(setup);
    return config;
  }
  void run(int cycles = 1) {
    for (int i = 0; i < cycles; ++i) {
      cycle.runOnce();
      EXPECT_EQ(0x0000, transport.outputs[0].control_word);
      for (const Word setpoint : transport.outputs[0].setpoints) EXPECT_EQ(0, setpoint);
      transport.sleepUntil(transport.time + cycle.period());
    }
  }
  Completion ask(RequestKind kind) {
    Request request;
    request.id = ++last_id;
    request.kind = kind;
    request.drive = 0;
    request.patience = std::chrono::seconds{1};
    request.parameter_set = 2;
    request.parameter.number = 102;
    if (kind == RequestKind::kWriteParameter) request.parameter.action = profile::ParameterAction::kWriteRam;
    EXPECT_TRUE(ports.submit(request));
    run(2);
    const auto completion = ports.waitCompletion(Duration::zero());
    return completion.value_or(Completion{});
  }

  ScriptedTransport transport;
  CyclePorts ports;
  BusCycle cycle;
  std::uint32_t last_id = 0;
};

TEST(Onlooker, SendsZerosAndShowsWhatTheDriveTells) {
  Onlooker onlooker;
  onlooker.run(50);
  const DriveSnapshot& drive = onlooker.ports.readSnapshot().drives[0];
  EXPECT_TRUE(drive.online);
  EXPECT_EQ(0x0000, drive.output.control_word) << "as sent, not as it would be";
  EXPECT_NE(0, drive.input.status_word);
}

// The other master runs it in set 2, whose words nobody would have to know who only looks at the frequency.
TEST(Onlooker, TellsTheSignalsOfTheSetInForce) {
  SignalSetup door;
  door.name = "door";
  door.source = SignalSource::kDigitalInput;
  door.number = 3;
  WordSetup words;
  words.signals = {door};
  Onlooker onlooker{words};
  for (const int number : {543, 546}) onlooker.transport.parameters[number] = 1;
  for (const int number : {545, 547, 548}) onlooker.transport.parameters[number] = 0;
  onlooker.transport.parameters[544] = 5;  // state of the digital inputs and outputs
  drive::FakeInverter& belt = onlooker.transport.inverters[0];
  profile::ProcessOutput of_the_other;
  of_the_other.control_word = 0x447E;
  belt.exchange(of_the_other);
  belt.second = 0x0004;
  onlooker.run(150);
  const DriveSnapshot& drive = onlooker.ports.readSnapshot().drives[0];
  ASSERT_EQ(2, drive.parameter_set);
  EXPECT_EQ(1.0, signalValue(door, profile::Series::kSk5xxe, drive));
  EXPECT_FALSE(drive.stopped) << drive.text.c_str();
}

TEST(Onlooker, RefusesWhateverCommandsOrWrites) {
  Onlooker onlooker;
  onlooker.run(10);
  for (const RequestKind kind :
       {RequestKind::kEnable, RequestKind::kDisable, RequestKind::kQuickStop, RequestKind::kAcknowledge,
        RequestKind::kSelectParameterSet, RequestKind::kWriteParameter}) {
    const Completion answer = onlooker.ask(kind);
    EXPECT_FALSE(answer.success) << static_cast<int>(kind);
    EXPECT_THAT(answer.message.str(), HasSubstr("read_only is true")) << static_cast<int>(kind);
  }
  onlooker.run(50);
}

// What its setpoints would need, in each parameter set, nobody has to know: it sends none.
TEST(Onlooker, ReadsNothingForWhatItDoesNotSend) {
  const auto readsOfSetpoint3 = [](const WordSetup& words) {
    Onlooker onlooker{words};
    onlooker.transport.hold_answers = true;
    int reads = 0;
    for (int i = 0; i < 200; ++i) {
      onlooker.run();
      while (!onlooker.transport.submitted.empty()) {
        reads += onlooker.transport.submitted.front().request.number == 548 ? 1 : 0;
        onlooker.transport.answerFirst();
      }
    }
    return reads;
  };
  WordSetup setpoint;
  setpoint.setpoints.emplace_back();
  setpoint.setpoints[0].use = profile::WordUse::kTorqueLimit;
  EXPECT_EQ(1, readsOfSetpoint3(setpoint)) << "once, for /diagnostics";
  WordSetup input;
  input.signals.emplace_back();
  input.signals[0].source = SignalSource::kDigitalInput;
  input.signals[0].number = 1;
  EXPECT_EQ(4, readsOfSetpoint3(input)) << "of each set";
}

// In the fields of a parameter's answer, too: no device was asked.
TEST(Onlooker, TellsAWriteItRefusesApart) {
  Onlooker onlooker;
  onlooker.run(10);
  const Completion answer = onlooker.ask(RequestKind::kWriteParameter);
  EXPECT_EQ(profile::ParameterOutcome::kRefused, answer.parameter.outcome);
  EXPECT_EQ(profile::ParameterReason::kDriver, answer.parameter.reason);
}

// What another master drives is nobody's ramp that does not end, and nobody's terminals.
TEST(Onlooker, FindsNothingWrongWithADriveThatOthersLetRun) {
  Onlooker onlooker;
  onlooker.run(50);
  onlooker.transport.inverters[0].exchange({0x047E, {}});
  for (int i = 0; i < 3; ++i) onlooker.transport.inverters[0].exchange({0x047F, {}});
  onlooker.run(1500);
  const DriveSnapshot& drive = onlooker.ports.readSnapshot().drives[0];
  ASSERT_TRUE(profile::StatusWord{drive.input.status_word}.operationEnabled());
  EXPECT_FALSE(drive.stopped) << drive.text.c_str();
  EXPECT_STREQ("", drive.terminals_text.c_str());
}

// Whoever drives acknowledges: ~acknowledge_faults is refused here.
TEST(Onlooker, HasNoFaultThatTheDriveDoesNotTell) {
  Onlooker onlooker;
  onlooker.run(10);
  onlooker.transport.inverters[0].fault = true;
  onlooker.run(2);
  EXPECT_TRUE(onlooker.ports.readSnapshot().drives[0].fault_latched);
  onlooker.transport.inverters[0].switchOffAndOn();
  onlooker.run(2);
  EXPECT_FALSE(onlooker.ports.readSnapshot().drives[0].fault_latched);
}

// It can never be enabled, and ~enable refuses: nobody is to be told to call it.
TEST(Onlooker, HasNoBaseThatWaitsForACommand) {
  for (const CycleRole role : {CycleRole::kDriver, CycleRole::kOnlooker}) {
    ScriptedTransport transport{3};
    CyclePorts ports{3};
    BusCycle cycle{CycleBench::config(), transport, ports, false, role};
    ports.commandBase({{0.5, 0.0}, transport.time, true});
    cycle.runOnce();
    EXPECT_EQ(role == CycleRole::kDriver, ports.readSnapshot().base.commanded);
  }
}

// A drive that others let run has no rest to be brought to.
TEST(Onlooker, EndsAtOnceAndLeavesADriveThatRuns) {
  Onlooker onlooker;
  onlooker.transport.inverters[0].exchange({0x047E, {}});
  for (int i = 0; i < 3; ++i) onlooker.transport.inverters[0].exchange({0x047F, {}});
  onlooker.run(10);
  EXPECT_TRUE(onlooker.ask(RequestKind::kShutDown).success);
}

}  // namespace
}  // namespace nord_driver::cycle
