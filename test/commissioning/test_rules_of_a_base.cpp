// What has to be alike in the drives of one base.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "commissioning/checked_drive.h"

namespace nord_driver::commissioning {
namespace {

using profile::Series;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(RulesOfABase, CompareDrivesOfABase) {
  for (const Series series : profile::kAllSeries) {
    AskedDrive left = askedDrive(series), right = askedDrive(series);
    right.name = "right";
    EXPECT_THAT(check({drive(left), drive(right)}), IsEmpty());
    const Drives differ{drive(left), drive(right, {{{103, 1, 0}, 300}, {{105, 1, 0}, 600}, {{103, 2, 0}, 1}})};
    const Findings findings = check(differ);
    EXPECT_THAT(shortly(findings), ElementsAre("base_alike warning P103 set 1", "base_alike warning P105 set 1"));
    EXPECT_EQ("right", findings.back().drive);
    EXPECT_THAT(toText(findings.back()), HasSubstr("= 60.0 Hz: drive left of the same base has 50.0 Hz"));
    right.of_base = false;
    EXPECT_THAT(check({drive(left), drive(right, {{{103, 1, 0}, 300}})}), IsEmpty()) << "another machine";
  }
}

TEST(RulesOfABase, CompareTheSetsOfABase) {
  AskedDrive left = askedDrive(Series::kSk5xxe), right = left;
  right.name = "right";
  const Drives drives{drive(left), drive(right, {}, 2)};
  EXPECT_THAT(shortly(check(drives)), ElementsAre("set_in_force note parameter", "base_alike warning parameter"));
}

}  // namespace
}  // namespace nord_driver::commissioning
