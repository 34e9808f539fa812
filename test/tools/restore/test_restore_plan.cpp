// What a restore would write, in which order, and what it does not write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/restore/restore_plan.h"
#include "tools/restore/scripted_drive.h"

namespace nord_driver::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::atomic<bool> kNotAsked{false};

std::vector<std::string> written(const RestorePlan& plan) {
  std::vector<std::string> names;
  for (const RestoreChange& change : plan.changes) names.push_back(parameterName(change.address));
  return names;
}

RestorePlan planned(ScriptedDrive& drive, const std::map<std::string, std::int32_t>& dump,
                    const RestoreOptions& options = {}) {
  return planRestore(drive, dumpOf(dump), options, kNotAsked);
}

RestoreOptions with(BusSettings bus_settings) {
  RestoreOptions options;
  options.bus_settings = bus_settings;
  return options;
}

TEST(RestorePlan, HasWhatDiffersOnly) {
  ScriptedDrive drive{{{"P102 set 1", 200}, {"P102 set 2", 200}}};
  const RestorePlan plan = planned(drive, {{"P102 set 1", 250}, {"P102 set 2", 200}});
  EXPECT_THAT(written(plan), ElementsAre("P102 set 1"));
  EXPECT_EQ(200, plan.changes[0].before);
  EXPECT_EQ(250, plan.changes[0].after);
  EXPECT_EQ(1u, plan.same.size());
  EXPECT_EQ(
      "  P102 set 1 Acceleration time  2.00 s  ->  2.50 s\n"
      "1 to be written, in RAM: lost at power off; 1 have their value already, 0 left out\n",
      planText(plan, drive.known(), false));
  EXPECT_THAT(drive.written, IsEmpty());
}

// A restore that was begun and may not go on would leave the drive with half of it.
TEST(RestorePlan, LeavesOutWhatMayNotBeWritten) {
  ScriptedDrive drive{{{"P102 set 1", 200}, {"P103 set 1", 200}}};
  drive.forbidden = 103;
  const RestorePlan plan = planned(drive, {{"P102 set 1", 250}, {"P103 set 1", 250}});
  EXPECT_THAT(written(plan), ElementsAre("P102 set 1"));
  ASSERT_EQ(1u, plan.left_out.size());
  EXPECT_EQ("forbidden", plan.left_out[0].why);
}

// As a bus transfers it that knows no sign.
TEST(RestorePlan, WritesANegativeValueThatWasReadWithoutItsSign) {
  ScriptedDrive drive{{{"P513", 0}}};
  const RestorePlan plan = planned(drive, {{"P513", 65'535}});
  EXPECT_THAT(written(plan), ElementsAre("P513"));
}

// A restore in RAM that came to it would be refused there, and taken back as a whole.
TEST(RestorePlan, LeavesOutWhatAModuleWouldSave) {
  ScriptedDrive drive{{{"P102 set 1", 200}, {"P151", 0}}};
  drive.module_saves = true;
  const RestorePlan plan = planned(drive, {{"P102 set 1", 250}, {"P151", 500}});
  EXPECT_THAT(written(plan), ElementsAre("P102 set 1"));
  ASSERT_EQ(1u, plan.left_out.size());
  EXPECT_EQ("the module has no order here that spares its EEPROM; --persistent writes it", plan.left_out[0].why);
}

// What cannot move a motor, what may, what the words mean, P105; the branch the program sits on only when it was said.
const std::map<std::string, std::int32_t> kHave{
    {"P102 set 1", 200}, {"P104 set 1", 0}, {"P105 set 1", 500}, {"P420", 0},       {"P506", 0},       {"P508", 3},
    {"P509", 4},         {"P513", 0},       {"P514", 5},         {"P543 set 1", 1}, {"P546 set 1", 1}, {"P560", 1}};
const std::map<std::string, std::int32_t> kWant{
    {"P102 set 1", 250}, {"P104 set 1", 10}, {"P105 set 1", 600}, {"P420", 1},       {"P506", 7},       {"P508", 4},
    {"P509", 6},         {"P513", 10},       {"P514", 4},         {"P543 set 1", 2}, {"P546 set 1", 5}, {"P560", 0}};

TEST(RestorePlan, WritesWhatCutsTheBranchLastAndOnlyWhenItWasSaid) {
  ScriptedDrive drive{kHave};
  EXPECT_THAT(written(planned(drive, kWant)), ElementsAre("P102 set 1", "P506", "P104 set 1", "P420", "P513",
                                                          "P543 set 1", "P546 set 1", "P105 set 1"));
  EXPECT_THAT(written(planned(drive, kWant, with(BusSettings::kAll))),
              ElementsAre("P102 set 1", "P506", "P104 set 1", "P420", "P513", "P543 set 1", "P546 set 1", "P105 set 1",
                          "P509", "P514", "P508"));
  EXPECT_THAT(written(planned(drive, kWant, with(BusSettings::kNone))),
              ElementsAre("P102 set 1", "P506", "P104 set 1", "P420"));
}

TEST(RestorePlan, NamesWhatItLeavesOut) {
  ScriptedDrive drive{kHave};
  const std::string text = planText(planned(drive, kWant), drive.known(), false);
  EXPECT_THAT(text, HasSubstr("left out:\n  P508 PROFIBUS address: 3 in the drive, 4 in the file (the bus reaches the "
                              "drive by it; --with-bus-settings writes it)\n"));
  EXPECT_THAT(text, HasSubstr("(it decides where every write goes: write it by itself)\n"));
  EXPECT_THAT(text, HasSubstr("8 to be written, in RAM: lost at power off; 0 have their value already, 4 left out\n"));
}

// Whatever a file says: P152 resets the module, information changes by itself.
TEST(RestorePlan, NeverWritesAResetOrInformation) {
  ScriptedDrive drive{{{"P152", 0}, {"P701[-01]", 0}, {"P743", 150}, {"P970", 0}}};
  const RestorePlan plan =
      planned(drive, {{"P152", 1}, {"P701[-01]", 102}, {"P743", 1}, {"P970", 1}}, with(BusSettings::kAll));
  EXPECT_THAT(plan.changes, IsEmpty());
  EXPECT_THAT(plan.left_out, IsEmpty());
}

TEST(RestorePlan, LeavesOutWhatTheDriveDoesNotHaveOrTake) {
  ScriptedDrive drive{{{"P513", 0}}};
  const RestorePlan plan = planned(drive, {{"P513", 30000}, {"P102 set 1", 200}});
  EXPECT_THAT(plan.changes, IsEmpty());
  ASSERT_EQ(2u, plan.left_out.size());
  EXPECT_THAT(plan.left_out[0].why, HasSubstr("not in this drive: drive left refuses P102 set 1"));
  EXPECT_THAT(plan.left_out[1].why, HasSubstr("expected -0.1 to 100 s"));
}

// A value of an earlier write may be in the RAM only, and reads the same.
TEST(RestorePlan, SavesWhatIsThereAlreadyWhenItWasSaid) {
  ScriptedDrive drive{{{"P102 set 1", 250}, {"P508", 3}}};
  RestoreOptions options;
  options.persistent = true;
  EXPECT_THAT(written(planned(drive, {{"P102 set 1", 250}}, options)), IsEmpty());
  options.save_same = true;
  const RestorePlan plan = planned(drive, {{"P102 set 1", 250}, {"P508", 3}}, options);
  EXPECT_THAT(written(plan), ElementsAre("P102 set 1"));
  EXPECT_THAT(plan.left_out, IsEmpty()) << "what is not to be written and need not be";
}

TEST(RestorePlan, IsNotMadeOfADriveThatFallsSilentOrIsAnother) {
  ScriptedDrive drive{{{"P102 set 1", 250}}};
  drive.accesses_left = 0;
  EXPECT_THROW(planned(drive, {{"P102 set 1", 200}}), Trouble);
  Dump other;
  other.series = profile::Series::kSk300e;
  EXPECT_THROW(planRestore(drive, other, {}, kNotAsked), UsageError);
  const std::atomic<bool> asked{true};
  drive.accesses_left = -1;
  EXPECT_THROW(planRestore(drive, dumpOf({{"P102 set 1", 200}}), {}, asked), Trouble);
}

}  // namespace
}  // namespace nord_driver::tools
