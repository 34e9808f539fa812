#include <gtest/gtest.h>

#include <stdexcept>

#include "rules/source_tree.h"

namespace nord_driver::rules {
namespace {

// A path that is no folder is an error, not an empty project.
TEST(SourceTree, AMissingFolderIsAnError) {
  EXPECT_THROW(readTree("/nowhere/at/all"), std::runtime_error);
}

// Comments go, lines stay, and what looks like a comment in a string is none.
TEST(SourceTree, WithoutComments) {
  EXPECT_EQ("a           \nb", withoutComments("a // comment\nb"));
  EXPECT_EQ("a       \n      b", withoutComments("a /* one\ntwo */b"));
  EXPECT_EQ("f(\"// no\");", withoutComments("f(\"// no\");"));
  EXPECT_EQ("f(\"\\\"// no\");", withoutComments("f(\"\\\"// no\");"));
  EXPECT_EQ("c = '\"';     ", withoutComments("c = '\"'; // x"));
  EXPECT_EQ("n = 1'000;     ", withoutComments("n = 1'000; // x"));
}

TEST(SourceTree, PartsAndLines) {
  EXPECT_EQ((std::vector<std::string>{"src", "robot", "ramp.cpp"}), partsOf("src/robot/ramp.cpp"));
  EXPECT_EQ((std::vector<std::string>{"a", "", "b"}), linesOf("a\n\nb\n"));
}

}  // namespace
}  // namespace nord_driver::rules
