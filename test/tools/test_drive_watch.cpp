// Two simulated drives watched by a guest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/drive_watch.h"
#include "tools/linked_drive.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {
namespace {

using sim::InverterState;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Both : public LinkedDrive {
 public:
  explicit Both(int ppo_type = 1) : LinkedDrive({}, true, ppo_type, {"right", "left"}) {}

  void run(Duration span) {
    const std::atomic<bool> not_asked{false};
    link().exchangeUntil(link().now() + span, not_asked);
  }
};

// In the order of the command, with the idle word and nothing that moves.
TEST(DriveWatch, ShowsSeveralDrivesAtRest) {
  Both drives;
  drives.connect();
  DriveWatch watch{drives.link(), {"P102", "P700[-01]"}};
  const std::vector<WatchedDrive> seen = watch.look();
  ASSERT_EQ(2u, seen.size());
  EXPECT_EQ("right", seen[0].name);
  EXPECT_EQ("left", seen[1].name);
  for (const WatchedDrive& drive : seen) {
    EXPECT_TRUE(drive.online);
    EXPECT_EQ(0x047E, drive.output.control_word);
    EXPECT_EQ(0, drive.output.setpoints[0]);
    EXPECT_EQ(0.0, drive.frequency);
    EXPECT_EQ("none", drive.fault);
    EXPECT_THAT(drive.values, ::testing::ElementsAre("2.00 s", "0.0 no fault"));
  }
  EXPECT_THAT(watch.labels(), ::testing::ElementsAre("P102 Acceleration time", "P700[-01] Current error"));
  drives.run(std::chrono::seconds{10});
  for (const sim::DriveUnit* drive : {&drives.left(), &drives.right()}) {
    EXPECT_EQ(InverterState::kReadyToSwitchOn, drive->inverter().state());
    EXPECT_EQ(0x047E, drive->counters().last_control);
  }
}

TEST(DriveWatch, NamesTheFaultOfTheDriveThatHasOne) {
  Both drives;
  drives.connect();
  DriveWatch watch{drives.link(), {}};
  drives.left().inverter().trip(40, true);
  drives.run(std::chrono::seconds{1});
  const std::vector<WatchedDrive> seen = watch.look();
  EXPECT_EQ("none", seen[0].fault);
  EXPECT_THAT(seen[1].fault, HasSubstr("E4.0 "));
}

// The other one goes on, and waits for nobody.
TEST(DriveWatch, SaysWhichDriveFellSilent) {
  Both drives;
  drives.connect();
  DriveWatch watch{drives.link(), {"P102"}};
  drives.left().setPlugged(false);
  drives.run(std::chrono::seconds{3});
  const Instant before = drives.link().now();
  const std::vector<WatchedDrive> seen = watch.look();
  EXPECT_LT(drives.link().now() - before, std::chrono::milliseconds{500});
  EXPECT_TRUE(seen[0].online);
  EXPECT_FALSE(seen[1].online);
}

// One of them is turned: no word but 0000 goes to any of them.
TEST(DriveWatch, LeavesAllAsTheyAreWhenOneRuns) {
  Both drives;
  drives.segment().run(std::chrono::seconds{1});
  for (const std::uint16_t word : {std::uint16_t{0x047E}, std::uint16_t{0x047F}}) {
    sim::ProcessData data;
    data.control = word;
    data.setpoints[0] = 0x1000;
    drives.left().inverter().receive(data);
    drives.segment().run(std::chrono::seconds{2});
  }
  EXPECT_EQ("drive left is not at rest (operation enabled): it was left as it is; disable it first", drives.trouble());
  EXPECT_EQ(0x0000, drives.left().counters().last_control);
  EXPECT_EQ(0x0000, drives.right().counters().last_control);
  EXPECT_EQ(InverterState::kOperationEnabled, drives.left().inverter().state());
}

// The first words that act would reach a drive that is not seen yet.
TEST(DriveWatch, WaitsForAllOfThem) {
  Both drives;
  drives.left().setPlugged(false);
  EXPECT_THAT(drives.trouble(), HasSubstr("drive left (PROFIBUS station 3) does not answer"));
  EXPECT_EQ(0x0000, drives.right().counters().last_control);
}

// The lift positions: its actual value 1 is what P543 says, 1 the frequency and 10 a position. A wheel's P543 nobody asks.
std::optional<double> frequencyOfLift(std::int32_t p543) {
  YAML::Node file = LinkedDrive::file(2);
  file["drives"]["left"] = YAML::Load(
      "{address: 3, series: sk5xxe, ppo_type: 2, pole_pairs: 2, joint: lift_joint, mode: position, lead: 0.2}");
  LinkedDrive drives{file, {{543, 0, 0, p543}}, true, 2, {"left", "right"}};
  drives.connect();
  DriveWatch watch{drives.link(), {}};
  const std::vector<WatchedDrive> seen = watch.look();
  EXPECT_TRUE(seen[0].online);
  EXPECT_EQ(0.0, seen[1].frequency);
  EXPECT_EQ(seen[0].frequency, watch.look()[0].frequency) << "asked once, and kept";
  return seen[0].frequency;
}

TEST(DriveWatch, TakesNoPositionForAFrequency) {
  EXPECT_EQ(0.0, frequencyOfLift(1));
  EXPECT_EQ(std::nullopt, frequencyOfLift(10));
}

TEST(DriveWatch, RefusesAParameterThatCannotBe) {
  Both drives;
  EXPECT_THROW((DriveWatch{drives.link(), {"Maximum frequenzy"}}), UsageError);
  EXPECT_THAT(DriveWatch(drives.link(), {"P719"}).labels(), ::testing::ElementsAre("P719")) << "read raw";
}

}  // namespace
}  // namespace nord_driver::tools
