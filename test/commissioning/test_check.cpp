#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "commissioning/check.h"
#include "commissioning/checked_drive.h"

namespace nord_driver::commissioning {
namespace {

using profile::Series;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

// A rule that looks at what nobody reads would never find anything.
TEST(Check, ReadsWhatTheRulesLookAt) {
  const AskedDrive asked = askedDrive(Series::kSk5xxe);
  const std::vector<ParameterKey> keys = valuesToRead(asked, knownOf(asked), 2);
  for (const ParameterKey& key : std::vector<ParameterKey>{
           {509},       {510, 0, 1}, {513},        {560},       {105, 1, 0}, {105, 4, 0}, {104, 3, 0},
           {543, 2, 0}, {546, 2, 0}, {544, 2, 0},  {545, 2, 0}, {547, 2, 0}, {548, 2, 0}, {600, 1, 0},
           {600, 4, 0}, {480, 0, 1}, {480, 0, 12}, {102, 2, 0}, {103, 2, 0}, {426, 2, 0}, {300, 2, 0}}) {
    EXPECT_THAT(keys, Contains(key)) << key.number;
  }
  EXPECT_THAT(keys, Not(Contains(ParameterKey{151})));
  EXPECT_THAT(keys, Not(Contains(ParameterKey{610}))) << "it is not to position";
  EXPECT_THAT(keys, Not(Contains(ParameterKey{544, 1, 0}))) << "of the set in force only";
  EXPECT_EQ((ParameterKey{509}), keys.front()) << "the first thing to be known";
}

// SK 1x0E and 300E would refuse each of the questions (BU 2700 6.4.4, BU 0020 7.3.5).
TEST(Check, ReadsNoPositionControlOfASeriesWithoutOne) {
  for (const Series series : {Series::kSk1x0e, Series::kSk300e}) {
    const AskedDrive asked = askedDrive(series);
    EXPECT_THAT(valuesToRead(asked, knownOf(asked), 1), Not(Contains(ParameterKey{600, 1, 0})));
  }
}

TEST(Check, ReadsTheModule) {
  const AskedDrive asked = askedDrive(Series::kSk2xxe);
  const std::vector<ParameterKey> keys = valuesToRead(asked, knownOf(asked), 1);
  EXPECT_THAT(keys, Contains(ParameterKey{151}));
  EXPECT_THAT(keys, Contains(ParameterKey{120, 0, 1}));
}

// With change of state and cyclic on DeviceNet not each cycle has a telegram.
TEST(Check, ATimeoutOutlastsTwoPausesBetweenTelegrams) {
  AskedDrive asked = askedDrive(Series::kSk2xxe, "devicenet");
  asked.identity.longest_pause = 0.3;
  const Drives tight{drive(asked, {{{151}, 599}})};
  EXPECT_THAT(shortly(check(tight)), ElementsAre("timeout_long_enough warning P151 -> 600"));
  const Drives enough{drive(asked, {{{151}, 600}})};
  EXPECT_THAT(shortly(check(enough)), IsEmpty());
}

TEST(Check, ReadsNothingTwice) {
  for (const Series series : profile::kAllSeries) {
    const AskedDrive asked = askedDrive(series);
    std::vector<ParameterKey> keys = valuesToRead(asked, knownOf(asked), 1);
    std::sort(keys.begin(), keys.end());
    EXPECT_TRUE(std::adjacent_find(keys.begin(), keys.end()) == keys.end()) << profile::toString(series);
  }
}

TEST(Check, NamesRuleAndDrive) {
  AskedDrive left = askedDrive(Series::kSk5xxe), right = left;
  right.name = "right";
  const Findings findings = check({drive(left), drive(right, {{{509}, 0}})});
  ASSERT_EQ(1u, findings.size());
  EXPECT_EQ("right", findings[0].drive);
  EXPECT_EQ("bus_has_control", findings[0].rule);
  EXPECT_TRUE(findings[0].selects_bus);
}

}  // namespace
}  // namespace nord_driver::commissioning
