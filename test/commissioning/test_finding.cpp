#include <gtest/gtest.h>

#include "commissioning/finding.h"

namespace nord_driver::commissioning {
namespace {

TEST(Finding, IsOneSentence) {
  Finding finding;
  finding.parameter = "P509 Source control word";
  finding.value = "0 Control terminals or keyboard";
  finding.why = "this bus has no control";
  finding.source = "BU 0020, 6.2.2, p. 63";
  EXPECT_EQ(
      "P509 Source control word = 0 Control terminals or keyboard: this bus has no control (BU 0020, 6.2.2, p. 63)",
      toText(finding));
  finding.advice = "look at the display";
  EXPECT_EQ(
      "P509 Source control word = 0 Control terminals or keyboard: this bus has no control; look at the display "
      "(BU 0020, 6.2.2, p. 63)",
      toText(finding));
  finding.remedy = Remedy{4, "4 PROFIBUS"};
  finding.source.clear();
  EXPECT_EQ("P509 Source control word = 0 Control terminals or keyboard: this bus has no control; set it to 4 PROFIBUS",
            toText(finding));
}

TEST(Finding, HasThreeSeverities) {
  EXPECT_STREQ("error", toString(Severity::kError));
  EXPECT_STREQ("warning", toString(Severity::kWarning));
  EXPECT_STREQ("note", toString(Severity::kNote));
}

}  // namespace
}  // namespace nord_driver::commissioning
