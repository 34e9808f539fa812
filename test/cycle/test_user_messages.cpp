// What the cycle says to people: who, what, and what was last seen, with the status word as on the wire.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/user_messages.h"

namespace nord_driver::cycle {
namespace {

drive::DriveReport onlineReport() {
  drive::DriveReport report;
  report.online = true;
  report.status_word = 0x0B31;
  report.state = profile::DriveState::kReadyToSwitchOn;
  return report;
}

TEST(Sentences, ARefusalNamesDriveReasonAndStatusWord) {
  EXPECT_STREQ(
      "drive left: the inverter is under local control (status bit 9 = 0) (status word 0B31, ready to switch on)",
      refusalMessage("left", drive::Refusal::kLocalControl, onlineReport()).c_str());
  EXPECT_STREQ("drive left: the inverter does not answer",
               refusalMessage("left", drive::Refusal::kOffline, drive::DriveReport{}).c_str());
}

TEST(Sentences, AStopTellsTheStatusWordOfThatMoment) {
  drive::DriveReport report = onlineReport();
  report.stop_status_word = 0x0238;
  EXPECT_STREQ("drive left stopped: a fault of the inverter (status word 0238, fault)",
               stopMessage("left", drive::StopCause::kFault, report).c_str());
  EXPECT_TRUE(stopMessage("left", drive::StopCause::kNone, report).empty());
}

TEST(Sentences, ARefusalTellsTheInvertersOwnReason) {
  drive::DriveReport report = onlineReport();
  report.status_word = 0x0B70;
  report.state = profile::DriveState::kSwitchOnDisabled;
  report.switch_on_reason = 181;
  const std::string text = refusalMessage("left", drive::Refusal::kEnableTimeout, report).str();
  EXPECT_THAT(text, ::testing::HasSubstr("status word 0B70, switch-on disabled"));
  EXPECT_THAT(text, ::testing::HasSubstr("P700[-03], is 18.1"));
}

TEST(Sentences, AStateTellsWhatTheDriveSaidLast) {
  EXPECT_STREQ("drive left is ready to switch on, status word 0B31", stateMessage("left", onlineReport()).c_str());
  EXPECT_STREQ("drive left does not answer", stateMessage("left", drive::DriveReport{}).c_str());
}

// 0 as the refused number stands for "not the inverter refused"; P000 is a number like others.
TEST(Sentences, P000IsRefusedInWordsToo) {
  drive::ParameterTaskResult result;
  result.outcome = profile::ParameterOutcome::kRefused;
  EXPECT_EQ("drive left refuses P000: error 0, the inverter has no parameter of this number",
            parameterMessage("left", 0, result).str());
}

std::string parameter(profile::ParameterOutcome outcome) {
  drive::ParameterTaskResult result;
  result.outcome = outcome;
  result.error_number = 201;
  result.refused_number = 5;
  return parameterMessage("left", 5, result).str();
}

TEST(Sentences, AParameterThatCouldNotBeReadSaysWhy) {
  using Outcome = profile::ParameterOutcome;
  EXPECT_EQ("", parameter(Outcome::kDone));
  EXPECT_EQ(0u, parameter(Outcome::kRefused).find("drive left refuses P005: error 201, "));
  EXPECT_EQ("drive left gave no answer for P005", parameter(Outcome::kTimeout));
  EXPECT_EQ("drive left does not answer", parameter(Outcome::kOffline));
  EXPECT_EQ(
      "drive left has no parameter channel: PPO types 3 and 4 carry process data only, and its bus module takes no "
      "acyclic requests (DP-V1)",
      parameter(Outcome::kNoChannel));
  EXPECT_EQ(0u,
            parameter(Outcome::kNotActivated).find("the bus module of drive left refuses acyclic requests (DP-V1): "));
  EXPECT_EQ("drive left has too many parameter requests waiting already", parameter(Outcome::kBusy));
}

TEST(Sentences, AMinimumFrequencyIsRefusedWithWhatToSet) {
  drive::DriveReport report = onlineReport();
  report.commanded_set = 2;
  report.minimum_frequency = Hertz{2.5};
  EXPECT_STREQ(
      "drive left: P104 of parameter set 2 is 2.5 Hz: enabled, the motor would turn at that with setpoint 0; set P104 "
      "to "
      "0, or allow_minimum_frequency: true",
      refusalMessage("left", drive::Refusal::kMinimumFrequency, report).c_str());
}

TEST(Sentences, AFunctionIsRefusedWithWhatToSet) {
  drive::DriveReport report = onlineReport();
  report.commanded_set = 4;
  report.unexpected_function = drive::UnexpectedFunction{546, true, 5, 1};
  EXPECT_STREQ("drive left: P546 [-01] of parameter set 4 is 5, so that setpoint 1 is not the frequency; set it to 1",
               refusalMessage("left", drive::Refusal::kUnexpectedFunction, report).c_str());
}

// BU 0020 6.2.2: parameters are written over a bus only while P509 selects it.
TEST(Sentences, ARefusedWriteNamesP509) {
  drive::ParameterTaskResult result;
  result.outcome = profile::ParameterOutcome::kRefused;
  result.refused_number = 102;
  result.error_number = 1;
  EXPECT_EQ(
      "drive left refuses P102: error 1, the parameter cannot be changed (it is read-only, or P509 does not select "
      "this bus)",
      parameterMessage("left", 102, result).str());
  result.error_number = 202;
  EXPECT_THAT(parameterMessage("left", 102, result).str(), ::testing::Not(::testing::HasSubstr("P509")));
  EXPECT_THAT(parameterMessage("left", 102, result, true).str(),
              ::testing::HasSubstr("the bus has no control (status bit 9 = 0): does P509 select it?"));
}

TEST(Sentences, WhatTheSessionAddsIsPassedOn) {
  drive::ParameterTaskResult result;
  result.outcome = profile::ParameterOutcome::kDone;
  result.note = "nothing was written, the value was there already";
  EXPECT_EQ("nothing was written, the value was there already", parameterMessage("left", 5, result).str());
  result.outcome = profile::ParameterOutcome::kRefused;
  EXPECT_EQ("P005 of drive left: nothing was written, the value was there already",
            parameterMessage("left", 5, result).str());
  result.refused_number = 560;  // the error is about P560, not about the parameter asked for
  result.error_number = 1;
  EXPECT_EQ(0u, parameterMessage("left", 5, result).str().find("drive left refuses P560: error 1, "));
  // On CANopen by the code that is in its books.
  result.abort_code = 0x06010002;
  EXPECT_EQ(0u, parameterMessage("left", 5, result).str().find("drive left refuses P560: SDO abort 06010002, "));
}

}  // namespace
}  // namespace nord_driver::cycle
