#include "link/modbus/link_fixture.h"
#include "support/count_allocations.h"

namespace nord_driver::link::test {
namespace {

using nord_driver::test::countAllocations;

// What the bus cycle calls, with a server that answers, one that is silent and none at all.
TEST_F(ModbusLinkTest, TheCycleTakesNoMemory) {
  if (!nord_driver::test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  start();
  ASSERT_TRUE(waitConnected());
  RegisterImage outputs;
  outputs.resize(kMostImageWords);
  std::uint64_t seen = 0;
  const auto cycle = [&] {
    for (int i = 0; i < 100; ++i) {
      link->give(outputs);
      link->waitAnswers(link->now() + std::chrono::milliseconds{1});
      seen += link->take().words.size() + link->report().text.empty();
    }
  };
  EXPECT_EQ(0u, countAllocations(cycle));
  server.always({Reaction::kSilent});
  EXPECT_EQ(0u, countAllocations(cycle));
  server.shut();
  EXPECT_EQ(0u, countAllocations(cycle));
  EXPECT_GT(seen, 0u);
}

}  // namespace
}  // namespace nord_driver::link::test
