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
      "drive left: the inverter is under local control (status bit 9 = 0): does P509 select this bus, or is an input "
      "with \"remote "
      "control\" low? (status word 0B31, ready to switch on)",
      refusalMessage("left", drive::Refusal::kLocalControl, onlineReport()).c_str());
  EXPECT_STREQ("drive left: the inverter does not answer",
               refusalMessage("left", drive::Refusal::kOffline, drive::DriveReport{}).c_str());
}

TEST(Sentences, ARefusalForAFaultNamesTheService) {
  EXPECT_STREQ(
      "drive left: a fault was seen and has not been acknowledged; call ~acknowledge_faults (status word 0B31, ready "
      "to "
      "switch on)",
      refusalMessage("left", drive::Refusal::kFaultLatched, onlineReport()).c_str());
  EXPECT_STREQ(
      "drive left: the inverter reports a fault; when its cause is gone, call ~acknowledge_faults (status word 0B31, "
      "ready to switch on)",
      refusalMessage("left", drive::Refusal::kFault, onlineReport()).c_str());
}

TEST(Sentences, AStopTellsTheStatusWordOfThatMoment) {
  drive::DriveReport report = onlineReport();
  report.stop_status_word = 0x0238;
  EXPECT_STREQ("drive left stopped: a fault of the inverter (status word 0238, fault)",
               stopMessage("left", drive::StopCause::kFault, report).c_str());
  EXPECT_TRUE(stopMessage("left", drive::StopCause::kNone, report).empty());
}

// "A stop" alone sends its reader looking for somebody who has pressed a button.
TEST(Sentences, AnEnablingThatAStopEndedTellsWhatStoppedIt) {
  drive::DriveReport report = onlineReport();
  report.refusal = drive::Refusal::kStopped;
  EXPECT_STREQ("drive left: a stop came before the inverter was enabled (status word 0B31, ready to switch on)",
               refusalMessage("left", drive::Refusal::kStopped, report).c_str());
  report.stop_cause = drive::StopCause::kFault;
  report.stop_status_word = 0x0238;
  EXPECT_STREQ(
      "drive left: a stop came before the inverter was enabled: a fault of the inverter (status word 0238, fault)",
      refusalMessage("left", drive::Refusal::kStopped, report).c_str());
}

TEST(Sentences, ARefusalTellsTheInvertersOwnReason) {
  drive::DriveReport report = onlineReport();
  report.status_word = 0x0B70;
  report.state = profile::DriveState::kSwitchOnDisabled;
  report.switch_on_reason = 181;
  const std::string text = refusalMessage("left", drive::Refusal::kEnableTimeout, report).str();
  EXPECT_THAT(text, ::testing::HasSubstr("status word 0B70, switch-on disabled"));
  EXPECT_THAT(text, ::testing::HasSubstr("P700[-03], is 18.1)"));
  report.stop_status_word = 0x0B70;
  EXPECT_STREQ(
      "drive left stopped: a fault of the inverter (status word 0B70, switch-on disabled; the inverter's own reason, "
      "P700[-03], is 18.1)",
      stopMessage("left", drive::StopCause::kFault, report).c_str());
  report.online = false;
  EXPECT_STREQ("drive left stopped: a fault of the inverter (status word 0B70, switch-on disabled)",
               stopMessage("left", drive::StopCause::kFault, report).c_str())
      << "of one that is away it is an old one";
}

// Who leads is told by P509 (control word) or P510 (setpoint), and what is to be set either way.
TEST(Sentences, AnotherLeaderThanConfiguredIsRefusedWithItsParameter) {
  const auto refusal = [](const drive::UnexpectedSource& source) {
    drive::DriveReport report = onlineReport();
    report.unexpected_source = source;
    return refusalMessage("right", drive::Refusal::kUnexpectedSource, report).str();
  };
  EXPECT_EQ(
      "drive right follows another inverter: P509 is 3, broadcast, so that its control word does not come from this "
      "driver; set it to this bus, or name that drive: drives/right/follows",
      refusal({509, false, 3, false}));
  EXPECT_EQ(
      "drive right follows another inverter: P510[-01] is 8, broadcast, so that its setpoint does not come from this "
      "driver; set it to this bus, or name that drive: drives/right/follows",
      refusal({510, true, 8, false}));
  EXPECT_EQ(
      "drive right is to follow another inverter (drives/right/follows), and P510[-01] is 1, no broadcast: it would go "
      "by this bus; set it, or P509, to the broadcast",
      refusal({510, true, 1, true}));
  EXPECT_EQ(
      "drive right: P510[-01] is 1: its setpoint does not come from this bus, and enabled it would turn whatever this "
      "driver says; set it to 0 (as P509)",
      refusal({510, true, 1, false, true}));
  EXPECT_EQ(
      "drive right: P509 is 9: its setpoint does not come from this bus, and enabled it would turn whatever this "
      "driver "
      "says; set it to 10 or 14, control word and setpoint of this bus",
      refusal({509, false, 9, false, true}));
}

// What the sentence is about has been read anew meanwhile: nothing is told of what is not there.
TEST(Sentences, ARefusalWithoutItsValueIsTheReasonAlone) {
  using drive::Refusal;
  for (const Refusal refusal : {Refusal::kMinimumFrequency, Refusal::kUnexpectedFunction, Refusal::kUnexpectedSource}) {
    EXPECT_EQ(std::string{"drive left: "} + drive::toString(refusal) + " (status word 0B31, ready to switch on)",
              refusalMessage("left", refusal, onlineReport()).str());
  }
}

TEST(Sentences, AModeThatDoesNotPositionIsRefusedWithWhatToSet) {
  const auto refusal = [](std::uint16_t number, std::uint16_t found, std::uint16_t expected) {
    drive::DriveReport report = onlineReport();
    report.unexpected_function = drive::UnexpectedFunction{number, false, found, expected};
    return refusalMessage("lift", drive::Refusal::kUnexpectedFunction, report).str();
  };
  EXPECT_THAT(refusal(600, 0, 1), ::testing::StartsWith("drive lift: P600 is 0: with 0 it does not position"));
  EXPECT_THAT(refusal(600, 0xFFFF, 1), ::testing::StartsWith("drive lift: P600 could not be read: "));
  EXPECT_THAT(refusal(610, 1, 2),
              ::testing::StartsWith("drive lift: P610 is 1: its target comes from elsewhere; set P610 to 2, or "));
  EXPECT_THAT(refusal(610, 0xFFFF, 2), ::testing::StartsWith("drive lift: P610 could not be read: "));
}

TEST(Sentences, AModeThatPositionsIsRefusedWhereVelocitiesAreFollowed) {
  drive::DriveReport report = onlineReport();
  report.commanded_set = 2;
  report.unexpected_function = drive::UnexpectedFunction{600, false, 1, 0, 1, nullptr, true};
  EXPECT_STREQ(
      "drive left: P600 of parameter set 2 is 1: with position control on it follows no velocity, and mode is "
      "velocity; "
      "set P600 to 0",
      refusalMessage("left", drive::Refusal::kUnexpectedFunction, report).c_str());
}

// Of an array (P546 [-01] to [-03]: BU 0280 5.1.2) the element is named as well, of single parameters there is none.
TEST(Sentences, AMissingWordIsNamedWithItsElement) {
  drive::DriveReport report = onlineReport();
  report.commanded_set = 3;
  report.unexpected_function = drive::UnexpectedFunction{546, true, 0, 2, 2, "Torque current limit"};
  EXPECT_THAT(refusalMessage("left", drive::Refusal::kUnexpectedFunction, report).str(),
              ::testing::HasSubstr("set P546[-02] of drive left to 2 (Torque current limit) in parameter set 3: the "
                                   "configuration uses it, and no word carries it; P546[-02] is 0"));
  report.unexpected_function->is_array = false;
  report.unexpected_function->number = 547;
  report.unexpected_function->found = 0xFFFF;
  EXPECT_THAT(refusalMessage("left", drive::Refusal::kUnexpectedFunction, report).str(),
              ::testing::HasSubstr("set P547 of drive left to 2 (Torque current limit) in parameter set 3: the "
                                   "configuration uses it, and no word carries it; P547 could not be read"));
}

TEST(Sentences, AWordTooManyIsToBeSwitchedOff) {
  drive::DriveReport report = onlineReport();
  report.commanded_set = 1;
  report.unexpected_function = drive::UnexpectedFunction{548, false, 21, 0, 1, "off", true};
  EXPECT_THAT(refusalMessage("left", drive::Refusal::kUnexpectedFunction, report).str(),
              ::testing::HasSubstr("set P548 of drive left to 0 (off) in parameter set 1: what another word carries "
                                   "would mean something else beside it; P548 is 21"));
}

TEST(Sentences, AStateTellsWhatTheDriveSaidLast) {
  EXPECT_STREQ("drive left is ready to switch on, status word 0B31", stateMessage("left", onlineReport()).c_str());
  EXPECT_STREQ("drive left does not answer", stateMessage("left", drive::DriveReport{}).c_str());
}

profile::ParameterResult refused(std::uint16_t number, const char* text) {
  profile::ParameterResult result;
  result.outcome = profile::ParameterOutcome::kRefused;
  result.reason = profile::ParameterReason::kOther;
  result.refused_number = number;
  result.text = text;
  return result;
}

// P000 is a number like others.
TEST(Sentences, P000IsRefusedInWordsToo) {
  EXPECT_EQ("drive left refuses P000: PKW error 0, the inverter has no parameter of this number",
            parameterMessage("left", 0, refused(0, "PKW error 0, the inverter has no parameter of this number")).str());
}

std::string parameter(profile::ParameterOutcome outcome, const char* text = "") {
  profile::ParameterResult result = refused(5, text);
  result.outcome = outcome;
  result.reason = outcome == profile::ParameterOutcome::kRefused ? profile::ParameterReason::kReadOnly
                                                                 : profile::ParameterReason::kNone;
  return parameterMessage("left", 5, result).str();
}

TEST(Sentences, AParameterThatCouldNotBeReadSaysWhy) {
  using Outcome = profile::ParameterOutcome;
  EXPECT_EQ("", parameter(Outcome::kDone));
  EXPECT_EQ("drive left refuses P005: Modbus exception 2, illegal address",
            parameter(Outcome::kRefused, "Modbus exception 2, illegal address"));
  EXPECT_EQ("drive left gave no answer for P005", parameter(Outcome::kTimeout));
  EXPECT_EQ("drive left does not answer", parameter(Outcome::kOffline));
  EXPECT_EQ("no parameter channel reaches P005 of drive left: PPO types 3 and 4 carry process data only",
            parameter(Outcome::kNoChannel, "PPO types 3 and 4 carry process data only"));
  EXPECT_EQ("drive left has too many parameter requests waiting already", parameter(Outcome::kBusy));
}

// The plugin of somebody else need not have words for it.
TEST(Sentences, AReasonWithoutWordsOfTheTransportHasItsOwn) {
  EXPECT_EQ("drive left refuses P005: the parameter is read-only", parameter(profile::ParameterOutcome::kRefused));
  EXPECT_EQ("no parameter channel reaches P005 of drive left", parameter(profile::ParameterOutcome::kNoChannel));
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
  report.unexpected_function = drive::UnexpectedFunction{543, false, 5, 1};
  EXPECT_STREQ("drive left: P543 of parameter set 4 is 5, so that actual value 1 is not the frequency; set it to 1",
               refusalMessage("left", drive::Refusal::kUnexpectedFunction, report).c_str());
}

// BU 0020 6.2.2: parameters are written over a bus only while P509 selects it.
TEST(Sentences, ARefusedWriteNamesP509) {
  const profile::ParameterResult result = refused(102, "PKW error 2, the value is beyond the lower or upper limit");
  EXPECT_THAT(parameterMessage("left", 102, result).str(), ::testing::Not(::testing::HasSubstr("P509")));
  EXPECT_THAT(parameterMessage("left", 102, result, true).str(),
              ::testing::HasSubstr("the bus has no control (status bit 9 = 0): does P509 select it?"));
}

TEST(Sentences, WhatTheSessionAddsIsPassedOn) {
  profile::ParameterResult result;
  result.outcome = profile::ParameterOutcome::kDone;
  result.note = "nothing was written, the value was there already";
  EXPECT_EQ("nothing was written, the value was there already", parameterMessage("left", 5, result).str());
  result.outcome = profile::ParameterOutcome::kRefused;
  result.reason = profile::ParameterReason::kDriver;
  EXPECT_EQ("P005 of drive left: nothing was written, the value was there already",
            parameterMessage("left", 5, result).str());
  result = refused(560, "PKW error 1, it is read-only");  // about P560, not about the parameter asked for
  result.note = "P560 could not be set to 0, so the value was not written";
  EXPECT_EQ(
      "drive left refuses P560: PKW error 1, it is read-only; P560 could not be set to 0, so the value was not written",
      parameterMessage("left", 5, result).str());
}

}  // namespace
}  // namespace nord_driver::cycle
