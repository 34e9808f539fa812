// A write that nobody waits for any more: what it has done by then, and what of it is still done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drive/fake_parameters.h"
#include "drive/parameter_session.h"

namespace nord_driver::drive {
namespace {

using profile::ParameterAction;
using profile::ParameterRequest;
using ::testing::ElementsAre;
using Withdrawn = ParameterSession::Withdrawn;

class WithdrawnWrites : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kId = 7;

  void submit(ParameterAction action) {
    ParameterRequest request;
    request.id = kId;
    request.action = action;
    request.number = 102;
    request.raw = 5;
    ASSERT_TRUE(session_.submit(request));
  }
  /// Until `question` is under way; "": until nothing is asked any more.
  void runUntil(const std::string& question) {
    while (const auto request = session_.pollRequest()) {
      under_way_ = *request;
      if (FakeParameters::record(*request) == question) return;
      session_.handleResult(inverter_.carryOut(*request));
    }
    ASSERT_EQ("", question);
  }
  void finish() {
    session_.handleResult(inverter_.carryOut(under_way_));
    runUntil("");
  }

  ParameterSession session_;
  FakeParameters inverter_;
  ParameterRequest under_way_;
};

TEST_F(WithdrawnWrites, AnOrderThatSparesTheEepromHasWrittenNothingThere) {
  submit(ParameterAction::kWriteRam);
  runUntil("P102~5");
  EXPECT_EQ(Withdrawn::kRamOnly, session_.withdraw(kId));
  finish();
  EXPECT_EQ(0u, session_.eepromWrites());
}

TEST_F(WithdrawnWrites, NorHasOneThatIsReadBack) {
  submit(ParameterAction::kWriteRam);
  runUntil("P102~5");
  session_.handleResult(inverter_.carryOut(under_way_));
  runUntil("P102?");
  EXPECT_EQ(Withdrawn::kRamOnly, session_.withdraw(kId));
}

// Its asker was told that the EEPROM got nothing.
TEST_F(WithdrawnWrites, AnOrderForTheRamThatIsUnknownDoesNotGoOnThroughP560) {
  inverter_.ram_orders = false;
  submit(ParameterAction::kWriteRam);
  runUntil("P102~5");
  EXPECT_EQ(Withdrawn::kRamOnly, session_.withdraw(kId));
  finish();
  EXPECT_THAT(inverter_.asked, ElementsAre("P102?", "P102~5", "P560?"));
  EXPECT_EQ(0u, session_.eepromWrites());
  EXPECT_FALSE(session_.owesEepromSwitch());
}

TEST_F(WithdrawnWrites, WhileP560IsReadNothingHasBegun) {
  for (const bool ram : {true, false}) {
    for (const bool has_switch : {true, false}) {
      session_ = ParameterSession{};
      inverter_ = FakeParameters{};
      inverter_.ram_orders = false;
      if (!has_switch) inverter_.ram.erase(560);
      submit(ram ? ParameterAction::kWriteRam : ParameterAction::kWritePersistent);
      runUntil("P560?");
      EXPECT_EQ(Withdrawn::kNothing, session_.withdraw(kId));
      finish();
      EXPECT_EQ(200, inverter_.ram[102]) << ram << has_switch;
      EXPECT_EQ(0u, session_.eepromWrites());
    }
  }
}

TEST_F(WithdrawnWrites, ThroughP560ItMayHaveReachedTheEeprom) {
  for (const char* step : {"P560=0", "P102=5", "P560=1"}) {
    session_ = ParameterSession{};
    inverter_ = FakeParameters{};
    inverter_.ram_orders = false;
    submit(ParameterAction::kWriteRam);
    runUntil(step);
    EXPECT_EQ(Withdrawn::kMayBeSaved, session_.withdraw(kId)) << step;
    finish();
    EXPECT_EQ(5, inverter_.ram[102]) << step << ": what has begun is carried out";
    EXPECT_EQ(1, inverter_.ram[560]) << step;
  }
}

// An inverter that saves nothing, whoever writes.
TEST_F(WithdrawnWrites, WhileP560WasOffBeforeNothingIsSaved) {
  inverter_.ram_orders = false;
  inverter_.ram[560] = 0;
  submit(ParameterAction::kWriteRam);
  runUntil("P102=5");
  EXPECT_EQ(Withdrawn::kRamOnly, session_.withdraw(kId));
}

TEST_F(WithdrawnWrites, APersistentOneMayBeSaved) {
  submit(ParameterAction::kWritePersistent);
  runUntil("P102=5");
  EXPECT_EQ(Withdrawn::kMayBeSaved, session_.withdraw(kId));
  session_.handleResult(inverter_.carryOut(under_way_));
  runUntil("P102?");
  EXPECT_EQ(Withdrawn::kMayBeSaved, session_.withdraw(kId)) << "while it is read back";
}

TEST_F(WithdrawnWrites, WhatIsNotUnderWayHasDoneNothing) {
  submit(ParameterAction::kWritePersistent);
  EXPECT_EQ(Withdrawn::kNothing, session_.withdraw(kId + 1));
  EXPECT_EQ(Withdrawn::kNothing, session_.withdraw(kId));
  runUntil("");
  EXPECT_THAT(inverter_.asked, ElementsAre("P102?"));
}

}  // namespace
}  // namespace nord_driver::drive
