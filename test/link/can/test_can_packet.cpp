#include <gtest/gtest.h>

#include "link/can/can_packet.h"

namespace nord_driver::link {
namespace {

// The layout of nord_driver/link/can_packet.h, byte by byte.
TEST(CanPacket, LooksAsDescribed) {
  const CanFrame frame = dataFrame(0x1B2, std::array<std::uint8_t, 4>{0x31, 0x0B, 0x00, 0x20});
  const CanPacket expected{0xC1, 0x04, 0x34, 0x12, 0xB2, 0x01, 0, 0, 0x31, 0x0B, 0x00, 0x20, 0, 0, 0, 0};
  EXPECT_EQ(expected, toPacket(frame, 0x1234));
  const auto read = fromPacket(expected);
  ASSERT_TRUE(read);
  EXPECT_EQ(frame, read->frame);
  EXPECT_EQ(0x1234, read->number);
}

TEST(CanPacket, ExtendedAndRemoteFrames) {
  CanFrame extended = dataFrame(0x1ABC'DEF0, std::array<std::uint8_t, 8>{1, 2, 3, 4, 5, 6, 7, 8});
  extended.extended = true;
  const CanPacket wide{0xC1, 0x18, 0, 0, 0xF0, 0xDE, 0xBC, 0x1A, 1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(wide, toPacket(extended, 0));
  EXPECT_EQ(extended, fromPacket(wide)->frame);
  const CanFrame guarding = remoteFrame(0x732, 1);
  const CanPacket request{0xC1, 0x21, 0, 0, 0x32, 0x07, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(request, toPacket(guarding, 0));
  EXPECT_EQ(guarding, fromPacket(request)->frame);
}

TEST(CanPacket, AnythingElseIsRefused) {
  const CanPacket good = toPacket(dataFrame(0x7FF, {}), 0);
  ASSERT_TRUE(fromPacket(good));
  for (std::size_t length = 0; length < good.size(); ++length) {
    EXPECT_FALSE(fromPacket(ByteView{good}.sub(0, length))) << length;
  }
  const auto changed = [&good](std::size_t at, std::uint8_t value) {
    CanPacket packet = good;
    packet[at] = value;
    return fromPacket(packet).has_value();
  };
  EXPECT_FALSE(changed(0, 0xC2)) << "another version";
  EXPECT_FALSE(changed(1, 0x09)) << "nine bytes";
  EXPECT_FALSE(changed(1, 0x40)) << "an unknown bit";
  EXPECT_FALSE(changed(1, 0x80)) << "an unknown bit";
  EXPECT_FALSE(changed(5, 0x08)) << "identifier 8FFh";
  EXPECT_FALSE(changed(7, 0x20)) << "identifier 200007FFh";
}

}  // namespace
}  // namespace nord_driver::link
