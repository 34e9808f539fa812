// What /diagnostics tells of the base.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/base_status.h"

namespace nord_driver::node {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using ::testing::ElementsAre;

class BaseStatus : public ::testing::Test {
 protected:
  BaseStatus() {
    snapshot.connected = true;
    for (auto& drive : snapshot.drives) drive.online = true;
  }
  /// "key: value" for each value of the report, which is in `status`.
  std::vector<std::string> values(bool sideways) {
    status = {};
    reportBase(snapshot, {"left", "right"}, sideways, 3, status);
    std::vector<std::string> lines;
    for (const auto& pair : status.values) lines.push_back(pair.key + ": " + pair.value);
    return lines;
  }

  cycle::CycleSnapshot snapshot{2};
  diagnostic_updater::DiagnosticStatusWrapper status;
};

TEST_F(BaseStatus, TheVelocityToTheLeftIsToldWhereABaseMovesSideways) {
  snapshot.base.velocity = {0.5, 0.25, -0.125};
  EXPECT_THAT(values(true), ElementsAre("linear velocity (m/s): 0.5", "velocity to the left (m/s): -0.125",
                                        "angular velocity (rad/s): 0.25", "commands ignored: 3"));
  snapshot.base.velocity = {0.5, 0.25};
  EXPECT_THAT(values(false),
              ElementsAre("linear velocity (m/s): 0.5", "angular velocity (rad/s): 0.25", "commands ignored: 3"));
}

TEST_F(BaseStatus, IsAnErrorWithTheWayOnAfterAStopOnly) {
  values(false);
  EXPECT_EQ(DiagnosticStatus::OK, status.level);
  EXPECT_EQ("disabled", status.message);
  snapshot.base.commanded = true;
  values(false);
  EXPECT_EQ(DiagnosticStatus::WARN, status.level) << "somebody waits for a motion that does not come";
  EXPECT_EQ("disabled, while cmd_vel asks for a motion: send zero, then call ~enable", status.message);
  snapshot.base.enabled = true;
  snapshot.base.waits = "the front wheel is steered";
  values(false);
  EXPECT_EQ(DiagnosticStatus::OK, status.level);
  EXPECT_EQ("enabled: the front wheel is steered", status.message);
  snapshot.base.stopped = true;
  snapshot.base.text = "drive left is lost";
  EXPECT_EQ("to go on: ~enable", values(false).front());
  EXPECT_EQ(DiagnosticStatus::ERROR, status.level);
  EXPECT_EQ("drive left is lost", status.message);
}

}  // namespace
}  // namespace nord_driver::node
