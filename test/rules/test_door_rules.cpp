#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rules/door_rules.h"

namespace nord_driver::rules {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A tree without files proves nothing.
TEST(DoorRules, AnEmptyTreeIsAViolation) {
  EXPECT_EQ(1u, checkCalls({}).size());
  EXPECT_EQ(1u, checkFormats({}).size());
}

TEST(DoorRules, NobodyStartsAProgram) {
  EXPECT_THAT(checkCalls({{"src/a.cpp", "// system(x)\nint a = file_system(\"popen(x)\");\n"}}), IsEmpty());
  EXPECT_THAT(checkCalls({{"src/a.cpp", "\nstd::system(text.c_str());\n"}}), ElementsAre("src/a.cpp:2: calls system"));
  EXPECT_THAT(checkCalls({{"src/a.cpp", "f();\n"}, {"include/a.h", "::popen(a, b)"}}),
              ElementsAre("include/a.h:1: calls popen"));
  EXPECT_THAT(checkCalls({{"src/a.cpp", "char c = '\"'; strcpy(a, b);"}}), ElementsAre(HasSubstr("calls strcpy")));
  EXPECT_THAT(checkCalls({{"src/a.cpp", "int n = 1'000; f();"}, {"test/a.cpp", "fork();"}}), IsEmpty());
}

TEST(DoorRules, EveryFormatIsALiteral) {
  const auto check = [](const std::string& text) { return checkFormats({{"src/a.cpp", "printf(\"x\");\n" + text}}); };
  EXPECT_THAT(check("std::snprintf(text, sizeof text, \"%s, %d\", f(a, b), 1);"), IsEmpty());
  EXPECT_THAT(check("text.format(a < b ? \"%d\" : \"%u\", c);"), IsEmpty());
  EXPECT_THAT(check("std::fprintf(stderr,\n  \"%s\", text.c_str());"), IsEmpty());
  EXPECT_THAT(check("std::snprintf(text, sizeof(text), pattern, a);"), IsEmpty()) << "held where it is called";
  EXPECT_THAT(check("std::string format(const char* pattern, unsigned a);"), IsEmpty());
  EXPECT_THAT(check("ROS_WARN_THROTTLE(1.0, \"%s\", a);"), IsEmpty());
  EXPECT_THAT(check("ROS_WARN(message.c_str());"), ElementsAre(HasSubstr("src/a.cpp:2: ROS_WARN() with a format")));
  EXPECT_THAT(check("std::printf(text.c_str(), \"literal\");"), ElementsAre(HasSubstr("no literal: text.c_str()")));
  EXPECT_THAT(check("reason.format(wire.text);"), ElementsAre(HasSubstr("format() with a format that is no literal")));
  EXPECT_THAT(check("std::snprintf(a, sizeof a, known ? \"%s\" : b, c);"), ElementsAre(HasSubstr("snprintf()")));
}

}  // namespace
}  // namespace nord_driver::rules
