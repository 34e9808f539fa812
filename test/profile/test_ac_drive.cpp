// The AC drive profile of DeviceNet and NORD's own words, one told as the other (BU 0280 4.2.3).
#include <gtest/gtest.h>

#include "profile/ac_drive.h"
#include "profile/status_word.h"

namespace nord_driver::profile {
namespace {

constexpr int kPolePairs = 2;

/// P105 = 50 Hz: 100 % are 1500 rpm.
AcDriveScaling scaling(AcDriveKind kind = AcDriveKind::kExtended) {
  AcDriveScaling result{kind, kPolePairs};
  result.setMaxFrequency(Hertz{50.0});
  return result;
}
DriveState stateOf(AcDriveKind kind, AcDriveInput input) {
  return StatusWord{scaling(kind).fromAcDrive(input).status_word}.state();
}

TEST(AcDrive, RunsForwardAndReverse) {
  AcDriveOutput output = scaling().toAcDrive({0x047F, {8192}});
  EXPECT_EQ(0x61, output.control) << "run forward, net control, net reference";
  EXPECT_EQ(750, output.speed);
  output = scaling().toAcDrive({0x047F, {-16384}});
  EXPECT_EQ(0x62, output.control);
  EXPECT_EQ(1500, output.speed);
  output = scaling().toAcDrive({0x147F, {16384}});
  EXPECT_EQ(0x62, output.control) << "rotation left, bit 12";
}

// With P104 > 0 an enabled motor turns at 0 rpm, to the right, and not where it was to turn.
TEST(AcDrive, TheSmallestSetpointKeepsItsDirection) {
  for (const std::int16_t share : std::initializer_list<std::int16_t>{1, 2, 5, 10}) {
    AcDriveOutput output = scaling().toAcDrive({0x047F, {share}});
    EXPECT_EQ(0x61, output.control) << share;
    EXPECT_EQ(1, output.speed) << share;
    output = scaling().toAcDrive({0x047F, {static_cast<std::int16_t>(-share)}});
    EXPECT_EQ(0x62, output.control) << share;
    EXPECT_EQ(1, output.speed) << share;
    output = scaling().toAcDrive({0x147F, {share}});
    EXPECT_EQ(0x62, output.control) << "rotation left, bit 12";
    EXPECT_EQ(1, output.speed) << share;
  }
  EXPECT_EQ(2, scaling().toAcDrive({0x047F, {17}}).speed) << "1.56 rpm";
  EXPECT_EQ(0, scaling().toAcDrive({0x147F, {0}}).speed);
}

// Whatever is not "operation enabled" is a ramp to 0 rpm, then off.
TEST(AcDrive, EveryOtherWordStops) {
  for (const Word word : std::initializer_list<Word>{0x0000, 0x007F, 0x047E, 0x047B, 0x047D, 0x046F, 0x043F}) {
    const AcDriveOutput output = scaling().toAcDrive({word, {16384}});
    EXPECT_EQ(0x60, output.control) << word;
    EXPECT_EQ(0, output.speed) << word;
  }
  EXPECT_EQ(0x64, scaling().toAcDrive({0x04FE, {}}).control) << "fault reset";
  EXPECT_EQ(0x60, scaling().toAcDrive({0x00FE, {}}).control) << "bit 10: to be ignored";
}

// Assembly 20 has "run forward" only: better no speed than one in the wrong direction.
TEST(AcDrive, ProfileOneStandsStillWhereReverseIsCommanded) {
  AcDriveOutput output = scaling(AcDriveKind::kBasic).toAcDrive({0x047F, {8192}});
  EXPECT_EQ(0x01, output.control);
  EXPECT_EQ(750, output.speed);
  output = scaling(AcDriveKind::kBasic).toAcDrive({0x047F, {-8192}});
  EXPECT_EQ(0x01, output.control);
  EXPECT_EQ(0, output.speed);
}

TEST(AcDrive, WithoutAMaximumFrequencyThereIsNoSpeed) {
  const AcDriveScaling unscaled{AcDriveKind::kExtended, kPolePairs};
  EXPECT_EQ(0, unscaled.toAcDrive({0x047F, {16384}}).speed);
  EXPECT_EQ(0, unscaled.toAcDrive({0x047F, {-16384}}).speed);
  EXPECT_EQ(0, unscaled.fromAcDrive({0xF4, 4, 1500}).actual_values[0]);
}

// Class 41, attribute 6 (BU 0280 4.3.6).
TEST(AcDrive, TheDriveStateBecomesNordsState) {
  const auto of = [](std::uint8_t state) { return stateOf(AcDriveKind::kExtended, {0x60, state, 0}); };
  EXPECT_EQ(DriveState::kNotReadyToSwitchOn, of(1));
  EXPECT_EQ(DriveState::kSwitchOnDisabled, of(2));
  EXPECT_EQ(DriveState::kReadyToSwitchOn, of(3));
  EXPECT_EQ(DriveState::kOperationEnabled, of(4));
  EXPECT_EQ(DriveState::kOperationEnabled, of(5));
  EXPECT_EQ(DriveState::kFaultReactionActive, of(6));
  EXPECT_EQ(DriveState::kFault, of(7));
  EXPECT_EQ(0, statusOfSupervisor(0));
  EXPECT_EQ(0, statusOfSupervisor(8));
}

TEST(AcDrive, BitsAreTold) {
  const StatusWord word{scaling().fromAcDrive({0xF6, 4, 1500}).status_word};
  EXPECT_TRUE(word.warning() && word.setpointReached() && word.busControl() && word.directionRight());
  const StatusWord local{scaling().fromAcDrive({0x24, 4, 1500}).status_word};
  EXPECT_FALSE(local.busControl()) << "the setpoint comes from elsewhere";
  EXPECT_TRUE(StatusWord{scaling().fromAcDrive({0x68, 4, 100}).status_word}.directionLeft());
}

// Byte 0 of assembly 71 (BU 0280 4.2.3), a bit at a time beside "enabled": each says one thing and no other.
TEST(AcDrive, EachBitOfTheStatusSaysOneThing) {
  const auto of = [](unsigned bits) {
    return scaling().fromAcDrive({static_cast<std::uint8_t>(bits), 4, 0}).status_word;
  };
  const Word enabled = 0x0837;  // right, and nothing more
  EXPECT_EQ(enabled, of(0x00));
  EXPECT_EQ(enabled, of(0x01)) << "the state alone says whether it is a fault";
  EXPECT_EQ(enabled | 0x0080, of(0x02)) << "warning";
  EXPECT_EQ(enabled, of(0x04)) << "running forward";
  EXPECT_EQ(0x1037, of(0x08)) << "running in reverse: left";
  EXPECT_EQ(enabled, of(0x10)) << "ready";
  EXPECT_EQ(enabled, of(0x20)) << "control from net, but not the reference";
  EXPECT_EQ(enabled, of(0x40)) << "reference from net, but not the control";
  EXPECT_EQ(enabled | 0x0200, of(0x60)) << "both: the bus has control";
  EXPECT_EQ(enabled | 0x0100, of(0x80)) << "at reference";
}

// A state that is none: the bits alone decide.
TEST(AcDrive, WithoutAKnownStateTheBitsDecide) {
  const auto of = [](unsigned bits) {
    return stateOf(AcDriveKind::kExtended, {static_cast<std::uint8_t>(bits), 0, 0});
  };
  EXPECT_EQ(DriveState::kFault, of(0x61));
  EXPECT_EQ(DriveState::kOperationEnabled, of(0x64));
  EXPECT_EQ(DriveState::kOperationEnabled, of(0x68));
  EXPECT_EQ(DriveState::kNotReadyToSwitchOn, of(0x60));
  EXPECT_EQ(DriveState::kNotReadyToSwitchOn, of(0x62)) << "a warning starts nothing";
}

TEST(AcDrive, BytesBeforeTheFirstTelegramSayNothing) {
  const AcDriveInput from;
  EXPECT_EQ(0, from.status);
  EXPECT_EQ(0, from.state);
  EXPECT_EQ(0, from.speed);
  EXPECT_EQ(0, scaling().fromAcDrive(from).status_word);
  const AcDriveOutput to;
  EXPECT_EQ(0, to.control);
  EXPECT_EQ(0, to.speed);
}

TEST(AcDrive, SpeedIsAShareOfP105) {
  EXPECT_EQ(8192, scaling().fromAcDrive({0x64, 4, 750}).actual_values[0]);
  EXPECT_EQ(-8192, scaling().fromAcDrive({0x68, 4, -750}).actual_values[0]);
  EXPECT_EQ(-8192, scaling().fromAcDrive({0x68, 4, 750}).actual_values[0]) << "a speed without a sign";
}

// 48 000 rpm do not fit, nor do 2000 % of P105.
TEST(AcDrive, WhatDoesNotFitIsTheMost) {
  AcDriveScaling fast{AcDriveKind::kExtended, 1};
  fast.setMaxFrequency(Hertz{400.0});
  AcDriveOutput output = fast.toAcDrive({0x047F, {32767}});
  EXPECT_EQ(0x61, output.control);
  EXPECT_EQ(32767, output.speed);
  output = fast.toAcDrive({0x047F, {-32767}});
  EXPECT_EQ(0x62, output.control);
  EXPECT_EQ(32767, output.speed);
  EXPECT_EQ(32767, scaling().fromAcDrive({0x64, 4, 30000}).actual_values[0]);
  EXPECT_EQ(-32767, scaling().fromAcDrive({0x68, 4, 30000}).actual_values[0]);
}

TEST(AcDrive, AllZeroIsNoInverter) {
  EXPECT_EQ(0, scaling().fromAcDrive({0, 0, 0}).status_word);
  EXPECT_EQ(DriveState::kReadyToSwitchOn, stateOf(AcDriveKind::kBasic, {0, 0, 0})) << "profile 1 does not tell";
  EXPECT_EQ(DriveState::kOperationEnabled, stateOf(AcDriveKind::kBasic, {0x04, 0, 700}));
  EXPECT_EQ(DriveState::kFault, stateOf(AcDriveKind::kBasic, {0x01, 0, 0}));
  EXPECT_EQ(0x0A37, scaling(AcDriveKind::kBasic).fromAcDrive({0x04, 0, 700}).status_word) << "under our control, right";
}

}  // namespace
}  // namespace nord_driver::profile
