// The whole way of a command over InterBus: from a twist to the registers of the gateway, the words of BU 0070 7, and
// back to odometry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "system/interbus_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr std::size_t kUnitAndHeader = 7;

/// Function and data of the telegrams that move one image, each once until it changes.
class Telegrams {
 public:
  explicit Telegrams(InterbusRobot& robot) {
    robot.gateway().setTap([this](ByteView bytes, sim::SimulatedGateway::Sender sender, Instant) {
      const ByteView pdu = bytes.sub(kUnitAndHeader);
      const bool writes = sender == sim::SimulatedGateway::Sender::kDriver && pdu[0] == 16 && pdu[4] == 4;
      const bool reads = sender == sim::SimulatedGateway::Sender::kGateway && pdu[0] == 4 && pdu[1] == 8;
      if (writes) add(toHex(pdu), outputs);
      if (reads) add(toHex(pdu), inputs);
    });
  }
  std::vector<std::string> outputs, inputs;

 private:
  static void add(const std::string& text, std::vector<std::string>& seen) {
    if (seen.empty() || seen.back() != text) seen.push_back(text);
  }
};

// BU 0070 7.1 and 7.2: 0B70; 047E; 0B31; 047F 2000; 0F37 2000 with the relay MFR 1 in bit 10. As registers, high byte
// first: outputs from 100 (0064h) on, inputs from 0 on. The right motor is mounted the other way round: E000 is -2000,
// and 1337 says "left" where 0B37 says "right".
TEST(InterbusDriving, ATwistBecomesTheManualsTelegrams) {
  InterbusRobot::Options options;
  options.slip = 0.001;
  InterbusRobot robot{options};
  robot.gateway().run(seconds{1});  // the inverters have been on for a while
  Telegrams seen{robot};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_THAT(seen.inputs, Contains("04 08 0B 70 00 00 0B 70 00 00"));
  EXPECT_THAT(seen.outputs, Contains("10 00 64 00 04 08 00 00 00 00 00 00 00 00"));
  EXPECT_EQ("10 00 64 00 04 08 04 7E 00 00 04 7E 00 00", seen.outputs.back());
  EXPECT_EQ("04 08 0B 31 00 00 0B 31 00 00", seen.inputs.back());
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
  robot.module(0).setRelay(true);
  robot.drive(kHalfSpeed, 0.0, seconds{5});
  EXPECT_EQ("10 00 64 00 04 08 04 7F 20 00 04 7F E0 00", seen.outputs.back());
  EXPECT_EQ("04 08 0F 37 20 00 13 37 E0 00", seen.inputs.back());
  EXPECT_EQ(0x0F37, robot.statusWord(0));
  const cycle::CycleSnapshot& snapshot = robot.snapshot();
  EXPECT_DOUBLE_EQ(25.0, snapshot.drives[0].frequency);
  EXPECT_NEAR(kHalfSpeed, snapshot.base.velocity.linear_x, 1e-9);
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  const double way = robot.unit(0).wheelAngle() * 0.1;
  EXPECT_GT(way, 1.0);
  EXPECT_NEAR(way, robot.snapshot().base.pose.x, 0.01 * way);
  EXPECT_EQ("no rule broken", robot.referee());
}

// --- Every way the words can lie ---

struct Words {
  const char* name;
  InterbusRobot::Options options;
};

void PrintTo(const Words& words, std::ostream* out) {
  *out << words.name;
}

std::vector<Words> allWords() {
  std::vector<Words> all;
  const auto add = [&all](const char* name) -> InterbusRobot::Options& {
    all.push_back({name, {}});
    all.back().options.slip = 0.001;
    return all.back().options;
  };
  add("Ppo1");
  add("At25Hz").node = {{"cycle_rate", 25.0}};
  add("Ppo2").ppo_type = 2;
  InterbusRobot::Options& older = add("Ppo2OfTheOlderSeries");
  older.ppo_type = 2;
  older.series = "sk700e";
  add("WithThePcpWord").pcp_word = true;
  add("SwappedBytes").swapped = true;
  add("Drivecom").drivecom = true;
  InterbusRobot::Options& swapped = add("DrivecomSwapped");
  swapped.drivecom = swapped.swapped = true;
  add("HoldingRegisters").bus = {{"inputs/function", 3}};
  add("OneRequestForBoth").bus = {{"inputs/function", 23}};
  add("NoRegisterSaysThatTheRingRuns").running = false;
  add("Offsets").drives = {};
  all.back().options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) {
      auto& place = drive.bus.as<sim::IbsDriveConfig>();
      place.input_offset = drive.address == 1 ? 6u : 1u;
      place.output_offset = drive.address == 1 ? 1u : 6u;
    }
  };
  all.back().options.each = {{{"input_offset", 6}, {"output_offset", 1}}, {{"input_offset", 1}, {"output_offset", 6}}};
  return all;
}

class InterbusWords : public ::testing::TestWithParam<Words> {};

TEST_P(InterbusWords, Drive) {
  InterbusRobot robot{GetParam().options};
  ASSERT_TRUE(robot.bringUpAndEnable()) << robot.text(0) << " / " << robot.busText();
  robot.drive(kHalfSpeed, 0.0, seconds{5});
  EXPECT_EQ(0x2000, robot.setpoint(0));
  EXPECT_EQ(-0x2000, robot.setpoint(1));
  EXPECT_NEAR(kHalfSpeed, robot.snapshot().base.velocity.linear_x, 1e-3) << "a step of DRIVECOM's speeds is 5e-4 m/s";
  EXPECT_NEAR(robot.unit(0).wheelAngle(), robot.unit(1).wheelAngle(), 0.02) << "straight on";
  const double way = robot.unit(0).wheelAngle() * 0.1;
  EXPECT_GT(way, 1.0);
  EXPECT_NEAR(way, robot.snapshot().base.pose.x, 0.01 * way);
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  robot.run(seconds{2});
  EXPECT_TRUE(robot.standsStill());
  EXPECT_EQ("no rule broken", robot.referee());
}

INSTANTIATE_TEST_SUITE_P(All, InterbusWords, ::testing::ValuesIn(allWords()),
                         [](const auto& test) { return std::string{test.param.name}; });

// --- Limits ---

// 100 % of P105 is the end on the ring, too: the base is scaled, so that the radius stays.
TEST(InterbusDriving, BeyondFullSpeedTheWholeBaseIsScaled) {
  for (const bool drivecom : {false, true}) {
    InterbusRobot::Options options;
    options.drivecom = drivecom;
    InterbusRobot robot{options};
    ASSERT_TRUE(robot.bringUpAndEnable());
    const double linear = 3.0 * kHalfSpeed, angular = 2.0 * kHalfSpeed / 0.5;  // outer wheel 200 %, inner wheel 100 %
    robot.drive(linear, angular, seconds{8});
    EXPECT_EQ(0x2000, robot.setpoint(0));
    EXPECT_EQ(-0x4000, robot.setpoint(1));
    const robot::Twist2d velocity = robot.snapshot().base.velocity;
    EXPECT_NEAR(linear / angular, velocity.linear_x / velocity.angular_z, 2e-3) << "the radius";
    EXPECT_EQ("no rule broken", robot.referee());
  }
}

// --- What a gateway does not carry ---

TEST(InterbusDriving, AParameterIsRefusedInWords) {
  InterbusRobot robot;
  ASSERT_TRUE(robot.bringUp());
  cycle::Request request;
  request.kind = cycle::RequestKind::kReadParameter;
  request.drive = 0;
  request.parameter.number = 102;
  request.parameter.shape = profile::ParameterShape::kPerSet;
  const cycle::Completion answer = robot.ask(request);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.str(), HasSubstr("its gateway carries process data only, no PCP"));
}

// --- The ring ---

// Nobody says that the ring stands, and the gateway goes on answering with what it last had from it: the driver warns of
// that at start, sees drives that run, and learns of it when the ring is back. P513 has stopped them.
TEST(InterbusRing, WithoutARegisterForItAStandingRingIsNotSeen) {
  InterbusRobot::Options options;
  options.running = false;
  InterbusRobot robot{options};
  EXPECT_THAT(robot.transport().warnings(), Contains(HasSubstr("bus/running is not configured")));
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, seconds{3});
  robot.ring().setCut(true);
  robot.drive(kHalfSpeed, 0.0, seconds{1});
  EXPECT_TRUE(robot.online(0)) << "old words look like new ones";
  EXPECT_EQ(0x0B37, robot.statusWord(0));
  for (int i = 0; i < 2; ++i) EXPECT_EQ(sim::InverterState::kFault, robot.unit(i).inverter().state()) << i;
  robot.ring().setCut(false);
  robot.drive(kHalfSpeed, 0.0, seconds{1});
  EXPECT_FALSE(robot.snapshot().base.enabled);
  EXPECT_TRUE(robot.snapshot().base.stopped);
  for (int i = 0; i < 2; ++i) EXPECT_NE(sim::InverterState::kOperationEnabled, robot.unit(i).inverter().state()) << i;
}

// P507 counts after mains and ring were off (BU 0070 4.2): until somebody sets it back the ring does not run.
TEST(InterbusRing, OneOfAnotherLengthIsNamedAndComesBack) {
  InterbusRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.unit(1).parameters().preset(507, 0, 0, 2);
  robot.drive(kHalfSpeed, 0.0, seconds{1});
  EXPECT_TRUE(robot.snapshot().base.enabled) << "not yet";
  robot.unit(1).setInverterPower(false);
  robot.run(seconds{1});
  robot.unit(1).setInverterPower(true);
  robot.run(seconds{2});
  EXPECT_FALSE(robot.online(0) || robot.online(1));
  EXPECT_THAT(robot.busText(), HasSubstr("says that its ring does not run (register 200 holds 0000h)"));
  EXPECT_THAT(robot.text(0), HasSubstr("the ring behind the gateway does not run"));
  robot.unit(1).parameters().preset(507, 0, 0, 1);
  robot.unit(1).setInverterPower(false);
  robot.run(seconds{1});
  robot.unit(1).setInverterPower(true);
  EXPECT_TRUE(robot.runUntil([&] { return robot.online(0) && robot.online(1); }, seconds{5}));
  robot.drive(kHalfSpeed, 0.0, seconds{1});
  EXPECT_FALSE(robot.snapshot().base.enabled);
}

}  // namespace
}  // namespace nord_driver::test
