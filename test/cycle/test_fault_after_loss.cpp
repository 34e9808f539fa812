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

// It is logged, traced and stamped as what it is.
TEST_F(FaultAfterLoss, AnotherOneIsCountedAsItsOwn) {
  failAndVanish(21);
  ASSERT_EQ(1u, snapshot().drives[kLeft].faults);
  const Instant back = transport.time;
  transport.inverters[kLeft].silent = false;
  transport.parameters[700] = 30;
  run(10);
  const DriveSnapshot& drive = snapshot().drives[kLeft];
  EXPECT_EQ(2u, drive.faults);
  EXPECT_GE(drive.at_fault.time, back);
  EXPECT_EQ(30, drive.at_fault.fault_number);
  ASSERT_FALSE(drive.fault_record.empty());
  EXPECT_EQ(drive.at_fault.time, drive.fault_record[drive.fault_record.size() - 1].time);
  run(10);
  EXPECT_EQ(2u, snapshot().drives[kLeft].faults) << "once";
}

TEST_F(FaultAfterLoss, TheSameOneIsNotCountedAgain) {
  failAndVanish(21);
  const Instant lost = transport.time;
  transport.hold_answers = true;
  transport.inverters[kLeft].silent = false;
  run(10);
  EXPECT_EQ(1u, snapshot().drives[kLeft].faults) << "its number is not known yet";
  transport.answerAll();
  run(200);
  ASSERT_EQ(21, snapshot().drives[kLeft].fault_number);
  EXPECT_EQ(1u, snapshot().drives[kLeft].faults);
  EXPECT_LT(snapshot().drives[kLeft].at_fault.time, lost);
}

// Which one it was when it was lost, nobody had been told.
TEST_F(FaultAfterLoss, OneThatWasNotKnownYetIsNotCountedAgain) {
  run(100);
  transport.hold_answers = true;
  transport.parameters[700] = 21;
  transport.inverters[kLeft].fault = true;
  run(10);
  transport.inverters[kLeft].silent = true;
  run(10);
  ASSERT_EQ(65535, snapshot().drives[kLeft].fault_number);
  transport.inverters[kLeft].silent = false;
  run(10);
  transport.answerAll();
  run(200);
  ASSERT_EQ(21, snapshot().drives[kLeft].fault_number);
  EXPECT_EQ(1u, snapshot().drives[kLeft].faults);
}

}  // namespace
}  // namespace nord_driver::cycle
