#include <gtest/gtest.h>

#include "trace/process_data_history.h"

namespace nord_driver::trace {
namespace {

/// Cycle n: setpoint n, status word n on the first drive; the second is silent.
void record(ProcessDataHistory& history, int n) {
  std::vector<profile::ProcessOutput> outputs(2);
  std::vector<DriveExchange> inputs(2);
  outputs[0].setpoints[0] = static_cast<std::int16_t>(n);
  inputs[0].input.status_word = static_cast<Word>(n);
  inputs[0].inverter_answers = true;
  history.record(outputs, inputs, Instant{std::chrono::milliseconds{10 * n}});
}

// A trace shows the cycle of its fault and the 32 before it, every drive in each.
TEST(ProcessDataHistory, GivesTheCycleAnd32BeforeIt) {
  ProcessDataHistory history{2};
  for (int n = 0; n < 100; ++n) record(history, n);
  EXPECT_EQ(100u, history.cycles());
  const auto records = history.upTo(90);
  ASSERT_EQ(2u * 33u, records.size());
  EXPECT_EQ(58u, records.front().cycle);
  EXPECT_EQ(0u, records[0].drive);
  EXPECT_EQ(58, records[0].output.setpoints[0]);
  EXPECT_EQ(58u, records[0].input.status_word);
  EXPECT_TRUE(records[0].answered);
  EXPECT_EQ(1u, records[1].drive);
  EXPECT_FALSE(records[1].answered);
  EXPECT_EQ(90u, records.back().cycle);
  EXPECT_EQ(Instant{std::chrono::milliseconds{900}}, records.back().time);
}

// Who reads on from cycle to cycle gets every one, and nothing false in place of one that is gone or still to come.
TEST(ProcessDataHistory, GivesOneDriveOfOneCycle) {
  ProcessDataHistory history{2};
  for (int n = 0; n < 100; ++n) record(history, n);
  for (int n = 0; n < 100; ++n) {
    const auto first = history.at(static_cast<std::uint64_t>(n), 0);
    const auto second = history.at(static_cast<std::uint64_t>(n), 1);
    ASSERT_TRUE(first && second) << n;
    EXPECT_EQ(static_cast<std::uint64_t>(n), first->cycle);
    EXPECT_EQ(n, first->output.setpoints[0]);
    EXPECT_EQ(1u, second->drive);
  }
  EXPECT_FALSE(history.at(100, 0));
  for (int n = 100; n < 2000; ++n) record(history, n);
  EXPECT_FALSE(history.at(99, 0));
  EXPECT_EQ(1999, history.at(1999, 0)->output.setpoints[0]);
}

// Shortly after the start there are fewer, and before the first cycle none.
TEST(ProcessDataHistory, GivesWhatThereIs) {
  ProcessDataHistory history{2};
  EXPECT_TRUE(history.upTo(0).empty());
  record(history, 0);
  record(history, 1);
  EXPECT_EQ(4u, history.upTo(1).size());
  EXPECT_EQ(4u, history.upTo(20).size());
}

// Whoever comes a second late, at 1000 cycles per second, still finds all 33; later it finds nothing false.
TEST(ProcessDataHistory, WaitsForASlowReader) {
  ProcessDataHistory history{2};
  for (int n = 0; n < 1100; ++n) record(history, n);
  EXPECT_EQ(66u, history.upTo(99).size());
  for (int n = 1100; n < 3000; ++n) record(history, n);
  EXPECT_TRUE(history.upTo(99).empty());
}

}  // namespace
}  // namespace nord_driver::trace
