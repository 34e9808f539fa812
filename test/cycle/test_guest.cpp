// The cycle of a program that only reads and writes parameters: what it sends before it knows that no drive runs, and
// what it does not ask for.
#include <gtest/gtest.h>

#include "cycle/bus_cycle.h"
#include "cycle/cycle_ports.h"
#include "cycle/scripted_transport.h"

namespace nord_driver::cycle {
namespace {

struct Guest {
  Guest() : transport{2}, ports{2}, cycle{config(), transport, ports, false, CycleRole::kGuest} {}

  static CycleConfig config() {
    CycleConfig config;
    for (const char* name : {"first", "second"}) {
      DriveSetup setup;
      setup.name = name;
      setup.drive.joint.pole_pairs = 2;
      config.drives.push_back(setup);
    }
    return config;
  }
  void run(int cycles = 1) {
    for (int i = 0; i < cycles; ++i) {
      cycle.runOnce();
      transport.sleepUntil(transport.time + cycle.period());
    }
  }
  Word sent(DriveIndex drive) const { return transport.outputs[drive].control_word; }

  ScriptedTransport transport;
  CyclePorts ports;
  BusCycle cycle;
};

// 0000 until the first drive has answered in three cycles, and then the idle word.
TEST(Guest, SaysNothingThatActsBeforeItHasSeenTheDrivesAtRest) {
  Guest guest;
  guest.transport.inverters[0].silent = true;
  guest.run(10);
  EXPECT_FALSE(guest.cycle.gate().isOpen()) << "the first drive is silent";
  EXPECT_FALSE(guest.cycle.gate().heard());
  guest.transport.inverters[0].silent = false;
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(guest.cycle.gate().isOpen()) << i;
    guest.run();
    EXPECT_TRUE(guest.cycle.gate().heard()) << i;
    EXPECT_EQ(0x0000, guest.sent(0)) << i;
    EXPECT_EQ(0x0000, guest.sent(1)) << i;
  }
  EXPECT_TRUE(guest.cycle.gate().isOpen());
  guest.run(2);
  EXPECT_EQ(0x047E, guest.sent(0));
}

// Whoever looks for the drives anew knows nothing of them.
TEST(Guest, HoldsAllBackAgainOnceTheGateIsClosed) {
  Guest guest;
  guest.run(10);
  ASSERT_EQ(0x047E, guest.sent(0));
  guest.cycle.closeGate();
  guest.run();
  EXPECT_EQ(0x0000, guest.sent(0));
  EXPECT_FALSE(guest.cycle.gate().isOpen());
  guest.run(10);
  EXPECT_TRUE(guest.cycle.gate().isOpen());
}

TEST(Guest, LeavesADriveThatRunsAloneForEver) {
  Guest guest;
  guest.transport.inverters[1].exchange({0x047E, {}});
  for (int i = 0; i < 3; ++i) guest.transport.inverters[1].exchange({0x047F, {}});
  guest.run(50);
  EXPECT_FALSE(guest.cycle.gate().isOpen());
  ASSERT_TRUE(guest.cycle.gate().running().has_value());
  EXPECT_EQ(1u, guest.cycle.gate().running()->drive);
  EXPECT_EQ(profile::DriveState::kOperationEnabled, guest.cycle.gate().running()->state);
  EXPECT_EQ(0x0000, guest.sent(0));
  EXPECT_EQ(0x0000, guest.sent(1));
  EXPECT_FALSE(guest.ports.readSnapshot().drives[1].online);
}

// What a driver reads for itself would only make its users wait.
TEST(Guest, AsksForNothingButWhatItsUsersWant) {
  Guest guest;
  guest.transport.hold_answers = true;
  guest.run(20);
  ASSERT_TRUE(guest.cycle.gate().isOpen());
  EXPECT_TRUE(guest.transport.submitted.empty());
  Request request;
  request.id = 1;
  request.kind = RequestKind::kReadParameter;
  request.drive = 0;
  request.parameter.number = 105;
  request.patience = std::chrono::seconds{1};
  guest.ports.submit(request);
  guest.run(2);
  ASSERT_EQ(1u, guest.transport.submitted.size());
  guest.transport.answerFirst();
  guest.run(2);
  const auto answer = guest.ports.waitCompletion(Duration::zero());
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(500, answer->parameter.raw);
}

TEST(Guest, EnablesNothing) {
  Guest guest;
  guest.run(20);
  Request request;
  request.id = 1;
  request.kind = RequestKind::kEnable;
  request.drive = 0;
  request.patience = std::chrono::seconds{5};
  guest.ports.submit(request);
  for (int i = 0; i < 200; ++i) {
    guest.run();
    EXPECT_NE(0x047F, guest.sent(0));
  }
  const auto answer = guest.ports.waitCompletion(Duration::zero());
  ASSERT_TRUE(answer.has_value());
  EXPECT_FALSE(answer->success);
}

// --- the gate by itself ----------------------------------------------------------------------------------------------

/// What these drives say in one cycle; 0: no inverter answers.
std::vector<DriveExchange> heard(std::initializer_list<Word> status_words) {
  std::vector<DriveExchange> inputs;
  for (const Word status_word : status_words) {
    DriveExchange input;
    input.inverter_answers = status_word != 0;
    input.input.status_word = status_word;
    inputs.push_back(input);
  }
  return inputs;
}

void hear(GuestGate& gate, std::initializer_list<Word> status_words, int cycles = 1) {
  for (int i = 0; i < cycles; ++i) {
    auto inputs = heard(status_words);
    gate.handleInputs(inputs);
  }
}

// While it is closed the drives look silent and hear nothing; a driver's is open from the beginning.
TEST(Gate, HoldsBackBothWays) {
  GuestGate gate{true};
  std::vector<profile::ProcessOutput> outputs(1);
  outputs[0].control_word = 0x047E;
  auto inputs = heard({0x0B31});
  gate.holdBack(outputs);
  gate.handleInputs(inputs);
  EXPECT_EQ(0, outputs[0].control_word);
  EXPECT_FALSE(inputs[0].inverter_answers);
  EXPECT_EQ(0, inputs[0].input.status_word);
  GuestGate open{false};
  outputs[0].control_word = 0x047E;
  inputs = heard({0x0B37});
  open.holdBack(outputs);
  open.handleInputs(inputs);
  EXPECT_EQ(0x047E, outputs[0].control_word);
  EXPECT_EQ(0x0B37, inputs[0].input.status_word);
  EXPECT_TRUE(open.isOpen());
  EXPECT_FALSE(open.running());
}

// Three cycles in which all that are awaited answered, be they one after the other or not.
TEST(Gate, OpensWhenAllAwaitedWereHeardThreeTimes) {
  GuestGate gate{true};
  gate.close(2);
  hear(gate, {0x0B31, 0}, 5);
  EXPECT_FALSE(gate.heard());
  EXPECT_TRUE(gate.hears(0));
  EXPECT_FALSE(gate.hears(1));
  EXPECT_FALSE(gate.hears(2)) << "not awaited";
  hear(gate, {0x0B31}, 5);
  EXPECT_FALSE(gate.heard()) << "one is all there is";
  hear(gate, {0x0B31, 0x0B70}, 2);
  EXPECT_TRUE(gate.heard());
  hear(gate, {0x0B31, 0});
  EXPECT_FALSE(gate.isOpen());
  hear(gate, {0x0B31, 0x0B70});
  EXPECT_TRUE(gate.isOpen());
}

// A drive that no word of the guest gets to may run.
TEST(Gate, JudgesThoseAloneThatAreReached) {
  GuestGate gate{true};
  gate.close(2, false);
  hear(gate, {0x0B31, 0x0B31, 0x0B37}, 3);
  EXPECT_FALSE(gate.running());
  EXPECT_TRUE(gate.isOpen());
  gate.close(2, false);
  hear(gate, {0x0B31, 0x0B37, 0x0B31}, 3);
  ASSERT_TRUE(gate.running());
  EXPECT_EQ(1u, gate.running()->drive);
  EXPECT_FALSE(gate.isOpen());
  gate.close(2);
  hear(gate, {0x0B31, 0x0B31, 0x0B37}, 3);
  EXPECT_TRUE(gate.running()) << "its words get to the third again";
}

// A fault is rest. That of an awaited drive is told, since the words behind the gate may acknowledge it.
TEST(Gate, AFaultOfTheFirstIsSeen) {
  GuestGate first{true}, second{true};
  hear(first, {0x0238, 0x0B31}, 3);
  EXPECT_TRUE(first.faultSeen());
  EXPECT_TRUE(first.isOpen());
  hear(second, {0x0B31, 0x0238}, 3);
  EXPECT_FALSE(second.faultSeen());
  EXPECT_TRUE(second.isOpen());
}

// The first that runs is named, and keeps it closed whatever comes later.
TEST(Gate, ADriveThatRanKeepsItClosed) {
  for (const Word runs : {Word{0x0B33}, Word{0x0B37}, Word{0x0B17}, Word{0x023F}}) {
    GuestGate gate{true};
    hear(gate, {0x0B31, runs, 0x0B37});
    hear(gate, {0x0B37, 0x0B31, 0x0B31});
    hear(gate, {0x0B31, 0x0B31, 0x0B31}, 5);
    EXPECT_FALSE(gate.isOpen()) << runs;
    ASSERT_TRUE(gate.running());
    EXPECT_EQ(1u, gate.running()->drive);
    EXPECT_EQ(profile::StatusWord{runs}.state(), gate.running()->state);
  }
}

// Closed again it knows nothing: neither who was heard, nor the fault, nor the drive that ran.
TEST(Gate, ForgetsWhatItSawWhenItIsClosedAgain) {
  GuestGate gate{true};
  hear(gate, {0x0238, 0x0B37}, 3);
  ASSERT_TRUE(gate.heard() && gate.hears(0) && gate.faultSeen() && gate.running());
  gate.close(2);
  EXPECT_FALSE(gate.heard());
  EXPECT_FALSE(gate.hears(0));
  EXPECT_FALSE(gate.faultSeen());
  EXPECT_FALSE(gate.running());
  hear(gate, {0x0B31, 0x0B31}, 3);
  EXPECT_TRUE(gate.isOpen());
}

// Left to another master, the drives may have come into any state: all is looked at again, and a fault stays to be told.
TEST(Gate, ClosesAgainWhenTheBusWasLeftToAnotherMaster) {
  GuestGate gate{true};
  gate.close(2);
  hear(gate, {0x0B31, 0x0238}, 3);
  ASSERT_TRUE(gate.isOpen());
  EXPECT_FALSE(gate.faultSeen(0));
  EXPECT_TRUE(gate.faultSeen(1));
  auto inputs = heard({0, 0});
  inputs[0].given_way = inputs[1].given_way = true;
  gate.handleInputs(inputs);
  EXPECT_FALSE(gate.isOpen());
  EXPECT_TRUE(gate.faultSeen(1));
  hear(gate, {0, 0x0B31}, 5);
  EXPECT_FALSE(gate.isOpen()) << "both are awaited";
  hear(gate, {0x0238, 0x0B31}, 3);
  EXPECT_TRUE(gate.isOpen());
  EXPECT_TRUE(gate.faultSeen(0));

  inputs[0].given_way = inputs[1].given_way = true;
  gate.handleInputs(inputs);
  hear(gate, {0x0B31, 0x0B37}, 3);
  EXPECT_FALSE(gate.isOpen());
  ASSERT_TRUE(gate.running());
  EXPECT_EQ(1u, gate.running()->drive);

  GuestGate of_a_driver{false};
  of_a_driver.handleInputs(inputs);
  EXPECT_TRUE(of_a_driver.isOpen());
}

// One that is not there at all is not waited for.
TEST(Gate, OpensWithoutThoseThatAreNotAwaited) {
  GuestGate gate{true};
  hear(gate, {0x0B31, 0}, 3);
  EXPECT_TRUE(gate.isOpen());
}

// Of an inverter that is off behind its module the module sends an old word.
TEST(Gate, TakesNoOldWordForADriveThatRuns) {
  GuestGate gate{true};
  for (int i = 0; i < 3; ++i) {
    auto inputs = heard({0x0B31, 0x0B37});
    inputs[1].inverter_answers = false;
    inputs[1].module_answers = true;
    gate.handleInputs(inputs);
  }
  EXPECT_FALSE(gate.running());
  EXPECT_TRUE(gate.isOpen());
}

}  // namespace
}  // namespace nord_driver::cycle
