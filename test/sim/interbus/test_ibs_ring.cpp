// The simulated InterBus ring: telegrams of the manual, lengths and ID codes, and what makes it stand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/interbus/ibs_ring.h"
#include "sim/interbus/ring_settings.h"

namespace nord_driver::sim {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Bench {
  explicit Bench(const SimConfig& config = ringConfig()) : robot(config), ring(robot) {
    run(Duration::zero());
    run(milliseconds{1000});
  }
  void run(Duration span) { ring.advance(now += span); }

  Instant now{std::chrono::hours{1}};
  RobotSim robot;
  IbsRing ring;
};

// BU 0070 7.1, 7.2: 0B70, 047E, 0B31, 047F 2000, 0F37 (bit 10 is of a relay: 0B37).
TEST(IbsRing, AnswersTheTelegramsOfTheManual) {
  Bench bench;
  EXPECT_TRUE(bench.ring.runs());
  EXPECT_THAT(bench.ring.inputs(), ElementsAre(0x0B70, 0, 0x0B70, 0));
  bench.ring.outputs()[0] = 0x047E;
  bench.run(milliseconds{50});
  EXPECT_THAT(bench.ring.inputs(), ElementsAre(0x0B31, 0, 0x0B70, 0));
  bench.ring.outputs() = {0x047F, 0x2000, 0, 0};
  bench.run(milliseconds{5000});
  EXPECT_EQ(0x0B37, bench.ring.inputs()[0]);
  EXPECT_EQ(0x2000, bench.ring.inputs()[1]);
  EXPECT_GT(bench.robot.drive(0).shaftSpeed(), 50.0);
  EXPECT_EQ("no rule broken", bench.ring.report());
  bench.ring.outputs()[0] = 0;
  bench.run(milliseconds{5});
  EXPECT_THAT(bench.ring.report(), HasSubstr("control word without bit 10 to drive0"));
}

// 0.2 ms + (13 * (6 + bytes) + 1.5 * subscribers) / 500 kBd: 0.52 ms for one drive of three words, 0.99 for four.
TEST(IbsRing, ACycleTakesItsTime) {
  EXPECT_NEAR(0.52e-3, toSeconds(Bench{ringConfig(1)}.ring.cycleTime()), 0.01e-3);
  Bench four{ringConfig(4)};
  EXPECT_NEAR(0.99e-3, toSeconds(four.ring.cycleTime()), 0.01e-3);
  const std::uint64_t before = four.ring.cycles();
  four.run(milliseconds{1000});
  EXPECT_NEAR(1.0 / 0.00099, static_cast<double>(four.ring.cycles() - before), 20.0);
}

// Five words and F3h without inverter, then P507 and P551 (BU 0070 4).
TEST(IbsRing, LengthAndIdCodeComeFromTheInverter) {
  SimConfig config = ringConfig();
  config.drives[1].bus = IbsDriveConfig{true, 1, {}, {}};
  Bench bench{config};
  EXPECT_EQ((IbsIdentity{3, 0xF3}), bench.ring.module(0).identity());
  EXPECT_EQ((IbsIdentity{3, 0xE3}), bench.ring.module(1).identity());
  bench.robot.drive(0).setInverterPower(false);
  bench.run(milliseconds{50});
  EXPECT_EQ((IbsIdentity{5, 0xF3}), bench.ring.module(0).identity());
  EXPECT_TRUE(bench.ring.runs()) << "the module has 24 V";
  EXPECT_EQ(0, bench.ring.inputs()[0]);
  EXPECT_NE(0, bench.ring.inputs()[2]);
}

// The ring cannot be started with an inverter off that is to have three words.
TEST(IbsRing, AModuleWithoutPowerStopsItUntilItIsBack) {
  Bench bench;
  bench.ring.module(1).setPowered(false);
  bench.run(milliseconds{10});
  EXPECT_FALSE(bench.ring.runs());
  EXPECT_FALSE(bench.robot.drive(0).inDataExchange());
  const std::uint64_t cycles = bench.ring.cycles();
  bench.robot.drive(1).setInverterPower(false);
  bench.ring.module(1).setPowered(true);
  bench.run(milliseconds{1000});
  EXPECT_FALSE(bench.ring.runs()) << "five words";
  EXPECT_EQ(cycles, bench.ring.cycles());
  bench.robot.drive(1).setInverterPower(true);
  bench.run(milliseconds{1000});
  EXPECT_TRUE(bench.ring.runs());
}

// A change of P507 counts when the mains were off, and then the ring is another one (BU 0070 4.2).
TEST(IbsRing, AChangeOfTheLengthNeedsMainsAndRing) {
  Bench bench;
  bench.robot.drive(0).parameters().preset(507, 0, 0, 2);
  bench.run(milliseconds{1000});
  EXPECT_TRUE(bench.ring.runs());
  bench.robot.drive(0).setInverterPower(false);
  bench.run(milliseconds{100});
  bench.robot.drive(0).setInverterPower(true);
  bench.run(milliseconds{1000});
  EXPECT_FALSE(bench.ring.runs()) << "the master knows three words";
}

TEST(IbsRing, AWordBehindACutCableStaysAsItWas) {
  Bench bench;
  bench.ring.outputs()[0] = 0x047E;
  bench.run(milliseconds{50});
  bench.ring.setCut(true);
  bench.ring.outputs()[0] = 0x047F;
  bench.run(milliseconds{500});
  EXPECT_FALSE(bench.ring.runs());
  EXPECT_EQ(0x0B31, bench.ring.inputs()[0]);
  bench.ring.setCut(false);
  bench.run(milliseconds{500});
  EXPECT_EQ(0x0B37, bench.ring.inputs()[0]);
}

// SK 700E: SW1, SW3, SW2 and IW1, IW3, IW2 (BU 0070 4.2.2).
TEST(IbsRing, OlderSeriesHaveTheThirdValueBeforeTheSecond) {
  for (const Series series : {Series::kSk700e, Series::kSk5xxe}) {
    SimConfig config = ringConfig(1);
    config.drives[0].device.series = series;
    config.drives[0].bus = IbsDriveConfig{false, 2, {}, {}};
    config.drives[0].parameters = {{544, 0, 0, 8}};  // IW2: the setpoint frequency
    Bench bench{config};
    bench.ring.outputs()[0] = 0x047E;
    bench.run(milliseconds{50});
    bench.ring.outputs() = {0x047F, 0x1000, 0, 0};
    bench.run(milliseconds{3000});
    const std::size_t second = series == Series::kSk700e ? 3 : 2;
    EXPECT_EQ(0x1000, bench.ring.inputs()[second]) << static_cast<int>(series);
    EXPECT_EQ(0, bench.ring.inputs()[5 - second]);
  }
}

// Profile DRIVECOM: 007F and rpm; 1500 rpm are 50 Hz at two pole pairs (BU 0070 4.2.1, 6.4.2).
TEST(IbsRing, DrivecomTakesRpm) {
  SimConfig config = ringConfig(1);
  config.drives[0].bus = IbsDriveConfig{true, 1, {}, {}};
  Bench bench{config};
  bench.ring.outputs() = {0x007E, 0};
  bench.run(milliseconds{50});
  EXPECT_EQ(0x0631, bench.ring.inputs()[0]) << "remote and setpoint reached are bits 9 and 10";
  bench.ring.outputs() = {0x007F, 750};
  bench.run(milliseconds{5000});
  EXPECT_NEAR(750.0, toSigned(bench.ring.inputs()[1]), 40.0);
}

// P513 > 0 trips when no valid word comes from the ring, whether it stands or carries zeros; 0 watches nothing.
TEST(IbsRing, P513WatchesTheWords) {
  for (const bool cut : {false, true}) {
    for (const std::int32_t p513 : {0, 2}) {
      SimConfig config = ringConfig(1);
      config.drives[0].parameters = {{513, 0, 0, p513}};
      Bench bench{config};
      bench.ring.outputs()[0] = 0x047E;
      bench.run(milliseconds{50});
      bench.ring.outputs() = {0x047F, 0x2000};
      bench.run(milliseconds{2000});
      bench.ring.setCut(cut);
      if (!cut) bench.ring.outputs() = {0, 0};
      bench.run(milliseconds{1000});
      EXPECT_EQ(p513 > 0 ? fault::kBusTimeout : 0, bench.robot.drive(0).inverter().faultNumber()) << p513 << cut;
      EXPECT_EQ(p513 == 0, bench.robot.drive(0).inverter().state() == InverterState::kOperationEnabled);
    }
  }
}

TEST(IbsRing, WordsHaveTheirPlaces) {
  SimConfig config = ringConfig(3);
  config.bus.as<IbsBusConfig>().pcp_word = true;
  config.drives[0].address = 9;
  config.drives[2].bus = IbsDriveConfig{false, 1, 10u, 20u};
  Bench bench{config};
  ASSERT_EQ(16u, bench.ring.inputs().size());
  EXPECT_EQ(0x0B70, bench.ring.inputs()[1]) << "drive1 at place 2";
  EXPECT_EQ(0x0B70, bench.ring.inputs()[11]) << "drive2 at place 3";
  EXPECT_EQ(0x0B70, bench.ring.inputs()[14]) << "drive0 at place 9";
  config.drives[2].bus = IbsDriveConfig{false, 1, 1u, {}};
  EXPECT_THROW(Bench{config}, ConfigError);
}

}  // namespace
}  // namespace nord_driver::sim
