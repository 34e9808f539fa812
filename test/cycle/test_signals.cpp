// Signals through the whole cycle: which bit goes where, from when, and what P480 refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/parameter_requests.h"
#include "cycle/signal_values.h"
#include "cycle/signals_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(SignalsTest, ABusBitGoesToTheWordThatCarriesThem) {
  Signals bench{{output(SignalSource::kBusInBit, 3)}};
  bench.run(120);
  EXPECT_EQ(0, bench.sent().setpoints[1]) << "off at start";
  bench.command(true);
  bench.step();
  EXPECT_EQ(8, bench.sent().setpoints[1]);
  EXPECT_EQ(0, bench.sent().setpoints[2]);
  bench.command(false);
  bench.step();
  EXPECT_EQ(0, bench.sent().setpoints[1]);
  Signals without{{output(SignalSource::kBusInBit, 3)}};
  without.transport.parameters[547] = 2;
  without.run(120);
  without.command(true);
  without.step();
  EXPECT_EQ(0, without.sent().setpoints[1]) << "a torque limit is no lamp";
  EXPECT_THAT(without.ask(RequestKind::kEnable, CycleBench::kLift).message.c_str(),
              HasSubstr("set P548 of drive lift to 17 (Bus I/O in bits 0...7)"));
}

TEST(SignalsTest, ControlBitsAreInTheControlWord) {
  Signals bench{{output(SignalSource::kControlBit, 8), output(SignalSource::kControlBit, 9)}};
  bench.run(120);
  EXPECT_EQ(0x047E, bench.sent().control_word);
  bench.command(true, 1);
  bench.step();
  EXPECT_EQ(0x067E, bench.sent().control_word);
  bench.command(true, 0);
  bench.step();
  EXPECT_EQ(0x077E, bench.sent().control_word);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable, CycleBench::kLift).success);
  bench.command(true, 0);
  bench.step();
  EXPECT_EQ(0x057F, bench.sent().control_word & ~0x0200);
}

// Not behind bit 10: the module's outputs are its own.
TEST(SignalsTest, ModuleOutputsNeedNoInverter) {
  Signals bench{{output(SignalSource::kModuleOutput, 2)}};
  bench.transport.module_only[CycleBench::kLift] = true;
  bench.run(5);
  EXPECT_EQ(0, bench.sent().module_outputs);
  bench.command(true);
  bench.step();
  EXPECT_EQ(0, bench.sent().control_word & 0x0400);
  EXPECT_EQ(2, bench.sent().module_outputs);
}

TEST(SignalsTest, GoOffWithTheTimeOutUnlessTheyHold) {
  SignalSetup held = output(SignalSource::kModuleOutput, 2);
  held.hold = true;
  Signals bench{{output(SignalSource::kModuleOutput, 1), held}};
  bench.run(120);
  bench.command(true, 0);
  bench.command(true, 1);
  bench.run(45);
  EXPECT_EQ(3, bench.sent().module_outputs);
  bench.run(10);
  EXPECT_EQ(2, bench.sent().module_outputs);
}

// Trap of SK 2xxE: bus bit 0 leaves the factory as "enable right".
TEST(SignalsTest, ABitThatMayMoveIsRefusedAndSaysSo) {
  Signals bench{{output(SignalSource::kBusInBit, 0)}};
  bench.transport.parameters[480] = 1;
  bench.run(120);
  bench.command(true);
  for (int i = 0; i < 20; ++i) {
    bench.step();
    ASSERT_EQ(0, bench.sent().setpoints[1]);
  }
  const auto events = bench.events();
  EXPECT_THAT(events, Contains(AllOf(HasSubstr("warning: signal lamp of drive lift stays off"),
                                     HasSubstr("P480[-01] is 1 (enable right)"), HasSubstr("may_move: true"))));
  EXPECT_THAT(bench.events(), Not(Contains(HasSubstr("stays off")))) << "once";
}

// Every function but none: the bus manuals name few of them, and no list is complete.
TEST(SignalsTest, AnyFunctionButNoneNeedsMayMove) {
  for (const int function : {1, 2, 4, 5, 8, 12, 14, 19, 33, 72}) {
    Signals bench{{output(SignalSource::kControlBit, 8)}};
    bench.transport.parameters[480] = function;
    bench.run(120);
    bench.command(true);
    bench.run(2);
    EXPECT_EQ(0x047E, bench.sent().control_word) << function;
    SignalSetup accepted = output(SignalSource::kControlBit, 8);
    accepted.may_move = true;
    Signals accepting{{accepted}};
    accepting.transport.parameters[480] = function;
    accepting.run(120);
    accepting.command(true);
    accepting.run(2);
    EXPECT_EQ(0x057E, accepting.sent().control_word) << function;
  }
}

TEST(SignalsTest, AFunctionThatCouldNotBeReadRefusesTheBit) {
  SignalSetup accepted = output(SignalSource::kBusInBit, 0);
  accepted.may_move = true;
  Signals bench{{accepted}};
  bench.transport.parameters.erase(480);
  bench.run(120);
  bench.command(true);
  bench.run(2);
  EXPECT_EQ(0, bench.sent().setpoints[1]);
  EXPECT_THAT(bench.events(), Contains(HasSubstr("P480[-01], what its bit does in the inverter, could not be read")));
}

// P480 is being written: nobody knows what the bit does before it was read again.
TEST(SignalsTest, ABitIsLowWhileItsFunctionIsWritten) {
  SignalSetup held = output(SignalSource::kBusInBit, 0);
  held.hold = true;
  Signals bench{{held}};
  bench.run(120);
  bench.command(true);
  bench.step();
  ASSERT_EQ(1, bench.sent().setpoints[1]);
  bench.transport.hold_answers = true;
  Request request = test::writeRequest(CycleBench::kLift, 480, 1);
  request.patience = std::chrono::seconds{3};
  request.id = 77;
  bench.ports.submit(request);
  bench.run(2);
  EXPECT_EQ(0, bench.sent().setpoints[1]);
}

// A drive that is lost and comes back may be another one: its P480 counts, when it has been read.
TEST(SignalsTest, ABitIsLowUntilADriveThatCameBackWasAsked) {
  SignalSetup held = output(SignalSource::kBusInBit, 0);
  held.hold = true;
  Signals bench{{held}};
  bench.run(120);
  bench.command(true);
  bench.step();
  ASSERT_EQ(1, bench.sent().setpoints[1]);
  bench.transport.inverters[CycleBench::kLift].silent = true;
  bench.run(20);
  bench.transport.parameters[480] = 1;
  bench.transport.inverters[CycleBench::kLift].silent = false;
  for (int i = 0; i < 120; ++i) {
    bench.step();
    ASSERT_EQ(0, bench.sent().setpoints[1]) << i;
  }
}

TEST(SignalsTest, AQuickStopTakesAwayWhatMayMove) {
  SignalSetup accepted = output(SignalSource::kControlBit, 9);
  accepted.may_move = true;
  Signals bench{{accepted}};
  bench.transport.parameters[480] = 1;
  bench.run(120);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable, CycleBench::kLift).success);
  bench.commandLift(50.0);
  bench.run(20);
  bench.command(true);
  bench.run(2);
  ASSERT_EQ(0x067F, bench.sent().control_word);
  Request stop;
  stop.kind = RequestKind::kQuickStop;
  bench.ports.submit(stop);
  bench.step();
  EXPECT_EQ(0x047B, bench.sent().control_word);
}

// A bit that stays off is told once, and not while what P480 says is being read again; outputs of the module have no
// function in the inverter and are never held back.
TEST(SignalsTest, WhatStaysOffIsToldOnceItsFunctionIsKnown) {
  WordSetup setup;
  setup.signals = {output(SignalSource::kModuleOutput, 1), output(SignalSource::kBusInBit, 0)};
  DriveWords words{setup, profile::Series::kSk2xxe, 3};
  DeviceData device;
  device.bus_bit_functions.push_back(1);  // enable right
  EXPECT_FALSE(words.pollFinding("lift", device, true));
  const auto told = words.pollFinding("lift", device, false);
  ASSERT_TRUE(told);
  EXPECT_THAT(told->str(), HasSubstr("P480[-01] is 1"));
  EXPECT_FALSE(words.pollFinding("lift", device, false)) << "told";
  device.bus_bit_functions[0] = 2;
  EXPECT_TRUE(words.pollFinding("lift", device, false)) << "another function";
  device.bus_bit_functions[0] = 0;
  EXPECT_FALSE(words.pollFinding("lift", device, false)) << "it is on now";
}

// What is read: the layouts of "digital I/O status" differ by series.
TEST(SignalsTest, InputsAreReadFromTheWordThatCarriesThem) {
  DriveSnapshot drive;
  drive.online = true;
  drive.module_answers = true;
  drive.parameter_set = 2;
  drive.device.word_functions[1].actual_values = {1, 5, 12};
  drive.input.status_word = 0x0B31 | 1u << 10;
  drive.input.actual_values = {0, static_cast<std::int16_t>(0x1000 | 0x0200 | 0x0004), 0x81};
  drive.module_inputs = 0x08;
  const auto value = [&](SignalSource source, std::uint8_t number, profile::Series series) {
    return signalValue(output(source, number), series, drive);
  };
  constexpr auto kSk5 = profile::Series::kSk5xxe;
  EXPECT_EQ(1.0, value(SignalSource::kDigitalInput, 3, kSk5));
  EXPECT_EQ(0.0, value(SignalSource::kDigitalInput, 1, kSk5));
  EXPECT_EQ(1.0, value(SignalSource::kDigitalInput, 8, profile::Series::kSk54xe)) << "bit 9";
  EXPECT_EQ(1.0, value(SignalSource::kDigitalInput, 10, profile::Series::kSk700e)) << "bit 9, too";
  EXPECT_EQ(1.0, value(SignalSource::kRelay, 1, kSk5));
  EXPECT_EQ(0.0, value(SignalSource::kRelay, 2, kSk5));
  EXPECT_EQ(1.0, value(SignalSource::kBusOutBit, 0, kSk5));
  EXPECT_EQ(1.0, value(SignalSource::kBusOutBit, 7, kSk5));
  EXPECT_EQ(0.0, value(SignalSource::kBusOutBit, 1, kSk5));
  EXPECT_EQ(1.0, value(SignalSource::kStatusBit, 10, kSk5));
  EXPECT_EQ(0.0, value(SignalSource::kStatusBit, 13, kSk5));
  EXPECT_EQ(1.0, value(SignalSource::kModuleInput, 4, kSk5));
  EXPECT_EQ(0.0, value(SignalSource::kModuleInput, 1, kSk5));
  EXPECT_EQ(std::nullopt, value(SignalSource::kAnalogInput, 1, kSk5)) << "no word carries it";
  drive.device.word_functions[1].actual_values[2] = 17;
  drive.input.actual_values[2] = -8192;
  EXPECT_EQ(-50.0, value(SignalSource::kAnalogInput, 1, kSk5));
  drive.words = 2;
  EXPECT_EQ(std::nullopt, value(SignalSource::kAnalogInput, 1, kSk5)) << "the bus does not carry that word";
  drive.words = 3;
  drive.parameter_set = 1;
  EXPECT_EQ(std::nullopt, value(SignalSource::kDigitalInput, 3, kSk5)) << "another set, other words";
  drive.online = false;
  EXPECT_EQ(std::nullopt, value(SignalSource::kStatusBit, 10, kSk5));
  EXPECT_EQ(1.0, value(SignalSource::kModuleInput, 4, kSk5)) << "its own supply";
}

// The words of each of the four sets; what a bus module or its drive does not tell, nobody knows.
TEST(SignalsTest, InputsAreThoseOfTheSetInForce) {
  DriveSnapshot drive;
  drive.online = true;
  drive.input.actual_values = {0, 1, 0};
  drive.module_inputs = 0xFF;
  const auto value = [&drive](SignalSource source) {
    return signalValue(output(source, 1), profile::Series::kSk5xxe, drive);
  };
  for (std::uint8_t set = 1; set <= 4; ++set) {
    drive.device = {};
    drive.device.word_functions[set - 1u].actual_values = {1, 5, 0};
    for (std::uint8_t in_force = 1; in_force <= 4; ++in_force) {
      drive.parameter_set = in_force;
      EXPECT_EQ(in_force == set, value(SignalSource::kDigitalInput).has_value()) << unsigned{set};
    }
  }
  EXPECT_EQ(1.0, value(SignalSource::kDigitalInput));
  drive.online = false;
  EXPECT_EQ(std::nullopt, value(SignalSource::kDigitalInput));
  EXPECT_EQ(std::nullopt, value(SignalSource::kModuleInput));
  drive.module_answers = true;
  EXPECT_EQ(1.0, value(SignalSource::kModuleInput));
}

}  // namespace
}  // namespace nord_driver::cycle
