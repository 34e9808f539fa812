#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rules/text_rules.h"

namespace nord_driver::rules {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A tree without files proves nothing.
TEST(TextRules, AnEmptyTreeIsAViolation) {
  EXPECT_EQ(1u, checkCppFiles({}).size());
  EXPECT_EQ(1u, checkWords({}).size());
}

// A header begins with what it is for and is guarded.
TEST(TextRules, Headers) {
  EXPECT_THAT(checkCppFiles({{"a.h", "// What for.\n#pragma once\n"}}), IsEmpty());
  EXPECT_THAT(checkCppFiles({{"a.h", "// What for.\n"}}), ElementsAre(HasSubstr("no #pragma once")));
  EXPECT_THAT(checkCppFiles({{"a.h", "\n#pragma once\n"}}), ElementsAre(HasSubstr("does not begin with a comment")));
  EXPECT_THAT(checkCppFiles({{"a.cpp", "int a;\n"}}), IsEmpty());
}

// 400 lines are the alarm.
TEST(TextRules, LongFiles) {
  std::string text;
  for (std::size_t i = 0; i < kMaxLines; ++i) text += "\n";
  EXPECT_THAT(checkCppFiles({{"a.cpp", text}}), IsEmpty());
  EXPECT_THAT(checkCppFiles({{"a.cpp", text + "\n"}}), ElementsAre("a.cpp: 401 lines, at most 400"));
}

// Parameters of an earlier start are no part of this one.
TEST(TextRules, LaunchFiles) {
  const std::string node = "<launch><node pkg=\"nord_driver\" type=\"nord_driver_node\"";
  EXPECT_THAT(checkLaunchFiles({{"launch/a.launch", node + "\n  clear_params=\"true\">"}}), IsEmpty());
  EXPECT_THAT(checkLaunchFiles({{"launch/a.launch", node + "/><!-- clear_params=\"true\" -->"}}),
              ElementsAre(HasSubstr("launch/a.launch: ")));
  EXPECT_THAT(checkLaunchFiles({{"test/a.launch", node + "/>"}}), ElementsAre("no node in launch/ at all"));
}

// Nothing is left for later, and nothing outside the project is named; the words are put together here too.
TEST(TextRules, ForbiddenWords) {
  EXPECT_THAT(checkWords({{"a.md", "to do\n"}}), IsEmpty());
  EXPECT_THAT(checkWords({{"a.md", "x\n" + std::string("TO") + "DO: y\n"}}), ElementsAre(HasSubstr("a.md:2: ")));
  EXPECT_THAT(checkWords({{"run", std::string("# FIX") + "ME\n"}}), ElementsAre(HasSubstr("run:1: ")));
  EXPECT_THAT(checkWords({{"a.h", std::string("// ../sha") + "red/x\n"}}), ElementsAre(HasSubstr("a.h:1: ")));
}

}  // namespace
}  // namespace nord_driver::rules
