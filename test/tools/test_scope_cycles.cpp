// Cycles collected for a scope.
#include <gtest/gtest.h>

#include "tools/scope_cycles.h"

namespace nord_driver::tools {
namespace {

LiveCycle cycle(std::uint64_t number, double time) {
  LiveCycle made;
  made.number = number;
  made.sample.time = time;
  return made;
}

// Whatever time the node's clock has, the first cycle is time 0.
TEST(ScopeCycles, CollectsUntilTheDurationIsFull) {
  ScopeCycles cycles{0.025};
  cycles.take({cycle(700, 1000.0), cycle(701, 1000.01)});
  EXPECT_FALSE(cycles.done());
  cycles.take({cycle(702, 1000.02), cycle(703, 1000.03), cycle(704, 1000.04)});
  EXPECT_TRUE(cycles.done());
  ASSERT_EQ(4u, cycles.samples().size());
  EXPECT_EQ(0.0, cycles.samples().front().time);
  EXPECT_NEAR(0.03, cycles.samples().back().time, 1e-9);
  EXPECT_EQ(0u, cycles.missing());
}

// Behind the end nothing counts any more.
TEST(ScopeCycles, CountsWhatIsMissing) {
  ScopeCycles cycles{0.05};
  cycles.take({cycle(5, 0.0), cycle(6, 0.01), cycle(9, 0.04)});
  EXPECT_EQ(2u, cycles.missing());
  cycles.take({cycle(9, 0.04), cycle(10, 0.05), cycle(20, 0.15)});
  EXPECT_EQ(2u, cycles.missing());
  EXPECT_EQ(4u, cycles.samples().size());
}

// Its cycles would not be counted until there are as many again.
TEST(ScopeCycles, EndWithANodeThatIsStartedAnew) {
  ScopeCycles cycles{10.0};
  cycles.take({cycle(5000, 100.0), cycle(5001, 100.01), cycle(5001, 100.01)});
  EXPECT_FALSE(cycles.done() || cycles.restarted());
  cycles.take({cycle(3, 0.03), cycle(4, 0.04)});
  EXPECT_TRUE(cycles.done() && cycles.restarted());
  EXPECT_EQ(2u, cycles.samples().size());
  EXPECT_EQ(0u, cycles.missing());
}

}  // namespace
}  // namespace nord_driver::tools
