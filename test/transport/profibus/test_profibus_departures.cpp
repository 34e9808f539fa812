// A station that left data exchange unasked: said to its drives, once.
#include <array>

#include "transport/profibus/on_a_segment.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Counts = std::array<int, 2>;

// Its drive would go on as it was told last, without `~enable`, once the station is set up again within drive_timeout.
TEST_F(OnASegment, AStationThatWasResetIsToldOnce) {
  bringUp();
  EXPECT_EQ((Counts{0, 0}), unasked_) << "the start-up is none";
  segment_->station(0).setPowered(false);
  segment_->station(0).setPowered(true);
  step();  // it does not know our frame count any more, and is silent
  EXPECT_EQ((Counts{0, 0}), unasked_);
  step();
  EXPECT_EQ((Counts{1, 0}), unasked_) << "in the cycle in which it answers RS";
  EXPECT_FALSE(inputs_[0].module_answers);
  ASSERT_TRUE(runUntil([this] { return bothAnswer(); }, seconds{1}));
  run(seconds{1});
  EXPECT_EQ((Counts{1, 0}), unasked_);
}

// Silence is drive_timeout's: a station that is gone on with has left nothing.
TEST_F(OnASegment, AStationThatWasSilentHasNotLeft) {
  bringUp();
  for (const milliseconds silence : {milliseconds{10}, milliseconds{120}}) {
    segment_->station(0).setMute(true);
    run(silence);
    segment_->station(0).setMute(false);
    ASSERT_TRUE(runUntil([this] { return bothAnswer(); }, seconds{1}));
  }
  EXPECT_EQ((Counts{0, 0}), unasked_);
}

// Silent until its watchdog ran out: found again, it is set up anew. Whether drive_timeout is longer than that nobody knows
// here.
TEST_F(OnASegment, AStationThatIsSetUpAnewAfterASilenceHasLeft) {
  bringUp();
  segment_->station(0).setMute(true);
  run(seconds{1});
  EXPECT_EQ((Counts{0, 0}), unasked_);
  segment_->station(0).setMute(false);
  ASSERT_TRUE(runUntil([this] { return bothAnswer(); }, seconds{2}));
  EXPECT_EQ((Counts{1, 0}), unasked_);
}

// This computer stood still, and the watchdogs ran out.
TEST_F(OnASegment, StationsLeaveAMasterThatStoodStill) {
  bringUp();
  segment_->run(seconds{1});
  step();
  EXPECT_EQ((Counts{1, 1}), unasked_);
}

}  // namespace
}  // namespace nord_driver
