#include <gtest/gtest.h>

#include "core/can_trace.h"

namespace nord_driver {
namespace {

std::string hex(const CanPacket& packet) {
  return toHex(ByteView{packet});
}

// BU 0060 p. 96: the enabling frame of node 50, as a packet of link type 227.
TEST(CanTrace, APacketIsIdentifierLengthAndData) {
  EXPECT_EQ("00 00 02 32 04 00 00 00 7F 04 00 20",
            hex(toPacket(dataFrame(0x232, ByteView{FixedBytes<4>{0x7F, 0x04, 0x00, 0x20}}))));
}

// Node guarding asks by remote frames: bit 30, no data, the length asked for.
TEST(CanTrace, ARemoteFrameHasNoData) {
  EXPECT_EQ("40 00 07 32 01 00 00 00", hex(toPacket(remoteFrame(0x732, 1))));
  EXPECT_EQ("732#R1", candumpText(remoteFrame(0x732, 1)));
}

TEST(CanTrace, CandumpsTextIsThatOfTheManuals) {
  EXPECT_EQ("232#7E040000", candumpText(dataFrame(0x232, ByteView{FixedBytes<4>{0x7E, 0x04, 0x00, 0x00}})));
  EXPECT_EQ("080#", candumpText(dataFrame(0x080, {})));
  CanFrame extended = dataFrame(0x18DAF110, {});
  extended.extended = true;
  EXPECT_EQ("18DAF110#", candumpText(extended));
}

TEST(CanTrace, EveryFrameComesBackAsItWas) {
  CanFrame extended = dataFrame(0x18DAF110, ByteView{FixedBytes<2>{1, 2}});
  extended.extended = true;
  for (const CanFrame& frame :
       {dataFrame(0x000, ByteView{FixedBytes<2>{0x01, 0x32}}), dataFrame(0x7FF, {}), remoteFrame(0x732, 1), extended}) {
    const auto back = fromPacket(ByteView{toPacket(frame)});
    ASSERT_TRUE(back.has_value());
    EXPECT_TRUE(frame == *back) << candumpText(frame);
  }
}

// What is cut off or too long is no frame.
TEST(CanTrace, BytesThatAreNoPacketAreRefused) {
  const CanPacket packet = toPacket(dataFrame(0x232, ByteView{FixedBytes<4>{1, 2, 3, 4}}));
  const ByteView whole{packet};
  for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_FALSE(fromPacket(whole.sub(0, n)).has_value()) << n;
  CanPacket too_long = packet;
  too_long[4] = 9;
  EXPECT_FALSE(fromPacket(ByteView{too_long}).has_value());
}

}  // namespace
}  // namespace nord_driver
