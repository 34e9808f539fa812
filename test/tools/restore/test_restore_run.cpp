// A restore that is written, refused, broken off anywhere, gone on with and taken back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/restore/restore_run.h"
#include "tools/restore/scripted_drive.h"

namespace nord_driver::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Values = std::map<std::string, std::int32_t>;

const Values kHave{{"P102 set 1", 200}, {"P103 set 1", 200}, {"P105 set 1", 500}, {"P513", 0}, {"P560", 1}};
const Values kWant{{"P102 set 1", 250}, {"P103 set 1", 300}, {"P105 set 1", 600}, {"P513", 0}};

class RestoreRunTest : public ::testing::Test {
 protected:
  void plan(const Values& want, bool persistent = false) {
    RestoreOptions options;
    options.persistent = persistent;
    options.bus_settings = BusSettings::kAll;
    record_ = recordOf(planRestore(drive_, dumpOf(want), options, asked_), drive_, "/a/left.yaml", persistent);
  }
  RestoreRun run() {
    return {drive_, record_, [this](const RestoreRecord& record) { kept_ = recordText(record); }, asked_};
  }
  /// The program is gone: what is known is what is on the disk.
  void forget() { record_ = recordFrom(kept_, "kept"); }
  std::string trouble(const std::function<void()>& task) {
    try {
      task();
    } catch (const Trouble& error) {
      return error.what();
    }
    return "";
  }
  Values valuesWith(const Values& changed) const {
    Values values = kHave;
    for (const auto& [name, raw] : changed) values[name] = raw;
    return values;
  }

  ScriptedDrive drive_{kHave};
  RestoreRecord record_;
  std::string kept_;
  std::atomic<bool> asked_{false};
};

TEST_F(RestoreRunTest, WritesInOrderAndVerifies) {
  plan(kWant);
  RestoreRun restore = run();
  EXPECT_EQ(RestoreEnd::kVerified, restore.write());
  EXPECT_THAT(drive_.written, ElementsAre("P102 set 1 ~ 250", "P103 set 1 ~ 300", "P105 set 1 ~ 600"));
  EXPECT_EQ(valuesWith(kWant), drive_.values);
  EXPECT_THAT(restore.notes(), IsEmpty());
  forget();
  EXPECT_EQ(RestoreState::kVerified, record_.state);
  EXPECT_FALSE(record_.isUnfinished());
}

TEST_F(RestoreRunTest, SavesWhenItWasSaid) {
  plan(kWant, true);
  EXPECT_EQ(RestoreEnd::kVerified, run().write());
  EXPECT_THAT(drive_.written, ElementsAre("P102 set 1 = 250", "P103 set 1 = 300", "P105 set 1 = 600"));
}

// Before each write the disk knows of it: whatever ends the program.
TEST_F(RestoreRunTest, IsNotedBeforeEachWrite) {
  plan(kWant);
  int looked = 0;
  drive_.before_write = [&](const std::string& name) {
    const RestoreRecord noted = recordFrom(kept_, "kept");
    for (const RestoreRecord::Change& change : noted.changes) {
      if (parameterName(change.address) != name) continue;
      EXPECT_EQ(ChangeState::kBegun, change.state) << name;
      EXPECT_EQ(drive_.values[name], change.before);
      ++looked;
    }
  };
  EXPECT_EQ(RestoreEnd::kVerified, run().write());
  EXPECT_EQ(3, looked);
}

TEST_F(RestoreRunTest, WritesNothingThatCannotBeNoted) {
  plan(kWant);
  RestoreRun restore{drive_, record_, [](const RestoreRecord&) { throw Trouble("the disk is full"); }, asked_};
  EXPECT_THROW(restore.write(), Trouble);
  EXPECT_THAT(drive_.written, IsEmpty());
}

TEST_F(RestoreRunTest, TakesBackWhatWasWrittenWhenOneIsRefused) {
  plan(kWant);
  drive_.refused = {"P105 set 1"};
  RestoreRun restore = run();
  EXPECT_EQ(RestoreEnd::kTakenBack, restore.write());
  EXPECT_EQ(kHave, drive_.values);
  EXPECT_THAT(drive_.written,
              ElementsAre("P102 set 1 ~ 250", "P103 set 1 ~ 300", "P103 set 1 ~ 200", "P102 set 1 ~ 200"))
      << "the last one first";
  EXPECT_EQ("P105 set 1 Maximum frequency: drive left refuses it: PKW error 2", record_.why);
  forget();
  EXPECT_EQ(RestoreState::kTakenBack, record_.state);
}

// Taking back would be refused as well.
TEST_F(RestoreRunTest, BreaksOffWhereTheBudgetOfTheEepromIsUsedUp) {
  plan(kWant, true);
  drive_.used_up_at = "P103 set 1";
  EXPECT_THAT(trouble([&] { run().write(); }), HasSubstr("the budget is used up; 1 of 3 are written: "));
  EXPECT_EQ(250, drive_.values["P102 set 1"]);
  drive_.used_up_at.clear();
  forget();
  RestoreRun restore = run();
  restore.lookAgain();
  EXPECT_EQ(RestoreEnd::kVerified, restore.write());
}

TEST_F(RestoreRunTest, SaysWhatCannotBeTakenBack) {
  plan(kWant);
  RestoreRun restore = run();
  ASSERT_EQ(RestoreEnd::kVerified, restore.write());
  drive_.refused = {"P102 set 1"};
  EXPECT_EQ(RestoreEnd::kTakenBackInPart, restore.takeBack());
  EXPECT_THAT(restore.notes(), ElementsAre("P102 set 1 Acceleration time cannot be put back to 2.00 s: drive left "
                                           "refuses it: PKW error 2"));
  drive_.refused.clear();
  forget();
  EXPECT_EQ(RestoreEnd::kTakenBack, run().takeBack());
  EXPECT_EQ(kHave, drive_.values);
}

// Of somebody else, at the keypad: it is his.
TEST_F(RestoreRunTest, LeavesAloneWhatSomebodyElseHasChanged) {
  plan(kWant);
  RestoreRun restore = run();
  ASSERT_EQ(RestoreEnd::kVerified, restore.write());
  drive_.values["P103 set 1"] = 999;
  EXPECT_EQ(RestoreEnd::kTakenBackInPart, restore.takeBack());
  EXPECT_EQ(valuesWith({{"P103 set 1", 999}}), drive_.values);
  EXPECT_THAT(restore.notes(),
              ElementsAre("P103 set 1 Deceleration time is 9.99 s, which this restore has not written: "
                          "it is left as it is"));
  forget();
  EXPECT_FALSE(record_.isUnfinished()) << "there is nothing to try again";
}

// Wherever the line breaks, also between a write and its answer: the run after it goes on, or takes back.
TEST_F(RestoreRunTest, GoesOnAndTakesBackAfterABreakAnywhere) {
  int broken = 0;
  for (const bool carried_out : {false, true}) {
    for (const bool take_back : {false, true}) {
      for (int accesses = 0; accesses < 9; ++accesses) {
        SCOPED_TRACE(std::to_string(accesses) + (carried_out ? ", the last one carried out" : ""));
        drive_ = ScriptedDrive{kHave};
        plan(kWant);
        kept_ = recordText(record_);
        drive_.accesses_left = accesses;
        drive_.silent_after_carrying_out = carried_out;
        const std::string why = trouble([&] { run().write(); });
        drive_.accesses_left = -1;
        if (!why.empty()) {
          ++broken;
          EXPECT_THAT(why, HasSubstr(" of 3 are written: nord_param restore left --resume goes on, --take-back"));
        }
        forget();
        RestoreRun restore = run();
        if (take_back) {
          EXPECT_EQ(RestoreEnd::kTakenBack, restore.takeBack());
          EXPECT_EQ(kHave, drive_.values);
        } else {
          restore.lookAgain();
          EXPECT_EQ(RestoreEnd::kVerified, restore.write());
          EXPECT_EQ(valuesWith(kWant), drive_.values);
        }
        EXPECT_THAT(restore.notes(), IsEmpty());
      }
    }
  }
  EXPECT_EQ(32, broken) << "all but the ones after the last access";
}

TEST_F(RestoreRunTest, GoesOnTakingBackAfterABreak) {
  plan(kWant);
  ASSERT_EQ(RestoreEnd::kVerified, run().write());
  drive_.accesses_left = 3;
  EXPECT_THAT(trouble([&] { run().takeBack(); }), HasSubstr("--take-back goes on with that"));
  forget();
  EXPECT_EQ(RestoreState::kTakingBack, record_.state);
  drive_.accesses_left = -1;
  EXPECT_EQ(RestoreEnd::kTakenBack, run().takeBack());
  EXPECT_EQ(kHave, drive_.values);
}

TEST_F(RestoreRunTest, EndsBetweenTwoAccessesWhenAsked) {
  plan(kWant);
  drive_.before_write = [&](const std::string&) { asked_ = true; };
  EXPECT_THAT(trouble([&] { run().write(); }), HasSubstr("ended; 1 of 3 are written"));
  EXPECT_THAT(drive_.written, ElementsAre("P102 set 1 ~ 250")) << "what is under way is not cut off";
}

// Through the node others enable and drive it meanwhile: what is left waits for rest, and nothing is taken back before it.
TEST_F(RestoreRunTest, WritesNothingIntoADriveThatWasEnabledMeanwhile) {
  plan(kWant);
  drive_.before_write = [&](const std::string&) { drive_.moving = "drive left is enabled"; };
  EXPECT_THAT(trouble([&] { run().write(); }), HasSubstr("drive left is enabled; 1 of 3 are written"));
  EXPECT_THAT(drive_.written, ElementsAre("P102 set 1 ~ 250"));
  forget();
  EXPECT_EQ(RestoreState::kWriting, record_.state);
  EXPECT_THAT(trouble([&] { run().takeBack(); }), HasSubstr("drive left is enabled; it is not taken back as a whole"));
  EXPECT_THAT(drive_.written, ElementsAre("P102 set 1 ~ 250"));
  drive_.moving.clear();
  drive_.before_write = nullptr;
  forget();
  EXPECT_EQ(RestoreEnd::kTakenBack, run().takeBack());
  EXPECT_EQ(kHave, drive_.values);
}

// Another bus participant asks the drive, too (PKW error 103): that says nothing of the parameter.
TEST_F(RestoreRunTest, AsksAgainWhatIsRefusedForTheMoment) {
  drive_.blocked["P103 set 1"] = 1;
  plan(kWant);
  EXPECT_EQ(3u, record_.changes.size());
  drive_.blocked["P103 set 1"] = 2;
  EXPECT_EQ(RestoreEnd::kVerified, run().write());
  EXPECT_THAT(drive_.written, ElementsAre("P102 set 1 ~ 250", "P103 set 1 ~ 300", "P105 set 1 ~ 600"));
}

// Taking back would meet the same, and it may be over in a minute: the journal says where it stands.
TEST_F(RestoreRunTest, BreaksOffWhatGoesOnBeingRefusedForTheMoment) {
  drive_.blocked["P103 set 1"] = -1;
  EXPECT_EQ("drive left refuses P103 set 1: PKW error 103; nothing was written", trouble([&] { plan(kWant); }));
  drive_.blocked.clear();
  plan(kWant);
  drive_.blocked["P103 set 1"] = -1;
  EXPECT_THAT(trouble([&] { run().write(); }), HasSubstr("P103 set 1: PKW error 103; 1 of 3 are written"));
  EXPECT_THAT(drive_.written, ElementsAre("P102 set 1 ~ 250"));
  drive_.blocked.clear();
  forget();
  EXPECT_EQ(RestoreState::kWriting, record_.state);
  RestoreRun again = run();
  again.lookAgain();
  EXPECT_EQ(RestoreEnd::kVerified, again.write());
  EXPECT_EQ(valuesWith(kWant), drive_.values);
}

// Mains off and on in the middle: the RAM is lost, the drive answers, and only the end can tell.
TEST_F(RestoreRunTest, NoticesADriveThatWasSwitchedOff) {
  plan(kWant);
  drive_.before_write = [&](const std::string& name) {
    if (name == "P105 set 1") drive_.values = kHave;
  };
  RestoreRun restore = run();
  EXPECT_EQ(RestoreEnd::kDiffers, restore.write());
  EXPECT_THAT(restore.notes(),
              ElementsAre("P102 set 1 Acceleration time was written as 2.50 s and is 2.00 s as before: was the drive "
                          "switched off?",
                          "P103 set 1 Deceleration time was written as 3.00 s and is 2.00 s as before: was the drive "
                          "switched off?"));
  drive_.before_write = nullptr;
  forget();
  EXPECT_TRUE(record_.isUnfinished());
  RestoreRun again = run();
  again.lookAgain();
  EXPECT_EQ(RestoreEnd::kVerified, again.write());
  EXPECT_EQ(valuesWith(kWant), drive_.values);
}

TEST_F(RestoreRunTest, SaysWhatWasLostBetweenTwoRuns) {
  plan(kWant);
  drive_.accesses_left = 2;
  EXPECT_NE("", trouble([&] { run().write(); }));
  drive_ = ScriptedDrive{kHave};
  forget();
  RestoreRun restore = run();
  restore.lookAgain();
  EXPECT_THAT(restore.notes(), ElementsAre("P102 set 1 Acceleration time was written and is 2.00 s again: what is in "
                                           "RAM only is lost when the drive is switched off"));
}

// One parameter may move another one: what had its value before is verified, too.
TEST_F(RestoreRunTest, VerifiesWhatItHasNotWritten) {
  plan(kWant);
  drive_.before_write = [&](const std::string& name) {
    if (name == "P105 set 1") drive_.values["P513"] = 30;
  };
  RestoreRun restore = run();
  EXPECT_EQ(RestoreEnd::kDiffers, restore.write());
  EXPECT_THAT(restore.notes(), ElementsAre("P513 Telegram timeout was 0.0 s Off and is 3.0 s now"));
  drive_.before_write = nullptr;
  forget();
  RestoreRun again = run();
  again.lookAgain();
  EXPECT_EQ(RestoreEnd::kVerified, again.write());
  EXPECT_EQ(0, drive_.values["P513"]);
}

// It had another value before the restore: what it was moved to is nothing to be put back, and the end says so.
TEST_F(RestoreRunTest, NamesWhatWasMovedAndIsNotTakenBack) {
  plan(kWant);
  drive_.before_write = [&](const std::string& name) {
    if (name == "P105 set 1") drive_.values["P513"] = 30;
    if (name == "P103 set 1") drive_.values["P102 set 1"] = 240;
  };
  EXPECT_EQ(RestoreEnd::kDiffers, run().write());
  drive_.before_write = nullptr;
  forget();
  RestoreRun back = run();
  EXPECT_EQ(RestoreEnd::kTakenBackInPart, back.takeBack());
  EXPECT_EQ(valuesWith({{"P102 set 1", 240}, {"P513", 30}}), drive_.values);
  EXPECT_THAT(
      back.notes(),
      ElementsAre("P513 Telegram timeout is 3.0 s, which this restore has not written: it is left as it is",
                  "P102 set 1 Acceleration time is 2.40 s, which this restore has not written: it is left as it "
                  "is"));
}

TEST_F(RestoreRunTest, TakesBackToWhatWasThereBeforeItWasMoved) {
  plan(kWant);
  drive_.before_write = [&](const std::string& name) {
    if (name == "P105 set 1") drive_.values["P513"] = 30;
  };
  EXPECT_EQ(RestoreEnd::kDiffers, run().write());
  drive_.before_write = nullptr;
  RestoreRun again = run();
  again.lookAgain();
  EXPECT_EQ(RestoreEnd::kVerified, again.write());
  EXPECT_EQ(RestoreEnd::kTakenBack, again.takeBack());
  EXPECT_EQ(kHave, drive_.values);
}

// Killed before the order left: its value tells nothing.
TEST_F(RestoreRunTest, SavesASameValueAfterABreak) {
  RestoreOptions options;
  options.persistent = options.save_same = true;
  record_ = recordOf(planRestore(drive_, dumpOf({{"P102 set 1", 200}}), options, asked_), drive_, "/a/left.yaml", true);
  drive_.accesses_left = 1;
  EXPECT_NE("", trouble([&] { run().write(); }));
  EXPECT_THAT(drive_.written, IsEmpty());
  drive_.accesses_left = -1;
  forget();
  RestoreRun restore = run();
  restore.lookAgain();
  EXPECT_EQ(RestoreEnd::kVerified, restore.write());
  EXPECT_THAT(drive_.written, ElementsAre("P102 set 1 = 200"));
}

// From the first of them on it may answer elsewhere: before that everything else is verified.
TEST_F(RestoreRunTest, VerifiesBeforeWhatTheBusReachesItBy) {
  drive_.values["P508"] = 3;
  Values want = kWant;
  want["P508"] = 4;
  plan(want);
  drive_.before_write = [&](const std::string& name) {
    if (name == "P105 set 1") drive_.values["P102 set 1"] = 200;
  };
  EXPECT_EQ(RestoreEnd::kDiffers, run().write());
  EXPECT_EQ(3, drive_.values["P508"]) << "not written";
}

// A run that was killed between two steps of a RAM write: nothing would ever be saved any more.
TEST_F(RestoreRunTest, PutsBackP560ThatTheRunBeforeLeftAtZero) {
  plan(kWant);
  drive_.accesses_left = 3;
  EXPECT_NE("", trouble([&] { run().write(); }));
  drive_.accesses_left = -1;
  drive_.values["P560"] = 0;
  forget();
  RestoreRun restore = run();
  restore.lookAgain();
  EXPECT_EQ(1, drive_.values["P560"]);
  EXPECT_THAT(restore.notes(), ElementsAre("P560 was left at 0 by the run before, and is 1 again"));
}

}  // namespace
}  // namespace nord_driver::tools
