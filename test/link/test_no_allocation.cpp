#include <errno.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "link/can/fake_can_system.h"
#include "link/can/socket_can.h"
#include "link/can/virtual_can.h"
#include "link/can/virtual_can_hub.h"
#include "support/count_allocations.h"

namespace nord_driver::link {
namespace {

using std::chrono::milliseconds;
using test::countAllocations;

CanFrame frame() {
  return dataFrame(0x1B2, std::array<std::uint8_t, 2>{0x31, 0x0B});
}

// The counter counts.
TEST(NoAllocation, OneAllocationIsSeen) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  std::vector<int> list;
  EXPECT_EQ(1u, countAllocations([&] { list.reserve(1000); }));
}

// Traffic, error frames, a full queue, down, bus-off, removal and reopening: all of it happens in the bus cycle.
TEST(NoAllocation, ASocketCanLinkTakesNoMemory) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  FakeCanSystem kernel;
  CanSettings settings;
  settings.interface = "can0";
  settings.ids = {0x1B2};
  settings.bit_rate = 500'000;
  SocketCan link{settings, kernel};
  kernel.sent.reserve(10);
  kernel.filters.reserve(1);
  kernel.arrive(frame(), milliseconds{1});
  kernel.arriveError(0x020);
  kernel.arriveError(0x004, {0, 0x20});
  kernel.arriveError(0x040);
  kernel.arriveError(0x100);
  kernel.arrivals.push_back({ENETDOWN, {}});
  kernel.arrivals.push_back({ENODEV, {}});
  kernel.send_errors = {ENOBUFS};
  CanInterface slower = kernel.interface;
  slower.bit_rate = 250'000;
  bool was_refused = false;
  EXPECT_EQ(0u, countAllocations([&] {
              link.open();
              ReceivedCanFrame received;
              for (int i = 0; link.isOpen() && i < 1000; ++i) {  // to the last of the arrivals, which closes it
                link.send(frame());
                link.waitWritable(kernel.time + milliseconds{1});
                link.waitReadable(kernel.time + milliseconds{1});
                link.receive(received);
                static_cast<void>(link.advice());
                static_cast<void>(link.counters());
              }
              kernel.interface = slower;
              was_refused = !link.open();
            }));
  EXPECT_TRUE(kernel.arrivals.empty());
  EXPECT_TRUE(was_refused);
}

TEST(NoAllocation, AVirtualBusTakesNoMemory) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  CanSettings settings;
  settings.interface = "virtual:allocation_" + std::to_string(::getpid());
  VirtualCanHub hub{settings};
  VirtualCan link{settings};
  int received_frames = 0;
  EXPECT_EQ(0u, countAllocations([&] {
              link.open();  // refused: nobody has made it
              hub.open();
              link.open();
              ReceivedCanFrame received;
              for (int i = 0; i < 100; ++i) {
                link.send(frame());
                if (hub.waitReadable(hub.now() + std::chrono::seconds{5}) && hub.receive(received)) ++received_frames;
                hub.send(frame());
                if (link.waitReadable(link.now() + std::chrono::seconds{5}) && link.receive(received))
                  ++received_frames;
              }
              hub.close();
              link.send(frame());
            }));
  EXPECT_EQ(200, received_frames);
  EXPECT_FALSE(link.isOpen());
}

}  // namespace
}  // namespace nord_driver::link
