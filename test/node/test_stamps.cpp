// The moment of a measurement in ROS time, with every clock a node may meet.
#include <gtest/gtest.h>

#include "node/stamps.h"

namespace nord_driver::node {
namespace {

constexpr Instant kNow{std::chrono::hours{1}};
const ros::Time kRosNow{1700000000, 5000000};

TEST(Stamps, AreAsOldAsTheMeasurement) {
  const Stamps stamps{kRosNow, kNow};
  EXPECT_EQ(kRosNow, stamps.of(kNow));
  EXPECT_EQ(ros::Time(1699999999, 995000000), stamps.of(kNow - std::chrono::milliseconds{10}));
}

TEST(Stamps, AreNeverInTheFuture) {
  EXPECT_EQ(kRosNow, (Stamps{kRosNow, kNow}.of(kNow + std::chrono::milliseconds{1})));
}

// ROS time 0: /use_sim_time before the first /clock. Nothing is measured before it.
TEST(Stamps, DoNotReachBehindTheBeginningOfRosTime) {
  EXPECT_EQ(ros::Time{}, (Stamps{ros::Time{}, kNow}.of(kNow - std::chrono::milliseconds{10})));
  EXPECT_EQ(ros::Time(0, 4000000), (Stamps{ros::Time(0, 4000000), kNow}.of(kNow - std::chrono::milliseconds{10})));
}

TEST(Stamps, SampleBothClocksOfNow) {
  ros::Time::init();
  const Instant before = std::chrono::steady_clock::now();
  const ros::Time earliest = ros::Time::now();
  const Stamps stamps = Stamps::sample();
  EXPECT_GE(stamps.of(std::chrono::steady_clock::now()), earliest);
  EXPECT_LE(stamps.of(before - std::chrono::seconds{1}), ros::Time::now() - ros::Duration(1.0));
}

}  // namespace
}  // namespace nord_driver::node
