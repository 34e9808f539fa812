// A slave that was not heard for a moment, and is gone on with before its watchdog has run out, has not forgotten what its
// acyclic channel was asked: a response waits there, and while it does, another request is answered RR, no resource.
#include <gtest/gtest.h>

#include "profibus/record_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

constexpr const char* kReadResponse2 = "68 11 11 68 81 88 08 33 33 5E 00 65 08 15 E4 00 00 00 00 00 02 3D 16";
constexpr const char* kNoResource = "10 01 08 02 0B 16";

void fallsSilent(RecordWire& wire) {
  wire.startCycle();
  for (int i = 0; i < 2; ++i) {
    wire.sends(kExchange7D);
    wire.staysSilent();
  }
  wire.cycleEnds();
  EXPECT_EQ(LossCause::kSilence, wire.tells(DpEventKind::kSlaveLost).cause);
}

void isFoundAndGoneOnWith(RecordWire& wire) {
  wire.isFound();
  wire.isGoneOnWith(kReady0ba8);
  EXPECT_EQ(SlavePhase::kDataExchange, wire.status().phase);
}

/// Asked for a record, which it takes; then it is not heard for a moment.
void isAskedAndFallsSilent(RecordWire& wire) {
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, "E5");
  fallsSilent(wire);
  EXPECT_EQ(RecordOutcome::kOffline, wire.result().outcome);
}

TEST(ResumedRecords, TheResponseThatWaitsIsFetchedFirst) {
  RecordWire wire;
  ASSERT_NO_FATAL_FAILURE(isAskedAndFallsSilent(wire));
  isFoundAndGoneOnWith(wire);

  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kPoll5C, kReadResponse);
  EXPECT_FALSE(wire.master.pollRecord()) << "that was the answer to the one before";
  wire.cycleWith(kReadRequest, kReadResponse2);
  const RecordResult result = wire.result();
  EXPECT_EQ(RecordOutcome::kDone, result.outcome);
  EXPECT_EQ("15 E4 00 00 00 00 00 02", toHex(result.data));
}

// It may be making the response still.
TEST(ResumedRecords, AResponseInTheMakingIsWaitedFor) {
  RecordWire wire;
  ASSERT_NO_FATAL_FAILURE(isAskedAndFallsSilent(wire));
  isFoundAndGoneOnWith(wire);

  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kPoll5C, "E5");
  wire.cycleWith(kPoll5C, "E5");
  wire.advance(500ms);  // C1_Response_Timeout
  wire.cycleWith(kPoll5C, "E5");
  wire.cycleWith(kReadRequest, kReadResponse2);
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);
}

// One that starts anew has forgotten it.
TEST(ResumedRecords, AfterAStartUpNothingWaits) {
  RecordWire wire;
  ASSERT_NO_FATAL_FAILURE(isAskedAndFallsSilent(wire));
  wire.advance(2s);
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, kReadResponse2);
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);
}

// Whatever response it is that nobody has fetched: a request that was refused to its end for it makes way for polls.
TEST(ResumedRecords, NoResourceToTheEndIsFollowedByPolls) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  for (int i = 0; i < 3; ++i) wire.cycleWith(kReadRequest, kNoResource);
  wire.advance(500ms);
  wire.cycleWith(kPoll5C, kReadResponse);
  EXPECT_EQ(RecordOutcome::kTimedOut, wire.result().outcome);
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, kReadResponse2);
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);
}

}  // namespace
}  // namespace nord_driver::profibus
