// One sentence for a technician: what the bus waits for, or that all is well.
#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gtest/gtest.h>

#include "node/bus_publisher.h"

namespace nord_driver::node {
namespace {

using diagnostic_msgs::DiagnosticStatus;

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

// /diagnostics shows no sentence of trouble as OK.
TEST(BusSentence, ItsLevelFitsTheSentence) {
  cycle::CycleSnapshot snapshot{2};
  snapshot.bus_text = "no station answers";
  EXPECT_EQ(DiagnosticStatus::ERROR, busLevel(snapshot));
  snapshot.connected = true;
  for (auto& drive : snapshot.drives) drive.online = true;
  snapshot.bus_text = "another master is on this segment";
  EXPECT_EQ(DiagnosticStatus::WARN, busLevel(snapshot));
  snapshot.bus_text = "";
  EXPECT_EQ(DiagnosticStatus::OK, busLevel(snapshot));
  snapshot.drives[1].online = false;
  EXPECT_EQ(DiagnosticStatus::WARN, busLevel(snapshot));
}

// Whatever a transport counts is there by its name; what has a field of its own fills that, too.
TEST(BusStatusCounters, HoldEveryCounterOfTheTransport) {
  BusCounters counters;
  counters.add(bus_counter::kRetries, 7);
  counters.add({"lamps", "lamps that went out"}, 2);
  BusStatus status;
  addCounters(counters, status);
  EXPECT_EQ(7u, status.retries);
  EXPECT_EQ(0u, status.timeouts);
  ASSERT_EQ(2u, status.counters.size());
  EXPECT_EQ("retries", status.counters[0].name);
  EXPECT_EQ("lamps", status.counters[1].name);
  EXPECT_EQ(2u, status.counters[1].value);
  EXPECT_EQ("lamps that went out", status.counters[1].meaning);
}

}  // namespace
}  // namespace nord_driver::node
