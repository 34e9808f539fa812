// One sentence for a technician: what the bus waits for, or that all is well.
#include <gtest/gtest.h>

#include "node/bus_publisher.h"

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

// When the bus itself is gone, its drives are not named.
TEST(BusSentence, TheBusComesBeforeItsDrives) {
  cycle::CycleSnapshot snapshot{2};
  snapshot.bus_text = "/dev/ttyUSB0: no such device";
  EXPECT_EQ("/dev/ttyUSB0: no such device", busSentence(snapshot, kNames));
}

// A long drive_timeout keeps drives online for a while that no longer answer: the loss of the bus is trouble at once.
TEST(BusSentence, ALostBusIsNotWellWhileItsDrivesStillCountAsOnline) {
  cycle::CycleSnapshot snapshot{2};
  snapshot.connected = true;
  for (auto& drive : snapshot.drives) drive.online = true;
  EXPECT_TRUE(busIsWell(snapshot));
  snapshot.connected = false;
  snapshot.bus_text = "no station answers";
  EXPECT_FALSE(busIsWell(snapshot));
  snapshot.connected = true;
  EXPECT_FALSE(busIsWell(snapshot)) << "what the sentence tells is not that all is well";
  snapshot.bus_text = "";
  snapshot.drives[1].online = false;
  EXPECT_FALSE(busIsWell(snapshot));
}

}  // namespace
}  // namespace nord_driver::node
