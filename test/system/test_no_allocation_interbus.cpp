// The InterBus cycle allocates nothing once the drives are up, with parameters by PCP, and whatever the gateway does.
//
// A program of its own, because it replaces malloc; in simulated time, in one thread: what the link's own thread does is
// counted in test/link/modbus. Not built under sanitizers, which do the same.
#include "system/interbus_robot.h"
#include "system/no_allocation.h"

namespace nord_driver::test {
namespace {

using std::chrono::seconds;

InterbusRobot::Options withPcp() {
  InterbusRobot::Options options;
  options.pcp = true;
  return options;
}

TEST(InterbusNoAllocation, InTheCycle) {
  InterbusRobot robot{withPcp()};
  expectNoAllocationInTheCycle(robot, seconds{3});
}

TEST(InterbusNoAllocation, WhileTheGatewayStallsRefusesAndIsGone) {
  if (!kCanCountAllocations) GTEST_SKIP();
  InterbusRobot robot{withPcp()};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(0.2, 0.0, seconds{1});
  const auto driveCounted = [&] { return countAllocations([&] { robot.drive(0.2, 0.0, seconds{2}); }); };
  sim::NetworkState network;
  network.carries_answers = false;
  robot.gateway().setNetwork(network);
  EXPECT_EQ(0u, driveCounted()) << "no answer";
  EXPECT_FALSE(robot.online(0));
  network = {};
  network.port_open = false;
  robot.gateway().setNetwork(network);
  EXPECT_EQ(0u, driveCounted()) << "no connection";
  robot.gateway().setNetwork({});
  sim::GatewaySwitches refuses;
  refuses.exception = std::uint8_t{6};
  robot.gateway().gateway().setSwitches(refuses);
  EXPECT_EQ(0u, driveCounted()) << "refuses";
  robot.gateway().gateway().setSwitches({});
  robot.ring().setCut(true);
  EXPECT_EQ(0u, driveCounted()) << "its ring stands";
  robot.ring().setCut(false);
  EXPECT_EQ(0u, driveCounted()) << "and back";
  EXPECT_TRUE(robot.online(0));
}

}  // namespace
}  // namespace nord_driver::test
