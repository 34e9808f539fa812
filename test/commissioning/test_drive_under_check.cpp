#include <gtest/gtest.h>

#include "commissioning/checked_drive.h"
#include "commissioning/drive_under_check.h"

namespace nord_driver::commissioning {
namespace {

using profile::Series;

TEST(DriveUnderCheck, KnowsHowASeriesHasAParameter) {
  const DriveUnderCheck separate = drive(askedDrive(Series::kSk5xxe), {}, 2);
  EXPECT_EQ((ParameterKey{547, 2, 0}), separate.functionKey(546, 1)) << "of the set in force";
  EXPECT_EQ((ParameterKey{545, 4, 0}), separate.functionKey(543, 2, 4));
  EXPECT_EQ((ParameterKey{509, 0, 0}), separate.key(509, 3));
  EXPECT_EQ((ParameterKey{480, 0, 12}), separate.key(480, 0, 12));
  const DriveUnderCheck array = drive(askedDrive(Series::kSk2xxe));
  EXPECT_EQ((ParameterKey{546, 1, 2}), array.functionKey(546, 1));
  EXPECT_EQ((ParameterKey{543, 4, 3}), array.functionKey(543, 2, 4));
}

TEST(DriveUnderCheck, ReadsAWordWithItsSign) {
  const DriveUnderCheck checked = drive(askedDrive(Series::kSk5xxe), {{{513}, 0xFFFF}});
  EXPECT_EQ(-1, checked.raw({513}));
  EXPECT_DOUBLE_EQ(-0.1, *checked.value({513}));
  EXPECT_FALSE(checked.raw({999}));
}

TEST(DriveUnderCheck, NamesParametersAsPeopleDo) {
  const DriveUnderCheck checked = drive(askedDrive(Series::kSk2xxe));
  EXPECT_EQ("P105 set 2 Maximum frequency", checked.nameOf({105, 2, 0}));
  EXPECT_EQ("P480[-12] Function of bus I/O in bits, Bit 9 of the control word", checked.nameOf({480, 0, 12}));
  EXPECT_EQ("P999", checked.nameOf({999}));
  EXPECT_EQ("BU 0280, 5.1.3, p. 50", checked.sourceOf({509}));
  EXPECT_EQ("", checked.sourceOf({104, 1, 0})) << "no manual";
}

TEST(DriveUnderCheck, MakesFindings) {
  const DriveUnderCheck checked = drive(askedDrive(Series::kSk5xxe), {{{105, 1, 0}, 700}});
  const Finding finding = checked.finding({105, 1, 0}, Severity::kNote, "why", "BU 1, 2");
  EXPECT_EQ("70.0 Hz", finding.value);
  EXPECT_EQ(700, finding.raw);
  EXPECT_EQ("BU 1, 2; BU 0020, 7.3.5, p. 77", finding.source);
  const Remedy remedy = checked.remedy({105, 1, 0}, 50.0);
  EXPECT_EQ(500, remedy.raw);
  EXPECT_EQ("50.0 Hz", remedy.text);
}

}  // namespace
}  // namespace nord_driver::commissioning
