#include <gmock/gmock.h>

#include "trace/fault_tracer.h"
#include "trace/trace_fixture.h"

namespace nord_driver::trace {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Word kRunning = 0x0B37, kFaulted = 0x0B38;

class FaultTracerTest : public TraceTest {
 protected:
  TelegramTrace trace_{kLinkTypeProfibusDl, nullptr, 10};
  TraceWriter writer_{{directory_, 20}, drives(), &trace_, feed_.history()};
  FaultTracer tracer_{feed_, writer_};
};

// A fault is one trace, a moment later, and none after it.
TEST_F(FaultTracerTest, OneFaultIsOneTrace) {
  cycle(0, kRunning, kRunning);
  cycle(10, kFaulted, kRunning);
  EXPECT_FALSE(tracer_.poll(clockAt(20)));
  EXPECT_FALSE(tracer_.poll(clockAt(209)));
  const auto result = tracer_.poll(clockAt(210));
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->written) << result->message;
  for (int ms = 220; ms < 1000; ms += 10) {
    cycle(ms, kFaulted, kRunning);
    EXPECT_FALSE(tracer_.poll(clockAt(ms)));
  }
  EXPECT_THAT(files(), ElementsAre("nord_driver_20231114T221320.010Z_fault_left.pcap",
                                   "nord_driver_20231114T221320.010Z_fault_left.txt"));
  EXPECT_THAT(read(files()[1]), HasSubstr("\nreason: drive left: a fault (status word 0B38)\n"));
}

// What a fault brings with it stands in its trace, each reason once.
TEST_F(FaultTracerTest, ConsequencesBelongToTheirFault) {
  snapshot_.base.stop_cause = drive::StopCause::kFault;
  snapshot_.base.text = snapshot_.drives[0].text = "drive left stopped: a fault";
  cycle(10, kFaulted, kRunning);
  cycle(20, kFaulted, kFaulted);
  ASSERT_TRUE(tracer_.poll(clockAt(210)));
  EXPECT_FALSE(tracer_.poll(clockAt(1000)));
  ASSERT_EQ(2u, files().size());
  EXPECT_THAT(read(files()[1]), HasSubstr(" trace\nreason: drive left stopped: a fault\n"
                                          "reason: drive right: a fault (status word 0B38)\ntime 0: "));
}

// The next incident is the next trace.
TEST_F(FaultTracerTest, ALaterFaultIsAnotherTrace) {
  cycle(0, kFaulted, kRunning);
  ASSERT_TRUE(tracer_.poll(clockAt(200)));
  cycle(210, kFaulted, kFaulted);
  ASSERT_TRUE(tracer_.poll(clockAt(410)));
  EXPECT_EQ(4u, files().size());
}

// The node that ends writes what still waits.
TEST_F(FaultTracerTest, TheEndWritesWhatWaits) {
  EXPECT_FALSE(tracer_.finish(clockAt(0)));
  cycle(0, kFaulted, kRunning);
  EXPECT_FALSE(tracer_.poll(clockAt(1)));
  EXPECT_TRUE(tracer_.finish(clockAt(2)));
  EXPECT_EQ(2u, files().size());
}

}  // namespace
}  // namespace nord_driver::trace
