#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rules/build_rules.h"

namespace nord_driver::rules {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const SourceFile kTop{"CMakeLists.txt", "foreach(layer core robot)\n  add_subdirectory(test)\n"};

// A tree without sources proves nothing.
TEST(BuildRules, AnEmptyTreeIsAViolation) {
  EXPECT_THAT(checkSourceLists({}), ElementsAre(HasSubstr("no .cpp")));
}

// What is listed passes, with or without a path before the name.
TEST(BuildRules, ListedSourcesPass) {
  EXPECT_THAT(checkSourceLists({kTop,
                                {"src/robot/CMakeLists.txt", "  ${CMAKE_CURRENT_SOURCE_DIR}/ramp.cpp)\n"},
                                {"src/robot/ramp.cpp", "x"},
                                {"test/CMakeLists.txt", "add_subdirectory(robot)\n"},
                                {"test/robot/CMakeLists.txt", "SOURCES test_ramp.cpp deep/b.cpp\n"},
                                {"test/robot/test_ramp.cpp", "x"},
                                {"test/robot/deep/b.cpp", "x"}}),
              IsEmpty());
}

// A forgotten source is found; a longer name that ends alike does not hide it.
TEST(BuildRules, ForgottenSourcesAreFound) {
  EXPECT_THAT(checkSourceLists({kTop, {"src/robot/CMakeLists.txt", "slow_ramp.cpp)\n"}, {"src/robot/ramp.cpp", "x"}}),
              ElementsAre("src/robot/ramp.cpp: not named in src/robot/CMakeLists.txt"));
  EXPECT_THAT(checkSourceLists({kTop, {"src/robot/ramp.cpp", "x"}}),
              ElementsAre("src/robot/ramp.cpp: not named in CMakeLists.txt"));
}

// A forgotten folder is found.
TEST(BuildRules, ForgottenFoldersAreFound) {
  EXPECT_THAT(checkSourceLists({kTop,
                                {"test/CMakeLists.txt", "foreach(part core)\n"},
                                {"test/plugins/CMakeLists.txt", "a.cpp"},
                                {"test/plugins/a.cpp", "x"}}),
              ElementsAre("test/plugins: not named in test/CMakeLists.txt"));
}

// rosrun finds the programs of the demo, and no others.
TEST(BuildRules, ProgramsOfTestsAreBuiltWhereRosrunDoesNotLook) {
  EXPECT_THAT(checkBuildFolders({{"scripts/demo.sh", "out=\"$root/out/demo\"\n"},
                                 {"scripts/test.sh", "out=$root/build/test\nif a; then\n  out=$root/build/b\nfi\n"}}),
              IsEmpty());
  EXPECT_THAT(checkBuildFolders({{"scripts/test.sh", "out=$root/out/test\n"}}),
              ElementsAre(HasSubstr("scripts/test.sh")));
  EXPECT_THAT(checkBuildFolders({}), ElementsAre("no script that builds"));
}

}  // namespace
}  // namespace nord_driver::rules
