// Desired, actual and error of the wheels, as diff_drive_controller's wheel_joint_controller_state has them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "node/wheel_states.h"

namespace nord_driver::node {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

class WheelStatesTest : public ::testing::Test {
 protected:
  WheelStatesTest() {
    config_.drives.resize(3);
    for (std::size_t i = 0; i < 3; ++i) config_.drives[i].joint = std::vector<std::string>{"lift", "right", "left"}[i];
    config_.base.emplace();
    config_.base->left = {2};
    config_.base->right = {1};
    states_.emplace(config_);
    snapshot_.time = Instant{} + std::chrono::hours{1};
  }
  void wheel(DriveIndex drive, double position, double velocity, double command) {
    snapshot_.drives[drive].joint_position = position;
    snapshot_.drives[drive].velocity = velocity;
    snapshot_.drives[drive].velocity_command = command;
  }

  cycle::CycleConfig config_;
  std::optional<WheelStates> states_;
  cycle::CycleSnapshot snapshot_{3};
};

TEST_F(WheelStatesTest, NamesTheWheelsOfTheBaseLeftFirst) {
  EXPECT_THAT(states_->joints(), ElementsAre("left", "right"));
}

// A first snapshot has no past: nothing accelerates, and the wanted way begins where the wheel stands.
TEST_F(WheelStatesTest, TheFirstSnapshotIsTheBeginning) {
  wheel(2, 7.0, 1.0, 2.0);
  wheel(1, -3.0, 0.5, 0.5);
  states_->update(snapshot_);
  EXPECT_THAT(states_->desired().positions, ElementsAre(7.0, -3.0));
  EXPECT_THAT(states_->desired().velocities, ElementsAre(2.0, 0.5));
  EXPECT_THAT(states_->desired().accelerations, ElementsAre(0.0, 0.0));
  EXPECT_THAT(states_->actual().velocities, ElementsAre(1.0, 0.5));
  EXPECT_THAT(states_->error().velocities, ElementsAre(1.0, 0.0));
  EXPECT_THAT(states_->error().positions, ElementsAre(0.0, 0.0));
}

TEST_F(WheelStatesTest, TellsWhatWasWantedWhatIsAndTheDifference) {
  wheel(2, 7.0, 1.0, 2.0);
  states_->update(snapshot_);
  snapshot_.time += std::chrono::milliseconds{500};
  wheel(2, 7.75, 1.5, 3.0);
  states_->update(snapshot_);
  EXPECT_THAT(states_->desired().positions, ElementsAre(DoubleNear(8.5, 1e-9), 0.0));
  EXPECT_THAT(states_->desired().accelerations, ElementsAre(DoubleNear(2.0, 1e-9), 0.0));
  EXPECT_THAT(states_->actual().positions, ElementsAre(7.75, 0.0));
  EXPECT_THAT(states_->actual().accelerations, ElementsAre(DoubleNear(1.0, 1e-9), 0.0));
  EXPECT_THAT(states_->error().positions, ElementsAre(DoubleNear(0.75, 1e-9), 0.0));
  EXPECT_THAT(states_->error().velocities, ElementsAre(1.5, 0.0));
  EXPECT_THAT(states_->error().accelerations, ElementsAre(DoubleNear(1.0, 1e-9), 0.0));
}

// What is published twice between two cycles is the same.
TEST_F(WheelStatesTest, ASnapshotSeenBeforeChangesNothing) {
  wheel(2, 0.0, 1.0, 1.0);
  states_->update(snapshot_);
  snapshot_.time += std::chrono::seconds{1};
  wheel(2, 1.0, 2.0, 3.0);
  states_->update(snapshot_);
  states_->update(snapshot_);
  EXPECT_THAT(states_->desired().positions, ElementsAre(DoubleNear(3.0, 1e-9), 0.0));
  EXPECT_THAT(states_->desired().accelerations, ElementsAre(DoubleNear(2.0, 1e-9), 0.0));
}

// Nobody tells a torque: not a number rather than none.
TEST_F(WheelStatesTest, EffortsAreNotKnown) {
  states_->update(snapshot_);
  for (const WheelStates::Points* points : {&states_->desired(), &states_->actual(), &states_->error()}) {
    ASSERT_EQ(2u, points->efforts.size());
    EXPECT_TRUE(std::isnan(points->efforts[0]) && std::isnan(points->efforts[1]));
  }
}

}  // namespace
}  // namespace nord_driver::node
