// Positions in the telegrams of both kinds of PROFIBUS modules, typed by hand.
// 70.000 revolutions are 70000 = 0001 1170h; one step is 0.001 revolutions (BU 0020 7.3.5).

#include <gtest/gtest.h>

#include "sim/profibus/conversation.h"

namespace nord_driver::sim {
namespace {

const Duration kArrival = seconds(6.0);

SimConfig axis(SimConfig config, Series series, const std::vector<ParameterPreset>& parameters) {
  for (DriveConfig& drive : config.drives) {
    drive.device.series = series;
    drive.parameters = parameters;
    drive.parameters.push_back({600, 0, 0, 1});
    drive.parameters.push_back({102, 0, 0, 50});
    drive.parameters.push_back({103, 0, 0, 50});
  }
  return config;
}

/// PPO 2 of a module with ident number 7531h: no parameter order, and six words of process data of which the last two
/// have no use.
struct Ppo2 {
  explicit Ppo2(SimConfig config) : bus(withPpo2(std::move(config))) {
    bus.service(60, {});
    bus.service(61, {0x80, 0, 1, 11, 0x75, 0x31, 0});
    bus.service(62, {0xF3, 0xF5});
    bus.service(60, {});
  }
  static SimConfig withPpo2(SimConfig config) {
    config.drives[0].bus.as<DpDriveConfig>().ppo_type = 2;
    return config;
  }
  std::string words(const std::string& four, Duration span = Duration::zero()) {
    const std::string answer = bus.outputsFor("0000 0000 0000 0000 " + four + " 0000 0000", span);
    return answer.size() > 47 ? answer.substr(24, 23) : answer;
  }

  Conversation bus;
};

// "P546=21 (23) low word, P547=22 (24) high word", SK 53xE: BU 0020 7.3.5.
TEST(DpPositions, Sk53xeHasLowAndHighWord) {
  Ppo2 axis1{axis(oneDrive(), Series::kSk5xxe, {{546, 0, 0, 21}, {547, 0, 0, 22}, {543, 0, 0, 10}, {544, 0, 0, 15}})};
  EXPECT_EQ("0B 31 00 00 00 00 00 00", axis1.words("047E 0000 0000 0000", seconds(0.1)));
  EXPECT_EQ("0B 37 11 70 00 01 00 00", axis1.words("047F 1170 0001 0000", kArrival));
  EXPECT_EQ("0B 37 FF FF FF FF 00 00", axis1.words("047F FFFF FFFF 0000", kArrival));
  EXPECT_NEAR(-0.001, axis1.bus.drive().position(), 0.0005);
}

// The same on the second and the third setpoint, high before low.
TEST(DpPositions, AnyTwoWordsInEitherOrder) {
  Ppo2 axis1{axis(oneDrive(), Series::kSk5xxe, {{547, 0, 0, 24}, {548, 0, 0, 23}, {544, 0, 0, 15}, {545, 0, 0, 10}})};
  axis1.words("047E 0000 0000 0000", seconds(0.1));
  EXPECT_EQ("0B 37 00 00 00 01 11 70", axis1.words("047F 0000 0001 1170", kArrival));
}

// "In the area of the process data as the second and third word", setpoint 2 in PZD4: BU 0020 7.3.5, 7.3.6.
TEST(DpPositions, Sk700eHasAFieldOf32Bits) {
  Ppo2 axis1{axis(oneDrive(), Series::kSk700e, {{546, 0, 0, 3}, {543, 0, 0, 6}, {544, 0, 0, 8}})};
  axis1.words("047E 0000 0000 0000", seconds(0.1));
  EXPECT_EQ("0B 37 00 01 11 70 00 00", axis1.words("047F 0001 1170 0000", kArrival));
  EXPECT_EQ("0B 37 FF FE EE 90 00 00", axis1.words("047F FFFE EE90 0000", seconds(10.0)));
  EXPECT_NEAR(-70.0, axis1.bus.drive().position(), 0.0005);
}

// "+32767 (= 32,767 revolutions) to -32768 (= -32,768 revolutions)", the second word: BU 0020 7.3.5. PPO 1.
TEST(DpPositions, SixteenBitsOfSk700e) {
  Conversation bus{axis(oneDrive(), Series::kSk700e, {{546, 0, 0, 2}, {543, 0, 0, 6}})};
  bus.startUp(0);
  bus.pzdFor("047E 0000", seconds(0.1));
  EXPECT_EQ("0B 37 7F FF", bus.pzdFor("047F 7FFF", kArrival));
  EXPECT_NEAR(32.767, bus.drive().position(), 0.0005);
  EXPECT_EQ("0B 37 80 00", bus.pzdFor("047F 8000", kArrival));
  EXPECT_NEAR(-32.768, bus.drive().position(), 0.0005);
}

// The example of BU 2700 5.3: a setpoint frequency that is the top speed, and a position; FI 1 behind an SK TU4-PBR.
TEST(DpPositions, ASpeedAndAPositionOfSk2xxe) {
  SimConfig config =
      axis(oneModule(1), Series::kSk2xxe,
           {{546, 0, 0, 1}, {546, 0, 1, 23}, {546, 0, 2, 24}, {543, 0, 0, 1}, {543, 0, 1, 10}, {543, 0, 2, 15}});
  for (ParameterPreset& preset : config.drives[0].parameters) {
    if (preset.number == 600) preset.raw = 2;
  }
  Conversation bus{config};
  bus.startUpModule({0x00, 0xF3}, 0);
  bus.outputsFor("047E 0000 0000 0000", seconds(0.1));
  EXPECT_EQ("0B 37 00 00 11 70 00 01", bus.outputsFor("047F 2000 1170 0001", seconds(9.0)));
  EXPECT_NEAR(70.0, bus.drive().position(), 0.0005);
  bus.outputsFor("047F 1000 0000 0000", seconds(3.0));  // a quarter of 50 Hz, back: 6.25 revolutions per second
  EXPECT_NEAR(-12.5, bus.drive().inverter().posicon().speed(), 0.1);
}

// P740 and P741 [-02] have the low word of a 32-bit value 1, [-03] its high word, [-04] value 2: BU 0020 6.1.3.
TEST(DpPositions, Sk700eShowsTheFieldInP740AndP741) {
  Ppo2 axis1{axis(oneDrive(), Series::kSk700e, {{546, 0, 0, 3}, {543, 0, 0, 6}})};
  axis1.words("047E 0000 0000 0000", seconds(0.1));
  axis1.words("047F 0001 1170 0123", kArrival);
  const ParameterStore& parameters = axis1.bus.drive().parameters();
  for (const unsigned number : {740u, 741u}) {
    EXPECT_EQ(0x1170, parameters.value(number, 0, 1)) << number;
    EXPECT_EQ(0x0001, parameters.value(number, 0, 2)) << number;
  }
  EXPECT_EQ(0x0123, parameters.value(740, 0, 3));
}

// A lost master: the shaft coasts, the drive knows its position, and nothing moves before it is enabled anew.
TEST(DpPositions, ALostMasterLosesNoPosition) {
  Conversation bus{axis(oneDrive(), Series::kSk700e, {{546, 0, 0, 2}, {543, 0, 0, 6}})};
  bus.startUp(10);
  bus.pzdFor("047E 0000", seconds(0.1));
  bus.pzdFor("047F 7FFF", seconds(0.8));
  bus.segment.run(seconds(30.0));
  EXPECT_EQ(102, bus.drive().inverter().faultNumber());
  const double rest = bus.drive().shaftAngle() / 6.283185307179586;
  EXPECT_NEAR(rest, bus.drive().position(), 1e-9);
  bus.restartFrameCount();
  bus.startUp(10);
  bus.pzdFor("04FE 7FFF", seconds(0.1));
  bus.pzdFor("047E 7FFF", seconds(1.0));
  EXPECT_EQ(rest, bus.drive().shaftAngle() / 6.283185307179586);
  EXPECT_EQ("0B 37 7F FF", bus.pzdFor("047F 7FFF", kArrival));
}

}  // namespace
}  // namespace nord_driver::sim
