// A robot whose cycle must allocate nothing once its drives are up: losses, parameters and faults included. For programs
// of their own: this replaces malloc.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>

#include "support/count_allocations.h"
#include "trace/trace_feed.h"

namespace nord_driver::test {

/// `Robot`: one with two wheels. `back`: a drive that is plugged in again answers within that.
template <typename Robot>
void expectNoAllocationInTheCycle(Robot& robot, Duration back) {
  if (!kCanCountAllocations) GTEST_SKIP();
  trace::TraceFeed feed{2};
  robot.ports().setObserver(&feed);
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(0.2, 0.1, std::chrono::seconds{1});
  const auto driveCounted = [&](Duration span) { return countAllocations([&] { robot.drive(0.2, 0.1, span); }); };
  EXPECT_EQ(0u, driveCounted(std::chrono::seconds{1}));
  robot.unit(1).inverter().trip(30, false);
  EXPECT_EQ(0u, driveCounted(std::chrono::seconds{1})) << "a fault, and P700";
  robot.unit(1).setPlugged(false);
  EXPECT_EQ(0u, driveCounted(std::chrono::seconds{1})) << "a drive lost";
  EXPECT_FALSE(robot.online(1));
  robot.unit(1).setPlugged(true);
  EXPECT_EQ(0u, driveCounted(back)) << "... and back, connected and read again";
  EXPECT_TRUE(robot.online(1));

  // And this test would have noticed.
  std::unique_ptr<int> spoil;
  EXPECT_GT(countAllocations([&] { spoil = std::make_unique<int>(1); }), 0u);
}

}  // namespace nord_driver::test
