#include <gtest/gtest.h>

#include "devicenet/explicit_channel.h"
#include "support/can_text.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;

// The engine and the layer above take turns, however many requests wait.
TEST(ExplicitChannel, TakesTurns) {
  ExplicitChannel channel{0, 5, milliseconds{100}};
  const Instant now{std::chrono::hours{1}};
  channel.open();
  for (std::uint8_t i = 1; i <= 4; ++i) ASSERT_TRUE(channel.submit(getAttribute(i, 101, 1, i), now));
  std::string asked;
  bool xid = true;
  for (int i = 0; i < 6; ++i) {
    if (i % 2 == 0) channel.ask(getAttribute(0, 5, 2, 1), ExplicitPort::kConnected, milliseconds{100}, now);
    CanFrame frame;
    ASSERT_TRUE(channel.pollTransmit(frame, now));
    asked += frame.data[2] == 5 ? 'e' : 'u';
    channel.handle(nord_driver::frame(xid ? "42B#408E03" : "42B#008E03"), now);
    xid = !xid;
  }
  EXPECT_EQ("ueueue", asked);
}

// A frame the link did not take comes again, first of all.
TEST(ExplicitChannel, NotSent) {
  ExplicitChannel channel{0, 5, milliseconds{100}};
  const Instant now{std::chrono::hours{1}};
  channel.open();
  channel.submit(getAttribute(1, 101, 1, 1), now);
  CanFrame frame;
  ASSERT_TRUE(channel.pollTransmit(frame, now));
  const CanFrame before = frame;
  channel.notSent(frame);
  ASSERT_TRUE(channel.pollTransmit(frame, now));
  EXPECT_EQ(before, frame);
  EXPECT_FALSE(channel.pollTransmit(frame, now));
}

}  // namespace
}  // namespace nord_driver::devicenet
