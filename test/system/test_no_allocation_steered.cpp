// What the cycle's thread does for a steered base allocates nothing: in whatever it does next, driving, waiting, braking.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>

#include "cycle/steered_motion.h"
#include "support/count_allocations.h"

namespace nord_driver::test {
namespace {

TEST(NoAllocationSteered, MotionAndOdometry) {
  if (!kCanCountAllocations) GTEST_SKIP();
  cycle::BaseConfig config;
  config.kind = robot::BaseKind::kSteered;
  config.steered.emplace();
  config.steered->wheels = {0, 1};
  config.steered->steering = {2, 3};
  config.steered->axles = {{0.5, 0.0, 0.1, -1.6, 1.6}, {-0.5, 0.0, 0.1, -1.6, 1.6}};
  config.steered->angle_tolerance = 0.05;
  config.limits.linear_x.has_acceleration_limits = true;
  config.limits.linear_x.max_acceleration = 1.0;
  cycle::SteeredMotion motion{config, std::chrono::milliseconds{500}};
  cycle::SteeredDrives drives{{9.0, 9.0}, {0.0, 0.0}, {}};
  constexpr Duration kCycle = std::chrono::milliseconds{10};
  Instant now{std::chrono::hours{1}};
  const std::size_t count = countAllocations([&] {
    for (int i = 0; i < 5000; ++i) {
      now += kCycle;
      const robot::Twist2d twist{std::sin(0.003 * i), std::cos(0.007 * i), std::sin(0.011 * i)};
      const robot::SteeredSetpoint setpoint = motion.poll({twist, now, true}, true, true, drives, now, kCycle);
      drives.angles[0] += 0.1 * (setpoint.angles[0] - drives.angles[0]);
      drives.angles[1] += 0.1 * (setpoint.angles[1] - drives.angles[1]);
      motion.handleMeasured(setpoint.wheels, drives.angles, kCycle);
    }
  });
  EXPECT_EQ(0u, count);
  std::unique_ptr<int> spoil;
  EXPECT_GT(countAllocations([&] { spoil = std::make_unique<int>(1); }), 0u) << "this test would have noticed";
}

}  // namespace
}  // namespace nord_driver::test
