// The node dies without a word: only the drives themselves can stop the robot then.
#include <gmock/gmock.h>
#include <signal.h>

#include <cmath>

#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kTurning = 1.0;  // rad/s at the wheel

using Killed = RobotTest;

// The module's watchdog, its time-out or the node's life time expires, the inverter trips E10.2 or E10.0 and takes the voltage off:
// the wheel coasts, no ramp (BU 0220 6.1). A node that starts over it names the fault and neither acknowledges nor
// enables by itself.
TEST_F(Killed, TheDrivesSwitchOffByTheirWatchdogAndTheNextNodeNamesTheFault) {
  ASSERT_NO_FATAL_FAILURE(startDriver());
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.4));
  const std::size_t left_from = robot().left.truth.mark();
  const std::size_t right_from = robot().right.truth.mark();
  driver_->signal(SIGKILL);
  const auto end = driver_->waitEnd(kPatience);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->signal, SIGKILL);

  for (const auto& [drive, from] :
       {std::make_pair(&robot().left, left_from), std::make_pair(&robot().right, right_from)}) {
    const auto off = drive->truth.waitFrom(from, [](const SimDrive& truth) { return !truth.operation_enabled; });
    ASSERT_TRUE(off);
    EXPECT_EQ(off->fault_number, bus().master_lost);
    EXPECT_EQ(off->watchdog_trips, 1u);
    EXPECT_EQ(off->last_control_word_before_loss, 0x047F);
    EXPECT_EQ(off->status_word_at_loss & 0x006F, 0x0027) << "operation enabled to the end";
    EXPECT_EQ(off->zero_control_words, 0u);
    EXPECT_GT(std::fabs(off->wheel_velocity), kTurning) << "it coasts";
    EXPECT_FALSE(off->in_data_exchange);
  }
  EXPECT_TRUE(robot().waitForStandstill());

  // The idle word of the next node takes the enable away, which acknowledges (BU 0020 8): the fault is gone without
  // anybody having asked for it. The driver has seen it and keeps it.
  robot().drive(0.0);
  const std::size_t left_again = robot().left.truth.mark();
  ASSERT_NO_FATAL_FAILURE(startDriver());
  const auto error = [](int level, const std::string&) { return level == diagnostic_msgs::DiagnosticStatus::ERROR; };
  EXPECT_THAT(robot().waitForDiagnostics("drive left", error), HasSubstr("fault"));
  const Answer refused = robot().enable(true);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.message, AllOf(HasSubstr("drives left, right"), HasSubstr("fault")));
  EXPECT_EQ(robot().left.truth.next()->control_word, 0x047E);
  for (const auto& truth : robot().left.truth.since(left_again)) {
    ASSERT_FALSE(truth->operation_enabled);
    ASSERT_EQ(truth->control_word & 0x0080, 0) << "acknowledged without being asked";
  }

  // Asked to, it acknowledges; enabled, it drives.
  const Answer acknowledged = robot().trigger("acknowledge_faults");
  EXPECT_TRUE(acknowledged.success) << acknowledged;
  EXPECT_FALSE(robot().left.truth.next()->operation_enabled);
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.3));
}

}  // namespace
}  // namespace nord_driver::test
