// What moves the target besides a position in the words: array, increments, reference run, teach-in, reset.
// BU 0020 7.3.5, POSICON control bits; the course of each is the simulator's (posicon_settings.h).

#include <gtest/gtest.h>

#include <cmath>

#include "sim/inverter/position_fixture.h"

namespace nord_driver::sim {
namespace {

constexpr Word kReferenceRun = 1u << 6, kReferencePoint = 1u << 7, kTeachIn = 1u << 8, kQuit = 1u << 9,
               kReset = 1u << 10;
constexpr double kArrived = 0.001;

/// SK 700E with POSICON control bits in SW1, a frequency in SW2.
struct ControlBits : ::testing::Test {
  static PosiconSettings withSwitch(EncoderKind kind) {
    PosiconSettings settings;
    settings.encoder = kind;
    settings.reference_switch = -2.0;
    return settings;
  }

  explicit ControlBits(EncoderKind kind = EncoderKind::kAbsolute) : axis(Series::kSk700e, withSwitch(kind)) {
    axis.words({4, 1, 0}, {6, 0, 0});
    axis.preset(613, 3'000, 0);
    axis.preset(613, -4'000, 1);
    axis.preset(613, 10'000, 4);
    axis.preset(613, -500, 5);
  }
  void enable(Word bits = 0) {
    axis.send(0x047E, {bits, 0, 0});
    axis.hold(0x047F, {bits, 0, 0}, 0.05);
  }
  void hold(Word bits, double span = 4.0, Word frequency = 0) { axis.hold(0x047F, {bits, frequency, 0}, span); }

  Axis axis;
};

TEST_F(ControlBits, ChooseAnElementOfTheArray) {
  enable();
  hold(1);
  EXPECT_NEAR(3.0, axis.position(), kArrived);
  hold(2);
  EXPECT_NEAR(-4.0, axis.position(), kArrived);
  hold(5);
  EXPECT_NEAR(10.0, axis.position(), kArrived);
  EXPECT_TRUE(axis.reached());
}

TEST_F(ControlBits, ZeroChoosesNone) {
  enable();
  hold(1);
  hold(0);
  EXPECT_NEAR(3.0, axis.position(), kArrived);
}

// Trap: what was asked for before a stop must not go on by itself.
TEST_F(ControlBits, EnabledAnewWithoutAChoiceItStands) {
  enable();
  axis.preset(426, 50);
  hold(5, 0.3);
  axis.hold(0x047B, {0, 0, 0}, 20.0);
  const double rest = axis.position();
  EXPECT_LT(rest, 9.0);
  enable();
  hold(0);
  EXPECT_NEAR(rest, axis.position(), kArrived);
}

TEST_F(ControlBits, WithP610EachRisingBitAddsItsIncrement) {
  axis.preset(610, 1);
  enable();
  hold(1);
  EXPECT_NEAR(3.0, axis.position(), kArrived);
  hold(1);
  EXPECT_NEAR(3.0, axis.position(), kArrived) << "a standing bit adds nothing";
  hold(0, 0.1);
  hold(1);
  EXPECT_NEAR(6.0, axis.position(), kArrived);
  hold(1 | 1u << 5);
  EXPECT_NEAR(5.5, axis.position(), kArrived);
}

TEST_F(ControlBits, AnIncrementWhileDisabledCountsForNothing) {
  axis.preset(610, 1);
  axis.send(0x047E, {0, 0, 0});
  axis.send(0x047E, {1, 0, 0});
  EXPECT_TRUE(axis.reached());
  enable(1);
  hold(1);
  EXPECT_NEAR(0.0, axis.position(), kArrived);
}

struct IncrementalEncoder : ControlBits {
  IncrementalEncoder() : ControlBits(EncoderKind::kIncremental) {}
};

TEST_F(IncrementalEncoder, TheReferenceRunFindsTheSwitch) {
  EXPECT_FALSE(axis.model.posicon().referenced());
  enable();
  hold(kReferenceRun, 1.0);
  EXPECT_TRUE(axis.model.posicon().referencing());
  EXPECT_FALSE(axis.reached());
  hold(kReferenceRun, 6.0);
  EXPECT_TRUE(axis.model.posicon().referenced());
  EXPECT_TRUE(axis.reached());
  EXPECT_NEAR(0.0, axis.position(), kArrived);
  EXPECT_NEAR(-2.0, axis.motor.angle() / 6.283185307179586, 0.01) << "where the switch is";
  hold(1);
  EXPECT_NEAR(3.0, axis.position(), kArrived);
}

TEST_F(IncrementalEncoder, OnTheSwitchTheRunLeavesItOnly) {
  enable();
  hold(kReferenceRun, 7.0);
  hold(2);  // 4 revolutions beyond the switch
  double farthest = axis.position();
  for (int i = 0; i < 2400; ++i) {
    axis.send(0x047F, {kReferenceRun, 0, 0});
    if (axis.model.posicon().referencing()) farthest = std::min(farthest, axis.position());
  }
  EXPECT_GT(farthest, -4.01);
  EXPECT_NEAR(0.0, axis.position(), kArrived);
}

TEST_F(IncrementalEncoder, TheBusCanSayTheReferencePoint) {
  enable();
  hold(kReferenceRun, 0.3);
  hold(kReferenceRun | kReferencePoint, 1.0);
  hold(kReferenceRun, 2.0);
  EXPECT_TRUE(axis.model.posicon().referenced());
  EXPECT_NEAR(0.0, axis.position(), kArrived);
}

TEST_F(IncrementalEncoder, ARunThatIsTakenBackEnds) {
  enable();
  hold(kReferenceRun, 0.3);
  hold(0, 2.0);
  EXPECT_EQ(0.0, axis.motor.speed());
  EXPECT_FALSE(axis.model.posicon().referenced());
}

TEST_F(IncrementalEncoder, AStopEndsTheRun) {
  enable();
  hold(kReferenceRun, 0.3);
  axis.hold(0x047B, {kReferenceRun, 0, 0}, 3.0);
  const double rest = axis.position();
  axis.hold(0x047F, {kReferenceRun, 0, 0}, 3.0);
  EXPECT_EQ(rest, axis.position());
  EXPECT_FALSE(axis.model.posicon().referencing());
}

TEST_F(IncrementalEncoder, MainsOffForgetTheReferencePoint) {
  enable();
  hold(kReferenceRun, 7.0);
  hold(1);
  axis.hold(0x047E, {1, 0, 0}, 1.0);
  axis.model.setPowered(false);
  axis.run(1.0);
  axis.model.setPowered(true);
  axis.run(1.0);
  EXPECT_FALSE(axis.model.posicon().referenced());
  EXPECT_EQ(0.0, axis.position());
}

TEST_F(ControlBits, AnAbsoluteEncoderKnowsWhereItWasMovedTo) {
  enable();
  hold(1, 0.4);
  axis.model.setPowered(false);  // coasts
  axis.run(30.0);
  const double turned = axis.motor.angle() / 6.283185307179586;
  axis.model.setPowered(true);
  axis.run(1.0);
  EXPECT_NEAR(turned, axis.position(), 1e-9);
  EXPECT_TRUE(axis.model.posicon().referenced());
}

TEST_F(ControlBits, TaughtPositionsAreInTheArray) {
  enable();
  hold(kTeachIn | 3, 1.0, 0x0800);  // by frequency
  hold(kTeachIn | 3, 3.0);
  const double there = axis.position();
  EXPECT_GT(there, 1.0);
  hold(kTeachIn | kQuit | 3, 0.1);
  EXPECT_EQ(std::lround(there * 1000.0), axis.parameters.value(613, 0, 2));
  hold(1);
  hold(3);
  EXPECT_NEAR(there, axis.position(), kArrived);
}

TEST_F(ControlBits, ResetCallsThePlaceZero) {
  enable();
  hold(1);
  hold(0);
  axis.hold(0x047E, {0, 0, 0}, 0.5);
  axis.send(0x047E, {kReset, 0, 0});
  EXPECT_NEAR(0.0, axis.position(), 1e-9);
}

/// SK 53xE: array bits are functions of bus I/O in bits (P480), run and reset those of bits 8 and 9 of the control word.
TEST(BusInBits, CarryWhatControlBitsCarry) {
  PosiconSettings settings;
  settings.encoder = EncoderKind::kIncremental;
  settings.reference_switch = -1.0;
  Axis axis(Series::kSk5xxe, settings);
  axis.words({17, 0, 0}, {10, 15, 12});
  for (unsigned bit = 0; bit < 4; ++bit) axis.preset(480, 55 + static_cast<std::int32_t>(bit), bit);
  axis.preset(480, 22, 10);
  axis.preset(480, 61, 11);
  axis.preset(481, 20, 0);  // bus out bit 0: has a reference point
  axis.preset(481, 21, 9);  // status bit 13: position reached
  axis.preset(613, 2'500, 8);
  axis.send(0x047E, {});
  axis.hold(0x047F, {0, 0, 0}, 0.05);
  EXPECT_EQ(0, axis.actual()[2]);
  axis.hold(0x057F, {0, 0, 0}, 6.0);
  EXPECT_EQ(1, axis.actual()[2]);
  axis.hold(0x047F, {9, 0, 0}, 0.1);
  EXPECT_EQ(0, axis.model.statusWord() & zsw::kBit13);
  axis.hold(0x047F, {9, 0, 0}, 4.0);
  EXPECT_NEAR(2.5, axis.position(), kArrived);
  EXPECT_NE(0, axis.model.statusWord() & zsw::kBit13);
  axis.hold(0x067E, {0, 0, 0}, 0.1);
  EXPECT_NEAR(0.0, axis.position(), kArrived);
}

TEST(SlipFault, AShaftThatCannotFollowTripsWithP630) {
  Axis axis;
  axis.words({21, 22, 0}, {10, 15, 0});
  axis.preset(102, 1);  // 10 ms to 50 Hz: more than the motor can do
  axis.preset(630, 50);
  axis.send(0x047E, {});
  axis.hold(0x047F, {40'000, 0, 0}, 1.0);
  EXPECT_EQ(145, axis.model.faultNumber());
}

}  // namespace
}  // namespace nord_driver::sim
