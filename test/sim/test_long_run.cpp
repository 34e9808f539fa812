#include <gtest/gtest.h>

#include "sim/profibus/conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

/// Repeats an order until its answer has come, then says "no order", as a master has to.
void order(Conversation& bus, const std::string& pkw, const std::string& pzd) {
  for (int i = 0; i < 3; ++i) bus.exchange(pkw, pzd);
  bus.exchange("0000 0000 0000 0000", pzd);
}

// An EEPROM lives for 100,000 writes (BU 0020 7.5): an hour of set switching and RAM writes costs none of them, each
// persistent change costs one, and one that is repeated until it is answered costs no more.
TEST(LongRun, AnHourOfRamWritesAndSetSwitchingLeavesTheEepromAlone) {
  Conversation bus;
  bus.startUp(200);
  const char* const idle[] = {"047E 0000", "447E 0000", "847E 0000", "C47E 0000"};
  const Instant end = bus.segment.now() + std::chrono::hours(1);
  std::uint64_t rounds = 0;
  while (bus.segment.now() < end) {
    const std::string pzd = idle[rounds % 4];
    // P102 in the four sets: label 12 knows the set, 14 is for the first.
    order(bus, rounds % 2 == 0 ? "C44E 0200 0000 03E8" : "E44E 0000 0000 00C9", pzd);
    bus.segment.run(milliseconds(500));
    ++rounds;
  }
  EXPECT_LT(7000u, rounds);
  EXPECT_EQ(rounds - 1, bus.drive().inverter().setSwitches());
  EXPECT_EQ(1000, bus.drive().parameters().value(102, 2));
  EXPECT_EQ(201, bus.drive().parameters().value(102, 0));
  EXPECT_EQ(0u, bus.drive().parameters().eepromWrites());
  EXPECT_EQ(0u, bus.station().counters().watchdog_trips);
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();

  order(bus, "744E 0200 0000 03E9", idle[0]);
  EXPECT_EQ(1u, bus.drive().parameters().eepromWrites());
  order(bus, "244E 0000 0000 00CA", idle[0]);
  EXPECT_EQ(2u, bus.drive().parameters().eepromWrites());
}

}  // namespace
}  // namespace nord_driver::sim
