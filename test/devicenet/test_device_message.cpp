// What a device says unasked, byte by byte: heartbeat and shutdown.
#include <gtest/gtest.h>

#include "devicenet/device_message.h"
#include "support/can_text.h"

namespace nord_driver::devicenet {
namespace {

// Its own MAC id in the header, with either transaction id, and one of two services; a fragment is none.
TEST(DeviceMessage, IsKnownByHeaderAndService) {
  for (const char* one : {"42B#05CD", "42B#45CD", "42B#05CE010001000200"}) {
    EXPECT_TRUE(isDeviceMessage(frame(one), 5)) << one;
    EXPECT_FALSE(isDeviceMessage(frame(one), 6)) << one;
  }
  for (const char* other : {"42B#", "42B#05", "42B#85CD", "42B#05CC", "42B#05CF", "42B#054D"}) {
    EXPECT_FALSE(isDeviceMessage(frame(other), 5)) << other;
  }
  CanFrame remote = frame("42B#05CD010003000000");
  remote.remote = true;
  EXPECT_FALSE(isDeviceMessage(remote, 5));
}

TEST(DeviceMessage, AHeartbeatHasEightBytes) {
  const auto heartbeat = readHeartbeat(frame("42B#05CD020103044321"));
  ASSERT_TRUE(heartbeat);
  EXPECT_EQ(0x0102, heartbeat->identity_instance);
  EXPECT_EQ(3, heartbeat->state);
  EXPECT_EQ(4, heartbeat->fault_flags);
  EXPECT_EQ(0x2143, heartbeat->configuration_consistency);
  EXPECT_FALSE(readHeartbeat(frame("42B#05CD0201030443")));
  EXPECT_FALSE(readHeartbeat(frame("42B#05CE020103044321")));
}

TEST(DeviceMessage, AShutdownHasEightBytes) {
  const auto shutdown = readShutdown(frame("42B#05CE020104030605"));
  ASSERT_TRUE(shutdown);
  EXPECT_EQ(0x0102, shutdown->class_id);
  EXPECT_EQ(0x0304, shutdown->instance);
  EXPECT_EQ(0x0506, shutdown->code);
  EXPECT_FALSE(readShutdown(frame("42B#05CE0201040306")));
  EXPECT_FALSE(readShutdown(frame("42B#05CD020104030605")));
}

// Class 1, attribute 8.
TEST(DeviceMessage, EachStateHasAName) {
  const char* const names[] = {
      "nonexistent", "self testing", "standby", "operational", "major fault, recoverable", "major fault, unrecoverable",
      "unknown"};
  for (std::uint8_t state = 0; state < 7; ++state) EXPECT_STREQ(names[state], deviceStateText(state));
}

}  // namespace
}  // namespace nord_driver::devicenet
