// nord_param looks on through the driver's node, and the node ends.
#include <gmock/gmock.h>
#include <signal.h>

#include "rostest/robot_under_test.h"
#include "tools/program.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

constexpr std::chrono::seconds kPatient{60};
constexpr char kEnded[] =
    "nord_param: through node /nord_driver, which has the bus\n"
    "nord_param: node /nord_driver has ended: nothing more is known of its drives\n";

class NordParamUntilTheEnd : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_NO_FATAL_FAILURE(startDriver());
    ASSERT_TRUE(ros::param::get("nord_driver/bus/device", device_));
  }
  void TearDown() override {
    switchDrivesOffAndOn();  // a driver that was killed leaves its time-out behind
    RobotTest::TearDown();
  }
  std::vector<std::string> command(const std::vector<std::string>& words) const {
    std::vector<std::string> all{NORD_PARAM_PROGRAM, "--config", NORD_ROBOT_FILE, "--bus", device_};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }

  std::string device_;
};

TEST_F(NordParamUntilTheEnd, WatchingEndsWithTheNode) {
  Program watching{command({"watch", "left"})};
  ASSERT_TRUE(watching.saysSomething(kPatient)) << watching.errors();
  driver_->signal(SIGTERM);
  EXPECT_EQ(1, watching.wait(kPatient));
  EXPECT_EQ(kEnded, watching.errors());
}

// Nobody tells the ROS master of it.
TEST_F(NordParamUntilTheEnd, WatchingEndsWhenTheNodeIsKilled) {
  Program watching{command({"watch", "left"})};
  ASSERT_TRUE(watching.saysSomething(kPatient)) << watching.errors();
  driver_->signal(SIGKILL);
  EXPECT_EQ(1, watching.wait(kPatient));
  EXPECT_EQ(kEnded, watching.errors());
}

// What came before is kept.
TEST_F(NordParamUntilTheEnd, AScopeKeepsWhatCame) {
  Program scope{command({"scope", "left", "--duration", "600"})};
  const std::size_t mark = robot().left.status.mark();
  EXPECT_TRUE(robot().left.status.waitFrom(mark + 200, [](const DriveStatus&) { return true; }));
  driver_->signal(SIGKILL);
  EXPECT_EQ(1, scope.wait(kPatient));
  EXPECT_THAT(scope.errors(), HasSubstr("node /nord_driver has ended"));
  EXPECT_THAT(scope.output(), HasSubstr(",1,047E,"));
}

// Ctrl-C ends the looking, not the node.
TEST_F(NordParamUntilTheEnd, CtrlCEndsTheWatchingOnly) {
  Program watching{command({"watch", "left"})};
  ASSERT_TRUE(watching.saysSomething(kPatient)) << watching.errors();
  watching.signal(SIGINT);
  EXPECT_EQ(0, watching.wait(kPatient)) << watching.errors();
  EXPECT_NE(nullptr, robot().left.status.next());
}

}  // namespace
}  // namespace nord_driver::test
