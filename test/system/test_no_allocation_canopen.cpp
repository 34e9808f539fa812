// The CANopen cycle allocates nothing once the drives are up: losses, parameters, faults and a bus-off included.
//
// A program of its own, because it replaces malloc; in simulated time, in one thread. Not built under sanitizers, which
// do the same.
#include <gtest/gtest.h>

#include "support/count_allocations.h"
#include "system/can_robot.h"
#include "trace/trace_feed.h"

namespace nord_driver::test {
namespace {

TEST(CanopenNoAllocation, InTheCycle) {
  if (!kCanCountAllocations) GTEST_SKIP();
  CanRobot robot;
  trace::TraceFeed feed{2};
  robot.ports().setObserver(&feed);
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(0.2, 0.1, std::chrono::seconds{1});
  const auto driveCounted = [&](Duration span) { return countAllocations([&] { robot.drive(0.2, 0.1, span); }); };
  EXPECT_EQ(0u, driveCounted(std::chrono::seconds{1}));
  robot.unit(1).inverter().trip(30, false);
  EXPECT_EQ(0u, driveCounted(std::chrono::seconds{1})) << "a fault, its emergency and P700";
  robot.unit(1).setPlugged(false);
  EXPECT_EQ(0u, driveCounted(std::chrono::seconds{1})) << "a node lost";
  EXPECT_FALSE(robot.online(1));
  robot.unit(1).setPlugged(true);
  EXPECT_EQ(0u, driveCounted(std::chrono::seconds{3})) << "... and back, booted and read again";
  EXPECT_TRUE(robot.online(1));

  // And this test would have noticed.
  std::unique_ptr<int> spoil;
  EXPECT_GT(countAllocations([&] { spoil = std::make_unique<int>(1); }), 0u);
}

}  // namespace
}  // namespace nord_driver::test
