// What comes next after a stop: the drive that is missing before the one with a fault, and ~enable always last.
#include <gtest/gtest.h>

#include "node/recovery_hint.h"

namespace nord_driver::node {
namespace {

const std::vector<std::string> kNames{"left", "right"};

class RecoveryHint : public ::testing::Test {
 protected:
  RecoveryHint() {
    snapshot.connected = true;
    for (auto& drive : snapshot.drives) drive.online = true;
  }
  cycle::CycleSnapshot snapshot{2};
};

TEST_F(RecoveryHint, IsEnableWhenNothingStandsInTheWay) {
  EXPECT_EQ("~enable", recoveryHint(snapshot, kNames));
}

TEST_F(RecoveryHint, LeadsOverTheFaultThoughItsNumberIsNotReadOrItIsGoneInTheInverter) {
  snapshot.drives[1].fault_number = 21;
  EXPECT_EQ("remove the cause (see \"drive right\"), then ~acknowledge_faults, then ~enable",
            recoveryHint(snapshot, kNames));
  snapshot.drives[1].fault_number = 0;
  snapshot.drives[1].fault_latched = true;
  EXPECT_EQ("remove the cause (see \"drive right\"), then ~acknowledge_faults, then ~enable",
            recoveryHint(snapshot, kNames));
}

TEST_F(RecoveryHint, BeginsWithWhatIsMissing) {
  snapshot.drives[0].fault_latched = true;
  snapshot.drives[1].online = false;
  EXPECT_EQ("bring drive right back (see \"drive right\"), then ~enable", recoveryHint(snapshot, kNames));
  snapshot.connected = false;
  EXPECT_EQ("bring the bus back (see \"bus\"), then ~enable", recoveryHint(snapshot, kNames));
}

}  // namespace
}  // namespace nord_driver::node
