// The process data before a fault: the newest cycles, oldest first, up to the one that shows it.
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"
#include "cycle/fault_record.h"

namespace nord_driver::cycle {
namespace {

CycleData numbered(Word number) {
  CycleData data;
  data.output.control_word = number;
  return data;
}

TEST(FaultRecorder, HasTheNewestCyclesInTheirOrder) {
  FaultRecorder recorder;
  FaultRecord record;
  recorder.write(record);
  EXPECT_TRUE(record.empty());
  for (Word i = 0; i < 5; ++i) recorder.handleCycle(numbered(i));
  recorder.write(record);
  ASSERT_EQ(5u, record.size());
  for (Word i = 0; i < 5; ++i) EXPECT_EQ(i, record[i].output.control_word);
  for (Word i = 5; i < 100; ++i) recorder.handleCycle(numbered(i));
  recorder.write(record);
  ASSERT_EQ(33u, record.size());
  for (Word i = 0; i < 33; ++i) EXPECT_EQ(100 - 33 + i, record[i].output.control_word);
}

class FaultRecordTest : public ::testing::Test {
 protected:
  const DriveSnapshot& left() { return bench_.snapshot().drives[CycleBench::kLeft]; }

  CycleBench bench_;
};

// The last record is the cycle with the fault bit, those before it show what led there.
TEST_F(FaultRecordTest, EndsWithTheCycleThatShowsTheFault) {
  bench_.run(300);
  EXPECT_TRUE(left().fault_record.empty());
  ASSERT_TRUE(bench_.ask(RequestKind::kEnable).success);
  for (int i = 0; i < 60; ++i) {
    bench_.commandBase(0.5);
    bench_.step();
  }
  bench_.transport.inverters[CycleBench::kLeft].fault = true;
  bench_.step();
  const FaultRecord record = left().fault_record;
  ASSERT_EQ(33u, record.size());
  EXPECT_EQ(left().at_fault.time, record[32].time);
  EXPECT_EQ(0x0008, record[32].input.status_word & 0x0008);
  EXPECT_EQ(0x047F, record[32].output.control_word);
  for (std::size_t i = 0; i < 32; ++i) {
    EXPECT_EQ(0, record[i].input.status_word & 0x0008) << i;
    EXPECT_TRUE(record[i].answered) << i;
    EXPECT_LT(record[i].time, record[i + 1].time) << i;
    EXPECT_NE(0, record[i].input.actual_values[0]) << i;
  }
  bench_.run(20);
  EXPECT_EQ(record[0].time, left().fault_record[0].time) << "kept as it was";
}

// A drive that does not answer has no status of that cycle.
TEST_F(FaultRecordTest, TellsCyclesWithoutAnAnswer) {
  bench_.run(300);
  bench_.transport.inverters[CycleBench::kLeft].silent = true;
  bench_.run(2);
  bench_.transport.inverters[CycleBench::kLeft].silent = false;
  bench_.transport.inverters[CycleBench::kLeft].fault = true;
  bench_.step();
  const FaultRecord& record = left().fault_record;
  ASSERT_EQ(33u, record.size());
  EXPECT_TRUE(record[32].answered);
  EXPECT_FALSE(record[31].answered);
  EXPECT_FALSE(record[30].answered);
  EXPECT_TRUE(record[29].answered);
}

// P701 is read once its own fault is known, and not again while that stands.
TEST_F(FaultRecordTest, TheInvertersOwnHistoryFollows) {
  bench_.transport.parameters[700] = 21;
  bench_.transport.parameters[701] = 102;
  bench_.run(300);
  EXPECT_FALSE(left().fault_history.asked);
  bench_.transport.inverters[CycleBench::kLeft].fault = true;
  bench_.run(20);
  EXPECT_TRUE(left().fault_history.asked);
  ASSERT_EQ(5u, left().fault_history.numbers.size());
  EXPECT_EQ(102, left().fault_history.numbers[4]);
  bench_.transport.parameters[701] = 40;
  bench_.run(300);
  EXPECT_EQ(102, left().fault_history.numbers[4]);
}

// The driver's own idle word may take a fault away before P700 is answered, which says "no fault" then.
TEST_F(FaultRecordTest, TheInvertersOwnHistoryFollowsAFaultThatVanished) {
  bench_.transport.parameters[700] = 0;
  bench_.transport.parameters[701] = 102;
  bench_.run(300);
  bench_.transport.inverters[CycleBench::kLeft].fault = true;
  bench_.step();
  bench_.transport.inverters[CycleBench::kLeft].switchOffAndOn();
  bench_.run(20);
  EXPECT_FALSE(left().fault);
  EXPECT_EQ(65535, left().last_fault_number);
  EXPECT_TRUE(left().fault_history.asked);
  ASSERT_EQ(5u, left().fault_history.numbers.size());
  EXPECT_EQ(102, left().fault_history.numbers[0]);
}

}  // namespace
}  // namespace nord_driver::cycle
