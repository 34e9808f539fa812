// "The 16 and 32 bit process data must be sent in little endian format": BU 0280 4.2.1.1, whose example has a position
// of 32 bits in setpoints 1 and 2 and a speed in setpoint 3. 70.000 revolutions are 0001 1170h.

#include <gtest/gtest.h>

#include "sim/devicenet/dn_conversation.h"

namespace nord_driver::sim {
namespace {

SimConfig axis(SimConfig config, Series series, const std::vector<ParameterPreset>& parameters) {
  DriveConfig& drive = config.drives[0];
  drive.device.series = series;
  drive.parameters = parameters;
  drive.parameters.push_back({102, 0, 0, 50});
  drive.parameters.push_back({103, 0, 0, 50});
  return config;
}

TEST(DnPositions, ThirtyTwoBitsAndASpeed) {
  DnConversation bus{axis(dnGateway(1, 101), Series::kSk2xxe,
                          {{600, 0, 0, 2},
                           {546, 0, 0, 23},
                           {546, 0, 1, 24},
                           {546, 0, 2, 1},
                           {543, 0, 0, 10},
                           {543, 0, 1, 15},
                           {543, 0, 2, 1}})};
  bus.connect();
  bus.poll("44D#7E 04 00 00 00 00 00 00", seconds(0.5));
  EXPECT_EQ("3C9#370B701101000000", bus.poll("44D#7F 04 70 11 01 00 00 40", seconds(6.0)));
  EXPECT_NEAR(70.0, bus.drive().position(), 0.0005);
  EXPECT_EQ("3C9#370BFFFFFFFF0000", bus.poll("44D#7F 04 FF FF FF FF 00 40", seconds(6.0)));
}

TEST(DnPositions, SixteenBits) {
  DnConversation bus{axis(oneDnDrive(101), Series::kSk5xxe, {{600, 0, 0, 1}, {546, 0, 0, 21}, {543, 0, 0, 10}})};
  bus.connect();
  bus.poll("44D#7E 04 00 00 00 00 00 00", seconds(0.5));
  EXPECT_EQ("3C9#370BFF7F00000000", bus.poll("44D#7F 04 FF 7F 00 00 00 00", seconds(5.0)));
  EXPECT_NEAR(32.767, bus.drive().position(), 0.0005);
}

TEST(DnPositions, TheFieldOfSk700eHasTheLowWordFirst) {
  DnConversation bus{axis(oneDnDrive(101), Series::kSk700e, {{600, 0, 0, 1}, {546, 0, 0, 3}, {543, 0, 0, 6}})};
  bus.connect();
  bus.poll("44D#7E 04 00 00 00 00 00 00", seconds(0.5));
  EXPECT_EQ("3C9#370B701101000000", bus.poll("44D#7F 04 70 11 01 00 00 00", seconds(6.0)));
  EXPECT_NEAR(70.0, bus.drive().position(), 0.0005);
}

/// A position of 16 bits in setpoint 1, and the speed in setpoint 2; actual value 2 is the setpoint position.
SimConfig shortAxis(bool values_in_order) {
  SimConfig config = axis(oneDnDrive(101), Series::kSk700e,
                          {{600, 0, 0, 2}, {546, 0, 0, 2}, {547, 0, 0, 1}, {543, 0, 0, 6}, {544, 0, 0, 7}});
  config.drives[0].bus.as<DnDriveConfig>().values_in_order = values_in_order;
  return config;
}

// "The division to the process data words PZD3 and PZD4 depends on the inverter series": STW, SW1, SW3, SW2 of SK 7x0E
// (BU 0020 7.3.6, BU 0070 6.1.5). 30.000 revolutions are 7530h.
TEST(DnPositions, SixteenBitsAndASpeedOfSk700e) {
  DnConversation bus{shortAxis(false)};
  bus.connect();
  bus.poll("44D#7E 04 00 00 00 00 00 00", seconds(0.5));
  EXPECT_EQ("3C9#370B307500003075", bus.poll("44D#7F 04 30 75 00 00 00 40", seconds(6.0)));
  EXPECT_NEAR(30.0, bus.drive().position(), 0.0005);
}

// BU 0280 4.2.2 has STW, SW1, SW2, SW3: of SK 2xxE, whether of others as well it does not say.
TEST(DnPositions, WordsOfSk700eInOrderWhereSoConfigured) {
  DnConversation bus{shortAxis(true)};
  bus.connect();
  bus.poll("44D#7E 04 00 00 00 00 00 00", seconds(0.5));
  EXPECT_EQ("3C9#370B307530750000", bus.poll("44D#7F 04 30 75 00 40 00 00", seconds(6.0)));
  EXPECT_NEAR(30.0, bus.drive().position(), 0.0005);
}

// The field has the same place either way, and behind it is the one word that is left: setpoint 2.
TEST(DnPositions, TheFieldOfSk700eStandsBeforeTheSpeedInEitherOrder) {
  for (const bool in_order : {false, true}) {
    SimConfig config = shortAxis(in_order);
    for (ParameterPreset& preset : config.drives[0].parameters) {
      if (preset.number == 546) preset.raw = 3;
      if (preset.number == 544) preset.raw = 1;
    }
    DnConversation bus{config};
    bus.connect();
    bus.poll("44D#7E 04 00 00 00 00 00 00", seconds(0.5));
    EXPECT_EQ("3C9#370B701101000000", bus.poll("44D#7F 04 70 11 01 00 00 40", seconds(6.0))) << in_order;
    EXPECT_NEAR(70.0, bus.drive().position(), 0.0005);
  }
}

}  // namespace
}  // namespace nord_driver::sim
