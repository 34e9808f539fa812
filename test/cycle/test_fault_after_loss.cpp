// A fault of a drive whose mains were switched off and on: gone with them, or standing still.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

class FaultAfterLoss : public ::testing::Test, protected CycleBench {
 protected:
  /// Drive left has the fault `number`, and its mains go off.
  void failAndVanish(int number) {
    run(100);
    transport.parameters[700] = number;
    transport.inverters[kLeft].fault = true;
    run(10);
    ASSERT_EQ(number, snapshot().drives[kLeft].fault_number);
    transport.inverters[kLeft].silent = true;
    run(10);
    ASSERT_FALSE(snapshot().drives[kLeft].online);
    ASSERT_EQ(number, snapshot().drives[kLeft].fault_number) << "the last one";
  }
};

TEST_F(FaultAfterLoss, IsToldNoLongerOnceItIsGone) {
  failAndVanish(21);
  transport.inverters[kLeft].switchOffAndOn();
  transport.inverters[kLeft].silent = false;
  transport.parameters[700] = 0;
  run(10);
  EXPECT_EQ(0, snapshot().drives[kLeft].fault_number);
  EXPECT_EQ(21, snapshot().drives[kLeft].last_fault_number);
  EXPECT_THAT(ask(RequestKind::kEnable).message.c_str(), HasSubstr("a fault was seen and has not been acknowledged"));
  ASSERT_TRUE(ask(RequestKind::kAcknowledge, kLeft).success);
  run(100);  // its parameters are read again
  const Completion enabled = ask(RequestKind::kEnable);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  for (int i = 0; i < 20; ++i) {
    commandBase(0.5);
    step();
  }
  ASSERT_GT(setpoint(kLeft), 0);
  const DriveSnapshot& drive = snapshot().drives[kLeft];
  EXPECT_EQ(0, drive.fault_number) << "while it drives";
  EXPECT_FALSE(drive.stopped);
  EXPECT_FALSE(snapshot().base.stopped);
}

TEST_F(FaultAfterLoss, IsReadAnewWhenOneStands) {
  failAndVanish(21);
  transport.inverters[kLeft].silent = false;
  transport.parameters[700] = 30;
  run(10);
  EXPECT_EQ(30, snapshot().drives[kLeft].fault_number);
  EXPECT_EQ(30, snapshot().drives[kLeft].last_fault_number);
}

}  // namespace
}  // namespace nord_driver::cycle
