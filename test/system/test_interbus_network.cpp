// What goes wrong between driver and gateway while the wheels turn: no wheel moves unasked, the stop comes within its
// bound, the drives are back within 2 s of the cause's end, and stay disabled until somebody enables them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "system/interbus_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

struct NetworkFault {
  const char* name;
  void (*begin)(sim::SimulatedGateway&);
  const char* named;    ///< by the bus, one second later
  const char* counter;  ///< that counts it
  Duration late{};      ///< a request that was under way arrives so late, and counts as one
};

void PrintTo(const NetworkFault& fault, std::ostream* out) {
  *out << fault.name;
}

template <typename Change>
void changeNetwork(sim::SimulatedGateway& link, Change change) {
  sim::NetworkState network = link.network();
  change(network);
  link.setNetwork(network);
}

constexpr NetworkFault kFaults[] = {
    {"PortClosed",
     [](sim::SimulatedGateway& link) { changeNetwork(link, [](sim::NetworkState& to) { to.port_open = false; }); },
     "refuses the connection", "connect_failures"},
    {"CablePulled",
     [](sim::SimulatedGateway& link) {
       changeNetwork(link, [](sim::NetworkState& to) { to.carries_requests = to.carries_answers = false; });
     },
     "does not answer an attempt to connect", "timeouts"},
    {"HalfOpen",
     [](sim::SimulatedGateway& link) {
       changeNetwork(link, [](sim::NetworkState& to) { to.carries_answers = false; });
     },
     "does not answer an attempt to connect", "timeouts"},
    {"HalfASecondOfLatency",
     [](sim::SimulatedGateway& link) {
       changeNetwork(link, [](sim::NetworkState& to) { to.latency = milliseconds{500}; });
     },
     "has not answered", "timeouts", milliseconds{250}},
    {"Silent",
     [](sim::SimulatedGateway& link) {
       link.gateway().setSwitches({true, {}, {}, 0});
     },
     "has not answered", "timeouts"},
    {"WrongTransactions",
     [](sim::SimulatedGateway& link) {
       link.gateway().setSwitches({false, {}, {}, 1});
     },
     "an answer to another request", "bad_answers"},
    {"Exceptions",
     [](sim::SimulatedGateway& link) {
       link.gateway().setSwitches({false, {}, std::uint8_t{6}, 0});
     },
     "exception 6", "exceptions"},
};

class InterbusNetwork : public ::testing::TestWithParam<NetworkFault> {
 protected:
  /// drive_timeout, two cycles, the watchdog of the gateway, P513, and a step of each.
  static constexpr Duration kStop = milliseconds{50 + 20 + 200 + 200 + 10};

  void SetUp() override {
    ASSERT_TRUE(robot_.bringUpAndEnable());
    robot_.drive(kHalfSpeed, 0.0, seconds{3});
  }
  bool inverterEnabled() {
    return robot_.unit(0).inverter().state() == sim::InverterState::kOperationEnabled ||
           robot_.unit(1).inverter().state() == sim::InverterState::kOperationEnabled;
  }
  bool online() { return robot_.online(0) && robot_.online(1); }
  /// Somebody goes on commanding, whatever happens.
  void step() {
    robot_.command(kHalfSpeed);
    robot_.step();
  }
  Instant now() { return robot_.transport().now(); }
  /// Nothing is enabled by a command.
  void expectStaysDown(Duration span) {
    for (const Instant end = now() + span; now() < end;) {
      step();
      ASSERT_FALSE(robot_.snapshot().base.enabled || inverterEnabled());
    }
  }
  void expectOnlyEnableMoves() {
    ASSERT_NO_FATAL_FAILURE(expectStaysDown(seconds{1}));
    ASSERT_TRUE(robot_.runUntil([this] { return robot_.standsStill(); }, seconds{30}));
    ASSERT_NO_FATAL_FAILURE(expectStaysDown(seconds{1}));
    robot_.run(milliseconds{600});  // the last command is too old by then
    robot_.ask(cycle::RequestKind::kAcknowledge);
    ASSERT_STREQ("enabled", robot_.ask(cycle::RequestKind::kEnable).message.c_str());
    robot_.drive(kHalfSpeed, 0.0, seconds{1});
    EXPECT_GT(robot_.setpoint(0), 0x1000);
  }

  InterbusRobot robot_;
};

TEST_P(InterbusNetwork, StopsAndIsBackDisabled) {
  sim::SimulatedGateway& link = robot_.gateway();
  const std::uint64_t counted = robot_.transport().counters().value(GetParam().counter);
  const Instant begun = now();
  GetParam().begin(link);
  // In the cycle after drive_timeout is over the base stops, whatever can be sent.
  while (robot_.snapshot().base.enabled) {
    step();
    ASSERT_LE(now() - begun, milliseconds{50 + 20 + 10});
  }
  EXPECT_TRUE(robot_.snapshot().base.stopped);
  while (inverterEnabled()) {
    step();
    ASSERT_LE(now() - begun, kStop + GetParam().late);
  }
  ASSERT_NO_FATAL_FAILURE(expectStaysDown(seconds{2}));
  EXPECT_FALSE(robot_.online(0) || robot_.online(1));
  EXPECT_THAT(robot_.busText(), HasSubstr(std::string{"192.168.0.10:502 "}));
  EXPECT_THAT(robot_.busText(), HasSubstr(GetParam().named));
  EXPECT_THAT(robot_.text(0), HasSubstr("the gateway does not answer, or too late"));
  EXPECT_GT(robot_.transport().counters().value(GetParam().counter), counted);

  link.setNetwork({});
  link.gateway().setSwitches({});
  const Instant ended = now();
  while (!online()) {
    step();
    ASSERT_LE(now() - ended, seconds{2});
    ASSERT_FALSE(inverterEnabled());
  }
  EXPECT_EQ("", robot_.busText());
  expectOnlyEnableMoves();
  EXPECT_EQ("no rule broken", robot_.referee());
}

INSTANTIATE_TEST_SUITE_P(All, InterbusNetwork, ::testing::ValuesIn(kFaults),
                         [](const auto& test) { return std::string{test.param.name}; });

// The connection is made anew at once, but the exchange that was lost is one: longer than drive_timeout.
using InterbusNetworkOnce = InterbusNetwork;

TEST_P(InterbusNetworkOnce, AResetInTheMiddleOfAnExchange) {
  for (const auto after : {std::chrono::microseconds{100}, std::chrono::microseconds{600},
                           std::chrono::microseconds{1000}, std::chrono::microseconds{5000}}) {
    SCOPED_TRACE(after.count());
    robot_.gateway().at(now() + after, [this] { robot_.gateway().resetConnection(); });
    robot_.drive(kHalfSpeed, 0.0, milliseconds{300});
    EXPECT_FALSE(robot_.snapshot().base.enabled);
    ASSERT_TRUE(online());
    // They were told to stop at once, and come down their ramps.
    ASSERT_TRUE(robot_.runUntil([this] { return !inverterEnabled(); }, seconds{3}));
    ASSERT_NO_FATAL_FAILURE(expectOnlyEnableMoves());
    robot_.drive(kHalfSpeed, 0.0, seconds{2});
  }
  EXPECT_EQ(4u, robot_.transport().counters().value("closed_connections"));
  EXPECT_EQ(5u, robot_.transport().counters().value("connections"));
}

INSTANTIATE_TEST_SUITE_P(Reset, InterbusNetworkOnce, ::testing::Values(kFaults[0]),
                         [](const auto&) { return std::string{"Once"}; });

// What stays within drive_timeout stops nothing: 15 ms an exchange, and single answers that take 20 ms more.
TEST(InterbusNetworkSlow, WithinDriveTimeoutNothingStops) {
  InterbusRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, seconds{3});
  changeNetwork(robot.gateway(), [](sim::NetworkState& to) { to.latency = milliseconds{5}; });
  robot.drive(kHalfSpeed, 0.0, seconds{2});
  robot.gateway().setNetwork({});
  for (int i = 0; i < 20; ++i) {
    robot.gateway().gateway().setSwitches({false, milliseconds{20}, {}, 0});
    robot.drive(kHalfSpeed, 0.0, milliseconds{10});
    robot.gateway().gateway().setSwitches({});
    robot.drive(kHalfSpeed, 0.0, milliseconds{100});
  }
  EXPECT_TRUE(robot.snapshot().base.enabled) << robot.snapshot().base.text.c_str();
  EXPECT_GT(robot.transport().counters().value("without_inputs"), 20u);
  EXPECT_EQ(0x2000, robot.setpoint(0));
  EXPECT_EQ("no rule broken", robot.referee());
}

}  // namespace
}  // namespace nord_driver::test
