// A drive that positions in the bus cycle: what has to be known before it is enabled, and what is told of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/positioning_lift.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

/// Whose count can be set anew by a bit.
class LiftCycle : public ::testing::Test, protected PositioningLift {
 protected:
  explicit LiftCycle(const CycleConfig& config = LiftCycle::config()) : PositioningLift{config} {}
  static CycleConfig config() {
    CycleConfig config = PositioningLift::config();
    config.drives[0].position->reset = PositionBit{PositionBit::Carrier::kControlBit, 9, 61};
    return config;
  }
  std::string enable() { return ask(RequestKind::kEnable, 0).message.str(); }
};

TEST_F(LiftCycle, IsEnabledWhereItPositionsAndItsTargetComesFromHere) {
  run(80);
  EXPECT_TRUE(ask(RequestKind::kEnable, 0).success) << enable();
}

TEST_F(LiftCycle, IsNotEnabledWhereItDoesNotPosition) {
  transport.parameters[600] = 0;
  run(80);
  EXPECT_THAT(enable(), HasSubstr("drive lift: P600 is 0: with 0 it does not position"));
}

TEST_F(LiftCycle, IsNotEnabledWhereItsTargetComesFromElsewhere) {
  transport.parameters[610] = 1;
  run(80);
  EXPECT_THAT(enable(), HasSubstr("drive lift: P610 is 1: its target comes from elsewhere; set P610 to 2"));
}

// A position of 0 would be a place; nobody has heard of one yet.
TEST_F(LiftCycle, StandsNowhereBeforeItsPositionIsHeard) {
  EXPECT_EQ(0.0, snapshot().drives[0].joint_position);
  transport.inverters[0].silent = true;
  run(20);
  EXPECT_FALSE(snapshot().drives[0].joint_known);
  transport.inverters[0].silent = false;
  run(80);
  EXPECT_TRUE(snapshot().drives[0].joint_known);
  EXPECT_NEAR(0.5, snapshot().drives[0].joint_position, 1e-9);
  transport.inverters[0].silent = true;
  run(20);
  EXPECT_FALSE(snapshot().drives[0].position);
  EXPECT_TRUE(snapshot().drives[0].joint_known);
  EXPECT_NEAR(0.5, snapshot().drives[0].joint_position, 1e-9) << "the last one known";
}

// Its low word alone would be taken for a position of 16 bits, 65.536 revolutions away.
TEST_F(LiftCycle, StandsNowhereWhileTheHighWordIsNotKnown) {
  transport.parameters.erase(545);
  run(80);
  EXPECT_FALSE(snapshot().drives[0].joint_known);
  EXPECT_FALSE(snapshot().drives[0].position);
}

TEST_F(LiftCycle, TellsThatItsCountWasSetAnew) {
  transport.parameters[480] = 61;  // each bit of P480
  run(80);
  Request request;
  request.kind = RequestKind::kResetPosition;
  request.drive = 0;
  request.id = ++last_id;
  request.patience = std::chrono::seconds{5};
  ports.submit(request);
  for (int i = 0; i < 300 && completions.count(last_id) == 0; ++i) {
    step();
    if ((controlWord(0) & 0x0200) != 0) transport.inverters[0].second = 0;
  }
  const Completion answer = completions[last_id];
  EXPECT_TRUE(answer.success);
  EXPECT_EQ("drive lift: its count was set anew, its position is 0", answer.message.str());
}

class LiftOfASlowCycle : public LiftCycle {
 protected:
  LiftOfASlowCycle() : LiftCycle{atOneHertz()} { transport.parameters[480] = 61; }
  static CycleConfig atOneHertz() {
    CycleConfig config = LiftCycle::config();
    config.cycle_rate = 1.0;
    return config;
  }
  void slowStep() {
    step();
    transport.time += std::chrono::seconds{1} - kCycle;
  }
};

// Four answers, a second each: longer than the 2 s that are enough at other rates.
TEST_F(LiftOfASlowCycle, HasTheTimeToSetItsCountAnew) {
  for (int i = 0; i < 80; ++i) slowStep();
  Request request;
  request.kind = RequestKind::kResetPosition;
  request.drive = 0;
  request.id = ++last_id;
  request.patience = std::chrono::seconds{13};
  ports.submit(request);
  for (int i = 0; i < 15 && completions.count(last_id) == 0; ++i) {
    slowStep();
    if ((controlWord(0) & 0x0200) != 0) transport.inverters[0].second = 0;
  }
  EXPECT_EQ("drive lift: its count was set anew, its position is 0", completions[last_id].message.str());
  EXPECT_TRUE(completions[last_id].success);
}

class LiftThatTellsItsReference : public LiftCycle {
 protected:
  LiftThatTellsItsReference() : LiftCycle{withReference()} { transport.parameters[481] = 20; }
  static CycleConfig withReference() {
    CycleConfig config = LiftCycle::config();
    SignalSetup referenced;
    referenced.source = SignalSource::kStatusBit;
    referenced.number = 10;
    config.drives[0].position->referenced = referenced;
    config.drives[0].position->referenced_function = 20;
    return config;
  }
};

// A cycle without its answer, as every other one of a slow bus may be, does not say that its reference is lost.
TEST_F(LiftThatTellsItsReference, IsHomedAlsoInACycleWithoutItsAnswer) {
  transport.inverters[0].more = 0x0400;
  run(80);
  ASSERT_TRUE(snapshot().drives[0].homed);
  transport.inverters[0].silent = true;
  step();
  EXPECT_TRUE(snapshot().drives[0].online);
  EXPECT_TRUE(snapshot().drives[0].homed);
  run(20);
  EXPECT_FALSE(snapshot().drives[0].homed) << "offline";
  transport.inverters[0].silent = false;
  transport.inverters[0].more = 0;
  run(2);
  EXPECT_TRUE(snapshot().drives[0].online);
  EXPECT_FALSE(snapshot().drives[0].homed);
}

}  // namespace
}  // namespace nord_driver::cycle
