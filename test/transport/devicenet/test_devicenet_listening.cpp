// Who is taken for somebody that works with the bus.
#include <gtest/gtest.h>

#include "support/can_text.h"
#include "transport/devicenet/devicenet_listening.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;

constexpr Instant kStart{std::chrono::seconds{1000}};

// Devices nobody works with check their MAC id and send heartbeats.
TEST(DevicenetListening, DevicesNobodyWorksWithMayBeHeard) {
  CanListenFirst listen{kDevicenetListening, milliseconds{500}};
  listen.restart(kStart);
  for (const char* frame : {"42F#00850101000000", "42B#05CD010003000000", "745#05CD010003000000", "7F5#00"}) {
    EXPECT_FALSE(showsScanner(nord_driver::frame(frame))) << frame;
    listen.handle(nord_driver::frame(frame));
  }
  EXPECT_FALSE(listen.mayTalk(kStart + milliseconds{499}));
  EXPECT_FALSE(listen.text().empty());
  EXPECT_TRUE(listen.mayTalk(kStart + milliseconds{500}));
  EXPECT_TRUE(listen.text().empty());
}

// Strobe, acknowledge, explicit request, poll, allocation, and what a slave answers to a poll or sends on change.
TEST(DevicenetListening, EverythingElseIsAnotherScanner) {
  for (const char* frame : {"400#0000000000000000", "42A#", "42C#000E010101", "42D#007E040000", "42E#004B03010100",
                            "3C5#00310B0000", "345#00310B0000", "385#00310B0000"}) {
    EXPECT_TRUE(showsScanner(nord_driver::frame(frame))) << frame;
    CanListenFirst listen{kDevicenetListening, milliseconds{500}};
    listen.restart(kStart);
    listen.handle(nord_driver::frame(frame));
    EXPECT_FALSE(listen.mayTalk(kStart + std::chrono::hours{1})) << frame;
    EXPECT_EQ(nord_driver::frame(frame).id, listen.heard());
  }
}

TEST(DevicenetListening, GivesWayToOneThatComesLater) {
  CanListenFirst listen{kDevicenetListening, milliseconds{500}};
  listen.restart(kStart);
  ASSERT_TRUE(listen.mayTalk(kStart + milliseconds{500}));
  listen.handleMaster(0x42E, kStart + milliseconds{550});
  EXPECT_FALSE(listen.mayTalk(kStart + milliseconds{600}));
  EXPECT_EQ("the bus is in use: 42Eh was seen; nothing is sent beside another scanner: end it", listen.text().str());
}

}  // namespace
}  // namespace nord_driver
