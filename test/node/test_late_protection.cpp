// A time-out of the bus that would let a drive run on for long is told, once for each of its kinds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/late_protection.h"
#include "node/parameters.h"
#include "node/ros_settings.h"

namespace nord_driver::node {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

DriveIdentity watchedFor(double time, const char* by) {
  DriveIdentity identity;
  identity.protection_time = time;
  identity.protected_by = by;
  return identity;
}

std::vector<std::string> told(const std::vector<DriveIdentity>& identities) {
  return lateProtection(*RosSettings{"~", robotParameters()}.group("bus"), identities);
}

TEST(LateProtection, AboveThreeSecondsIsTold) {
  constexpr const char* kBy = "PROFIBUS watchdog of 3.01 s: the inverter trips E10.2 and the motor coasts";
  EXPECT_THAT(told({watchedFor(3.0, kBy)}), IsEmpty());
  EXPECT_THAT(told({watchedFor(3.01, kBy)}),
              ElementsAre("~bus: a drive runs on for 3.01 s when this computer dies (PROFIBUS watchdog of 3.01 s)"));
}

TEST(LateProtection, IsToldOnceForEachOfItsKinds) {
  const DriveIdentity guarded = watchedFor(4.0, "node guarding, 4 s: the inverter trips E10.0 and the motor coasts");
  const DriveIdentity heard = watchedFor(5.0, "the node watches this computer's heartbeat for 5 s: E10.0");
  EXPECT_THAT(told({guarded, heard, guarded}),
              ElementsAre("~bus: a drive runs on for 4 s when this computer dies (node guarding, 4 s)",
                          "~bus: a drive runs on for 5 s when this computer dies (the node watches this computer's "
                          "heartbeat for 5 s)"));
}

// Of who only reads parameters it is how long the transport listens; nothing is known of a gateway's register.
TEST(LateProtection, NothingIsToldOfWhatProtectsNobodyOrIsNotKnown) {
  EXPECT_THAT(told({watchedFor(8.0, ""), watchedFor(0.0, "watchdog of the gateway (register 300 = 1000)")}), IsEmpty());
}

}  // namespace
}  // namespace nord_driver::node
