// Positions in the PDOs of BU 0060 p. 59: word by word in PDO 2, as 32 bits in PDO 3. 70.000 revolutions are 0001 1170h,
// on CAN the low byte first.

#include <gtest/gtest.h>

#include "sim/canopen/can_conversation.h"

namespace nord_driver::sim {
namespace {

SimConfig axis(Series series, const std::vector<ParameterPreset>& parameters) {
  SimConfig config = oneCanDrive();
  DriveConfig& drive = config.drives[0];
  drive.device.series = series;
  drive.parameters = parameters;
  drive.parameters.push_back({600, 0, 0, 1});
  drive.parameters.push_back({102, 0, 0, 50});
  drive.parameters.push_back({103, 0, 0, 50});
  return config;
}

/// TPDO 1 off, `tpdo` on, operational.
void startWith(CanConversation& bus, const std::string& object, const std::string& identifier) {
  bus.boot();
  bus.sdo("23 00 18 01 B2 01 00 C0");
  bus.sdo("23 " + object + " 01 " + identifier + " 00 40");
  bus.start();
}

TEST(CanPositions, TwoWordsOfSk53xe) {
  CanConversation bus{axis(Series::kSk5xxe, {{546, 0, 0, 21}, {547, 0, 0, 22}, {543, 0, 0, 10}, {544, 0, 0, 15}})};
  startWith(bus, "01 18", "B2 02");
  bus.repeat("332#7E04000000000000", seconds(0.1), "2B2");
  EXPECT_EQ("2B2#370B701101000000", bus.repeat("332#7F04701101000000", seconds(6.0), "2B2"));
  EXPECT_NEAR(70.0, bus.drive().position(), 0.0005);
}

TEST(CanPositions, ThirtyTwoBitsOfSk700eInPdo3) {
  CanConversation bus{axis(Series::kSk700e, {{546, 0, 0, 3}, {543, 0, 0, 6}, {544, 0, 0, 8}})};
  startWith(bus, "02 18", "B2 03");
  bus.repeat("432#7E04000000000000", seconds(0.1), "3B2");
  EXPECT_EQ("3B2#370B701101000000", bus.repeat("432#7F04701101000000", seconds(6.0), "3B2"));
  EXPECT_EQ("3B2#370B90EEFEFF0000", bus.repeat("432#7F0490EEFEFF0000", seconds(10.0), "3B2"));
  EXPECT_NEAR(-70.0, bus.drive().position(), 0.0005);
  EXPECT_EQ("4302300490EEFEFF", bus.sdo("40 02 30 04 00 00 00 00"));
}

// The same 32 bits in words 2 and 3 of PDO 2, where the low word comes first, too.
TEST(CanPositions, ThirtyTwoBitsOfSk700eInPdo2) {
  CanConversation bus{axis(Series::kSk700e, {{546, 0, 0, 3}, {543, 0, 0, 6}, {544, 0, 0, 8}})};
  startWith(bus, "01 18", "B2 02");
  bus.repeat("332#7E04000000000000", seconds(0.1), "2B2");
  EXPECT_EQ("2B2#370B701101000000", bus.repeat("332#7F04701101000000", seconds(6.0), "2B2"));
  EXPECT_NEAR(70.0, bus.drive().position(), 0.0005);
}

}  // namespace
}  // namespace nord_driver::sim
