// What the cycle tells of itself, of the bus and of its drives, in its snapshot and besides.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/positioning_lift.h"

namespace nord_driver::cycle {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CyclePicture : public ::testing::Test, protected CycleBench {
 protected:
  const DriveSnapshot& lift() { return snapshot().drives[kLift]; }
};

TEST_F(CyclePicture, SaysWhetherTheBusIsThere) {
  step();
  EXPECT_TRUE(snapshot().connected);
  transport.is_connected = false;
  step();
  EXPECT_FALSE(snapshot().connected);
}

TEST_F(CyclePicture, IsSettledWhileNothingIsEnabled) {
  run(80);
  EXPECT_TRUE(snapshot().settled);
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  EXPECT_FALSE(snapshot().settled);
  ASSERT_TRUE(ask(RequestKind::kDisable, kLift).success);
  run(5);
  EXPECT_TRUE(snapshot().settled);
}

TEST_F(CyclePicture, SaysHowLongCyclesTake) {
  run(150);
  EXPECT_DOUBLE_EQ(0.01, snapshot().times.mean);
  EXPECT_DOUBLE_EQ(0.01, snapshot().times.max);
}

TEST_F(CyclePicture, PassesOnWhatHappenedOnTheBus) {
  BusEvent event;
  event.text = "the wire was cut";
  transport.events.push_back(event);
  event.warning = false;
  event.text = "the wire is whole again";
  transport.events.push_back(event);
  step();
  EXPECT_THAT(events(), ElementsAre("warning: the wire was cut", "info: the wire is whole again"));
}

TEST_F(CyclePicture, HasTheInputsOfTheBusModule) {
  transport.module_inputs = 0x05;
  step();
  EXPECT_EQ(0x05, lift().module_inputs);
  transport.module_inputs = 0;
  step();
  EXPECT_EQ(0, lift().module_inputs);
}

// Of the values beyond them nobody is told anything: they would all be 0.
TEST(CyclePictureOfWords, SaysHowManyTheBusCarries) {
  for (const auto& [carried, told] : {std::pair{0, 1}, {1, 1}, {2, 2}, {3, 3}, {5, 3}}) {
    ScriptedTransport transport{3};
    transport.process_values = static_cast<std::uint8_t>(carried);
    CyclePorts ports{3};
    BusCycle cycle{CycleBench::config(), transport, ports, false};
    cycle.runOnce();
    for (const DriveSnapshot& drive : ports.readSnapshot().drives) EXPECT_EQ(told, drive.words) << carried;
  }
}

struct Onlooker final : CycleObserver {
  void handleCycle(const std::vector<profile::ProcessOutput>& outputs, const std::vector<DriveExchange>& inputs,
                   const CycleSnapshot& snapshot) noexcept override {
    ++cycles;
    control_word = outputs[CycleBench::kLift].control_word;
    status_word = inputs[CycleBench::kLift].input.status_word;
    time = snapshot.time;
  }
  int cycles = 0;
  Word control_word = 0;
  Word status_word = 0;
  Instant time{};
};

TEST_F(CyclePicture, IsShownToWhoeverLooksOnInEachCycle) {
  Onlooker onlooker;
  ports.setObserver(&onlooker);
  run(20);
  EXPECT_EQ(20, onlooker.cycles);
  EXPECT_EQ(0x047E, onlooker.control_word);
  EXPECT_EQ(0x0B31, onlooker.status_word);
  EXPECT_EQ(snapshot().time, onlooker.time);
}

// The first drive is one of the base as any other.
TEST_F(CyclePicture, KnowsNoBaseWhoseFirstDriveHasNotAnswered) {
  transport.inverters[kLeft].silent = true;
  run(10);
  EXPECT_FALSE(snapshot().base.known);
  transport.inverters[kLeft].silent = false;
  run(2);
  EXPECT_TRUE(snapshot().base.known);
}

// The lift is no part of it.
TEST_F(CyclePicture, KnowsABaseWithoutADriveBesideIt) {
  transport.inverters[kLift].silent = true;
  run(10);
  EXPECT_TRUE(snapshot().base.known);
}

TEST_F(CyclePicture, SaysWhyTheBaseStopped) {
  run(80);
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  EXPECT_TRUE(snapshot().base.text.empty());
  EXPECT_FALSE(snapshot().base.stopped);
  transport.inverters[kRight].fault = true;
  run(50);
  EXPECT_TRUE(snapshot().base.stopped);
  EXPECT_THAT(snapshot().base.text.str(), HasSubstr("drive right stopped: a fault"));
}

// What turns by its terminals does not deviate from a command nobody gave.
TEST_F(CyclePicture, ComparesNoSpeedsOfADriveThatIsNotEnabled) {
  run(80);
  transport.inverters[kLift].terminals = true;
  run(400);
  ASSERT_GT(lift().velocity, 10.0);
  EXPECT_EQ(0.0, lift().speed_deviation);
  EXPECT_FALSE(lift().at_speed || lift().not_following);
}

// The speed it was told is the one it may travel with.
TEST(CyclePictureOfALift, ComparesNoSpeedsOfADriveThatPositions) {
  PositioningLift lift;
  ASSERT_TRUE(lift.bringUpAndEnable());
  lift.ports.commandPosition(0, 0.7);
  lift.run(500);
  ASSERT_TRUE(lift.lift().enabled);
  ASSERT_GT(lift.lift().velocity_command, 10.0);
  EXPECT_EQ(0.0, lift.lift().speed_deviation);
  EXPECT_FALSE(lift.lift().at_speed || lift.lift().not_following);
}

// The word of a drive that answers nothing of use says nothing of its reference either.
TEST(CyclePictureOfALift, TakesNoReferenceFromAnOldWord) {
  CycleConfig config = PositioningLift::config();
  SignalSetup referenced;
  referenced.source = SignalSource::kStatusBit;
  referenced.number = 10;
  config.drives[0].position->referenced = referenced;
  config.drives[0].position->referenced_function = 20;
  PositioningLift lift{config};
  lift.transport.parameters[481] = 20;
  lift.transport.inverters[0].more = 0x0400;
  lift.run(80);
  ASSERT_TRUE(lift.lift().homed);
  lift.transport.module_only[0] = true;
  lift.transport.inverters[0].more = 0;
  lift.step();
  EXPECT_TRUE(lift.lift().online);
  EXPECT_TRUE(lift.lift().homed) << "the inverter has said nothing new";
}

}  // namespace
}  // namespace nord_driver::cycle
