#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/event_ring.h"

namespace nord_driver {
namespace {

TEST(EventRing, KeepsTheOrder) {
  EventRing<int, 3> ring;
  EXPECT_FALSE(ring.pop());
  for (int round = 0; round < 5; ++round) {
    EXPECT_TRUE(ring.push(round));
    EXPECT_TRUE(ring.push(round + 100));
    EXPECT_EQ(round, ring.pop());
    EXPECT_EQ(round + 100, ring.pop());
  }
}

TEST(EventRing, CountsWhatDoesNotFit) {
  EventRing<int, 2> ring;
  EXPECT_TRUE(ring.push(1));
  EXPECT_TRUE(ring.push(2));
  EXPECT_FALSE(ring.push(3));
  EXPECT_EQ(1u, ring.overflow());
  EXPECT_EQ(1, ring.pop());
  EXPECT_TRUE(ring.push(4));
  EXPECT_EQ(2, ring.pop());
  EXPECT_EQ(4, ring.pop());
}

TEST(EventRing, EveryEventArrivesOnceOrIsCounted) {
  EventRing<int, 64> ring;
  constexpr int kCount = 100'000;
  std::atomic<bool> done{false};
  std::thread writer{[&] {
    for (int i = 0; i < kCount; ++i) ring.push(i);
    done = true;
  }};
  int received = 0, last = -1;
  bool ordered = true;
  for (bool over = false; !over;) {
    over = done;  // before the ring is looked into: what was pushed by then is still fetched
    while (received < kCount) {
      const auto event = ring.pop();
      if (!event) break;
      ordered = ordered && *event > last;
      last = *event;
      ++received;
    }
  }
  writer.join();
  EXPECT_TRUE(ordered);
  EXPECT_EQ(kCount, received + static_cast<int>(ring.overflow()));
}

}  // namespace
}  // namespace nord_driver
