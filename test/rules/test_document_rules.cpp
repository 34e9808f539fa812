#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rules/document_rules.h"

namespace nord_driver::rules {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const char* const kHeader =
    "class BusCycle {\n  void runOnce();  // calls waitForNobody()\n};\nenum class Way { kOff1 };\nHertz "
    "toHertz(double);\n";

/// What is said about one document, beside one header, one source and one message.
Violations about(const std::string& text) {
  return checkDocuments({{"doc/a.md", text},
                         {"include/nord_driver/core/bytes.h", "void Ramp::update() {}\n"},
                         {"msg/BusStatus.msg", "bool connected\n"},
                         {"src/cycle/bus_cycle.h", kHeader},
                         {"test/rules/test_document_rules.cpp", "class OnlyInTheRules {};\n"}},
                        {});
}

// A tree without documents proves nothing.
TEST(DocumentRules, AnEmptyTreeIsAViolation) {
  EXPECT_THAT(checkDocuments({}, {}), ElementsAre(HasSubstr("no document")));
}

TEST(DocumentRules, WhatIsThereMayBeNamed) {
  EXPECT_THAT(about("`BusCycle`, `BusCycle::runOnce`, `cycle::BusCycle::runOnce()`, `runOnce()`, `toHertz`\n"),
              IsEmpty());
  EXPECT_THAT(about("`Ramp::update`, `BusStatus`\n"), IsEmpty());
  EXPECT_THAT(about("`src/cycle/bus_cycle.h`, `src/cycle`, `src/cycle/`, `cycle/bus_cycle.h`, `bytes.h`\n"), IsEmpty());
}

TEST(DocumentRules, WhatIsNowhereIsNamedWithFileAndLine) {
  EXPECT_THAT(about("# Title\n\nsee `CanCycle`\n"), ElementsAre("doc/a.md:3: `CanCycle` is nowhere in the code"));
  for (const char* name :
       {"BusCycle::runTwice", "CanCycle::runOnce", "runTwice()", "toVolt", "src/cycle/bus.h", "src/bus/", "cycle.h",
        "test/cycle", "waitForNobody()", "waitForNobody", "OnlyInTheRules", "BusCycle::toHertz::runOnce"}) {
    EXPECT_THAT(about("`" + std::string{name} + "`\n"), ElementsAre(HasSubstr(name))) << name;
  }
}

// Keys, values, commands and the names of the manuals are not code.
TEST(DocumentRules, OtherWordsAreNotLookedFor) {
  EXPECT_THAT(about("`cycle_rate`, `~bus/device`, `P105`, `047F`, `catkin build nord_driver`, `Set_Prm`, `/cmd_vel`\n"),
              IsEmpty());
  EXPECT_THAT(about("CanCycle in a sentence\n```\n`CanCycle` in an example\n```\n"), IsEmpty());
}

TEST(DocumentRules, AForeignNameIsAllowedWhileItIsNeeded) {
  const std::map<std::string, std::string> foreign{{"ros::Time", "roscpp"}};
  EXPECT_THAT(checkDocuments({{"doc/a.md", "`ros::Time`\n"}}, foreign), IsEmpty());
  EXPECT_THAT(checkDocuments({{"doc/a.md", "nothing\n"}}, foreign), ElementsAre(HasSubstr("no document needs")));
}

}  // namespace
}  // namespace nord_driver::rules
