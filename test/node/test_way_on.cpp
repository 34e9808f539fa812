// What comes next after a stop: the drive that is missing before the one with a fault, and ~enable always last.
#include <gtest/gtest.h>

#include "node/way_on.h"

namespace nord_driver::node {
namespace {

const std::vector<std::string> kNames{"left", "right"};

class WayOn : public ::testing::Test {
 protected:
  WayOn() {
    snapshot.connected = true;
    for (auto& drive : snapshot.drives) drive.online = true;
  }
  cycle::CycleSnapshot snapshot{2};
};

TEST_F(WayOn, IsEnableWhenNothingStandsInTheWay) {
  EXPECT_EQ("~enable", wayOn(snapshot, kNames));
}

TEST_F(WayOn, LeadsOverTheFaultThoughItsNumberIsNotReadOrItIsGoneInTheInverter) {
  snapshot.drives[1].fault_number = 21;
  EXPECT_EQ("remove the cause (see \"drive right\"), then ~acknowledge_faults, then ~enable", wayOn(snapshot, kNames));
  snapshot.drives[1].fault_number = 0;
  snapshot.drives[1].fault_latched = true;
  EXPECT_EQ("remove the cause (see \"drive right\"), then ~acknowledge_faults, then ~enable", wayOn(snapshot, kNames));
}

TEST_F(WayOn, BeginsWithWhatIsMissing) {
  snapshot.drives[0].fault_latched = true;
  snapshot.drives[1].online = false;
  EXPECT_EQ("bring drive right back (see \"drive right\"), then ~enable", wayOn(snapshot, kNames));
  snapshot.connected = false;
  EXPECT_EQ("bring the bus back (see \"bus\"), then ~enable", wayOn(snapshot, kNames));
}

}  // namespace
}  // namespace nord_driver::node
