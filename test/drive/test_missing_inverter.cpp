// An inverter that is off behind a bus module that lives on its own supply: what the module is sent for it.
#include "drive/drive_fixture.h"

namespace nord_driver::drive {
namespace {

class MissingInverter : public DriveTest {
 protected:
  /// The module answers, and the inverter behind it does not.
  Word missing() {
    const profile::ProcessOutput output = drive_.pollOutput(now_);
    now_ += kCycle;
    drive_.handleModule(true, now_);
    drive_.handleInput({}, false, now_);
    setpoint_ = output.setpoints[0];
    return output.control_word;
  }
};

// 0000 for all inverters would let the module's P151 run out (BU 0220 4.2.3.2).
TEST_F(MissingInverter, GetsTheIdleWordWithTheSetItHad) {
  cycle(0x8B31);
  cycle(0x8B31);
  for (int i = 0; i < 500; ++i) ASSERT_EQ(0x847E, missing()) << i;
  EXPECT_FALSE(report().online);
  EXPECT_EQ(StopCause::kNone, report().stop_cause);
}

// First as any drive that fell silent while it was driven: it may hear us without being heard.
TEST_F(MissingInverter, IsStoppedFirstWhenItWasRunning) {
  run();
  while (report().online) ASSERT_EQ(0x047F, missing());
  for (int i = 0; i < 500; ++i) {
    ASSERT_EQ(0x047E, missing()) << i;
    ASSERT_EQ(0, setpoint_);
  }
  EXPECT_EQ(StopCause::kSilent, report().stop_cause);
}

TEST_F(MissingInverter, KeepsItsQuickStopForItsTime) {
  run();
  drive_.requestQuickStop(now_);
  while (report().online) missing();
  EXPECT_EQ(0x047B, missing());
  for (int i = 0; i < 200; ++i) missing();
  EXPECT_EQ(0x047E, missing());
}

// Nothing is known of it: 0000 is what tells its set without choosing one.
TEST_F(MissingInverter, ThatNeverAnsweredIsAskedForItsSet) {
  for (int i = 0; i < 500; ++i) ASSERT_EQ(0x0000, missing()) << i;
  EXPECT_EQ(0x0000, cycle(0x8B31));
  EXPECT_EQ(0x847E, cycle(0x8B31));
}

// The set it comes back with is the one that counts.
TEST_F(MissingInverter, SaysItsSetItselfWhenItIsBack) {
  start();
  for (int i = 0; i < 50; ++i) missing();
  EXPECT_EQ(0x047E, missing());
  cycle(0xCB31);
  EXPECT_EQ(0xC47E, cycle(0xCB31));
  EXPECT_EQ(Phase::kIdle, report().phase);
}

// A module that was gone itself finds its inverters within some cycles: one of them may be turning in another set.
TEST_F(MissingInverter, IsAskedForItsSetFirstWhenItsModuleWasGone) {
  start();
  fallSilent();
  for (int i = 0; i < 20; ++i) ASSERT_EQ(0x0000, silence()) << i;
  const Instant back = now_;
  Word word = missing();
  while (word == 0x0000) {
    ASSERT_LE(now_ - back, seconds(0.1));
    word = missing();
  }
  EXPECT_GE(now_ - back, seconds(0.05));
  EXPECT_EQ(0x047E, word);
}

// One exchange of the module is lost now and then: that is no new beginning.
TEST_F(MissingInverter, IsNotAskedAnewForALostCycle) {
  start();
  for (int i = 0; i < 20; ++i) missing();
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(0x047E, i % 5 == 0 ? silence() : missing()) << i;
  }
}

}  // namespace
}  // namespace nord_driver::drive
