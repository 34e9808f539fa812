// One sentence for a technician: what the bus waits for, or that all is well.
#include <gtest/gtest.h>

#include "nord_driver/node/bus_publisher.h"

namespace nord_driver::node {
namespace {

const std::vector<std::string> kNames{"left", "right"};

TEST(BusSentence, SaysThatAllIsWell) {
  cycle::CycleSnapshot snapshot{2};
  for (auto& drive : snapshot.drives) drive.online = true;
  EXPECT_EQ("all drives answer", busSentence(snapshot, kNames));
}

TEST(BusSentence, NamesEachDriveThatIsSilentWithItsReason) {
  cycle::CycleSnapshot snapshot{2};
  snapshot.drives[0].text = "check its power";
  EXPECT_EQ("drive left: check its power; drive right: no answer", busSentence(snapshot, kNames));
  snapshot.drives[0].online = true;
  EXPECT_EQ("drive right: no answer", busSentence(snapshot, kNames));
}

// When the bus itself is gone, its drives are no news.
TEST(BusSentence, TheBusComesBeforeItsDrives) {
  cycle::CycleSnapshot snapshot{2};
  snapshot.bus_text = "/dev/ttyUSB0: no such device";
  EXPECT_EQ("/dev/ttyUSB0: no such device", busSentence(snapshot, kNames));
}

}  // namespace
}  // namespace nord_driver::node
