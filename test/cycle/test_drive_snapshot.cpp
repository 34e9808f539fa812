// The picture of a drive that a cycle publishes: what topics and services tell is what the drive and its parameters said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "cycle/drive_snapshot.h"
#include "cycle/parameter_requests.h"
#include "cycle/scripted_transport.h"
#include "cycle/user_messages.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

class DriveSnapshotTest : public ::testing::Test {
 protected:
  DriveSnapshotTest() {
    report_.online = true;
    report_.phase = drive::Phase::kEnabled;
  }
  const DriveSnapshot& picture(bool positions = false) {
    const DrivePictured from{0, "lift", report_, sent_, axis_, true, positions, false};
    fillDriveSnapshot(picture_, from, transport_, now_);
    return picture_;
  }

  ScriptedTransport transport_{1};
  drive::DriveReport report_;
  profile::ProcessOutput sent_;
  Axis axis_{0, DriveSetup{}, ParameterChannelUse{}};
  DriveSnapshot picture_;
  Instant now_{std::chrono::hours{1}};
};

TEST_F(DriveSnapshotTest, TellsSpeedsAsTheDriveReportsThem) {
  report_.velocity_command = RadPerSec{3.0};
  report_.velocity = RadPerSec{2.5};
  report_.frequency = Hertz{40.0};
  EXPECT_EQ(3.0, picture().velocity_command);
  EXPECT_EQ(2.5, picture().velocity);
  EXPECT_EQ(40.0, picture().frequency);
}

TEST_F(DriveSnapshotTest, TellsWhetherItTurnsAsItIsTold) {
  axis_.speed.update(true, 10.0, 10.1, 100.0, now_);
  EXPECT_NEAR(0.1, picture().speed_deviation, 1e-9);
  EXPECT_TRUE(picture().at_speed);
  EXPECT_FALSE(picture().not_following);
  axis_.speed.update(true, 10.0, 50.0, 100.0, now_);
  axis_.speed.update(true, 10.0, 50.0, 100.0, now_ + SpeedWatch::kPatience);
  EXPECT_FALSE(picture().at_speed);
  EXPECT_TRUE(picture().not_following);
}

TEST_F(DriveSnapshotTest, TellsThatSignAndDirectionBitsContradict) {
  EXPECT_FALSE(picture().direction_contradiction);
  report_.direction_contradiction = true;
  EXPECT_TRUE(picture().direction_contradiction);
}

TEST_F(DriveSnapshotTest, TellsWhyItDoesNotBecomeReady) {
  EXPECT_FALSE(picture().switch_on_reason);
  report_.switch_on_reason = 34;
  EXPECT_EQ(34, picture().switch_on_reason);
  report_.switch_on_reason.reset();
  EXPECT_FALSE(picture().switch_on_reason);
}

TEST_F(DriveSnapshotTest, TellsWhereItIsAndWhereItGoes) {
  drive::PositionReport& position = report_.position;
  position.position = 1.25;
  position.target = 2.0;
  position.following = true;
  position.at_limit = true;
  position.held_back = true;
  EXPECT_EQ(1.25, picture(true).position);
  EXPECT_EQ(1.25, picture_.joint_position);
  EXPECT_EQ(2.0, picture_.position_target);
  EXPECT_TRUE(picture_.position_following && picture_.position_at_limit && picture_.position_held_back);
  EXPECT_FALSE(picture_.position_reached);
  position = {};
  position.reached = true;
  EXPECT_TRUE(picture(true).position_reached);
  EXPECT_FALSE(picture_.position || picture_.position_target);
  EXPECT_FALSE(picture_.position_following || picture_.position_at_limit || picture_.position_held_back);
  EXPECT_EQ(1.25, picture_.joint_position) << "the last one known";
}

// It was enabled in this cycle and taken back in it: another drive refused.
TEST_F(DriveSnapshotTest, TellsNoTargetOfADriveThatIsNotEnabled) {
  report_.phase = drive::Phase::kIdle;
  report_.position.target = 2.0;
  report_.position.reached = report_.position.following = true;
  EXPECT_FALSE(picture(true).position_target);
  EXPECT_FALSE(picture_.position_reached || picture_.position_following);
}

TEST_F(DriveSnapshotTest, TellsWhyTheNewestTargetWasNotTaken) {
  EXPECT_TRUE(picture(true).position_refused.empty());
  axis_.targets.refuse(Sentence{"P613 could not be read"}, now_);
  EXPECT_EQ("P613 could not be read", picture(true).position_refused.str());
}

// Why it stopped comes first; a fault without one, of a drive that was never enabled, is told as what refuses enabling.
TEST_F(DriveSnapshotTest, SaysWhyItStoppedOrWillNotStart) {
  EXPECT_TRUE(picture().text.empty());
  report_.phase = drive::Phase::kIdle;
  report_.fault_latched = true;
  EXPECT_EQ(refusalMessage("lift", drive::Refusal::kFaultLatched, report_).str(), picture().text.str());
  report_.stop_cause = drive::StopCause::kFault;
  EXPECT_THAT(picture().text.str(), HasSubstr("drive lift stopped: "));
  report_.fault_latched = false;
  EXPECT_THAT(picture().text.str(), HasSubstr("drive lift stopped: "));
  report_.online = false;
  EXPECT_EQ("the note of the bus", picture().text.str());
}

// Away, nobody knows what became of its fault; that it comes back with the same one is no second fault.
TEST_F(DriveSnapshotTest, KeepsTheFaultOfASilentDrive) {
  report_.input.status_word = 0x0B38;
  EXPECT_TRUE(picture().fault);
  EXPECT_EQ(1u, picture_.faults);
  report_.online = false;
  report_.input.status_word = 0;
  EXPECT_TRUE(picture().fault);
  report_.online = true;
  report_.input.status_word = 0x0B38;
  EXPECT_TRUE(picture().fault);
  EXPECT_EQ(1u, picture_.faults);
  report_.input.status_word = 0x0B31;
  EXPECT_FALSE(picture().fault);
}

// A write that is to spare the EEPROM switches P560 off, which costs a write itself; whoever looks sees that it stands so.
TEST_F(DriveSnapshotTest, TellsWhatWritingCosts) {
  ParameterChannelUse channel;
  channel.capabilities.ram_writes = false;
  axis_ = Axis{0, DriveSetup{}, channel};
  drive::Drive drive{drive::DriveConfig{}};
  profile::ProcessInput input;
  input.status_word = 0x0B31;
  drive.handleInput(input, true, now_);
  axis_.parameters.handleState(drive, now_);
  axis_.parameters.handleRequest(test::writeRequest(0, 102, 250), drive, now_);
  std::map<int, std::int32_t> values{{102, 100}, {560, 1}};
  bool owed = false;
  for (int cycle = 0; cycle < 100; ++cycle) {
    while (const auto request = axis_.parameters.pollRequest(now_)) {
      if (request->action != profile::ParameterAction::kRead) values[request->number] = request->raw;
      axis_.parameters.handleResult(ScriptedTransport::done(request->id, values[request->number]));
      if (values[560] == 0) {
        EXPECT_TRUE(picture().owes_eeprom_switch);
      }
      owed = owed || picture().owes_eeprom_switch;
    }
  }
  EXPECT_TRUE(owed);
  EXPECT_FALSE(picture().owes_eeprom_switch);
  EXPECT_EQ(250, values[102]);
  EXPECT_EQ(2u, picture().eeprom_writes) << "P560, off and on";
}

}  // namespace
}  // namespace nord_driver::cycle
