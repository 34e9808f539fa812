// Why an inverter does not become ready to switch on: read of one that is held there, and told as long as it is.
#include <gtest/gtest.h>

#include "cycle/parameters_bench.h"

namespace nord_driver::cycle {
namespace {

constexpr Word kSwitchOnDisabled = 0x0B70, kReady = 0x0B31;

class SwitchOnReason : public ::testing::Test, protected ParametersBench {
 protected:
  SwitchOnReason() {
    values[700] = 34;  // 3.4
    says = kReady;
    run(80);
    asked.clear();
  }
  auto reason() const { return drive.report().switch_on_reason; }
};

// On its way up it is in that state for some cycles: there is nothing to tell of yet.
TEST_F(SwitchOnReason, IsReadAfterHalfASecond) {
  says = kSwitchOnDisabled;
  run(48);
  EXPECT_EQ(0, reads(700));
  run(5);
  ASSERT_EQ(1, reads(700));
  EXPECT_EQ(3, asked[0].index);
  EXPECT_EQ(34, reason());
}

TEST_F(SwitchOnReason, IsReadAgainEachHalfSecond) {
  says = kSwitchOnDisabled;
  run(55);
  values[700] = 52;
  run(50);
  EXPECT_EQ(2, reads(700));
  EXPECT_EQ(52, reason());
  run(100);
  EXPECT_EQ(4, reads(700));
}

TEST_F(SwitchOnReason, StandsWhileItIsReadAgain) {
  says = kSwitchOnDisabled;
  run(55);
  held = {700};
  for (int i = 0; i < 60; ++i) {
    step();
    ASSERT_EQ(34, reason());
  }
  EXPECT_EQ(1u, open.size());
}

TEST_F(SwitchOnReason, EndsWhenTheDriveBecomesReady) {
  says = kSwitchOnDisabled;
  run(55);
  held = {700};  // it is being read
  run(50);
  says = kReady;
  step();
  EXPECT_FALSE(reason());
  held.clear();
  run(100);
  EXPECT_FALSE(reason());
}

// The half second is one without a break.
TEST_F(SwitchOnReason, IsNotReadOfADriveThatWasReadyMeanwhile) {
  for (int i = 0; i < 5; ++i) {
    says = kSwitchOnDisabled;
    run(30);
    says = kReady;
    run(1);
  }
  EXPECT_EQ(0, reads(700));
}

TEST_F(SwitchOnReason, IsReadOfADriveThatIsBeingEnabled) {
  says = kSwitchOnDisabled;
  step();
  drive.requestEnable(now);
  for (int i = 0; i < 55; ++i) {
    step();
    ASSERT_EQ(drive::Phase::kEnabling, drive.report().phase);
  }
  EXPECT_EQ(34, reason());
}

// The next one has a reason of its own, which is read half a second later, or cannot be read.
TEST_F(SwitchOnReason, OfTheLastHoldIsNotToldOfTheNext) {
  for (const bool lost : {false, true}) {
    SCOPED_TRACE(lost);
    says = kSwitchOnDisabled;
    run(60);
    ASSERT_EQ(34, reason());
    inverter.silent = lost;
    says = kReady;
    run(100);
    EXPECT_FALSE(reason());
    inverter.silent = false;
    says = kSwitchOnDisabled;
    silent = {700};
    for (int i = 0; i < 300; ++i) {
      step();
      ASSERT_FALSE(reason());
    }
    silent.clear();
    run(110);
    EXPECT_EQ(34, reason());
  }
}

TEST_F(SwitchOnReason, IsReadThoughItWasRefusedForTheMoment) {
  says = kSwitchOnDisabled;
  not_now = {700};
  run(60);
  ASSERT_GE(reads(700), 1);
  EXPECT_FALSE(reason());
  not_now.clear();
  run(110);
  EXPECT_EQ(34, reason());
}

// 0: the inverter gives none.
TEST_F(SwitchOnReason, IsNoneWhereTheInverterGivesNone) {
  values[700] = 0;
  says = kSwitchOnDisabled;
  run(60);
  EXPECT_EQ(1, reads(700));
  EXPECT_FALSE(reason());
  values[700] = 1;
  run(60);
  EXPECT_EQ(1, reason());
}

}  // namespace
}  // namespace nord_driver::cycle
