// A refusal because of a fault tells which one it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalogue/shipped.h"
#include "cycle/request.h"
#include "node/fault_board.h"

namespace nord_driver::node {
namespace {

using cycle::kAllDrives;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class FaultBoardTest : public ::testing::Test {
 protected:
  FaultBoard board_{{"left", "right"},
                    std::vector<catalogue::FaultWords>(2, {catalogue::shippedFaults(), profile::Series::kSk5xxe})};
  cycle::CycleSnapshot snapshot_{2};
};

TEST_F(FaultBoardTest, SaysNothingWhereNoFaultStands) {
  EXPECT_EQ("", board_.text(kAllDrives));
  board_.post(snapshot_);
  EXPECT_EQ("", board_.text(kAllDrives));
}

TEST_F(FaultBoardTest, NamesTheFaultOfEachDrive) {
  snapshot_.drives[1].fault_number = 21;
  board_.post(snapshot_);
  EXPECT_THAT(board_.text(kAllDrives), AllOf(StartsWith("drive right: E2.1, motor overtemperature (I2t); remedy: "),
                                             HasSubstr("let it cool down")));
  EXPECT_EQ("", board_.text(0));
  EXPECT_EQ(board_.text(kAllDrives), board_.text(1));
  snapshot_.drives[0].fault_number = 102;
  board_.post(snapshot_);
  EXPECT_THAT(board_.text(kAllDrives), AllOf(StartsWith("drive left: E10.2, "), HasSubstr("; drive right: E2.1, ")));
}

// It has vanished in the inverter, and is latched here until somebody acknowledges it.
TEST_F(FaultBoardTest, ALatchedFaultIsNamedByItsLastNumber) {
  snapshot_.drives[0].last_fault_number = 21;
  board_.post(snapshot_);
  EXPECT_EQ("", board_.text(0));
  snapshot_.drives[0].fault_latched = true;
  board_.post(snapshot_);
  EXPECT_THAT(board_.text(0), StartsWith("drive left: E2.1, "));
}

TEST_F(FaultBoardTest, ANumberThatCouldNotBeReadIsNoName) {
  snapshot_.drives[0].fault_number = 65535;
  board_.post(snapshot_);
  EXPECT_EQ("", board_.text(0));
}

}  // namespace
}  // namespace nord_driver::node
