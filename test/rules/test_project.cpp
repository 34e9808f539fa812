// The rules applied to this project.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rules/build_rules.h"
#include "rules/dependency_rules.h"
#include "rules/document_rules.h"
#include "rules/door_rules.h"
#include "rules/include_rules.h"
#include "rules/name_rules.h"
#include "rules/source_tree.h"
#include "rules/text_rules.h"

namespace nord_driver::rules {
namespace {

const std::vector<SourceFile>& project() {
  static const std::vector<SourceFile> kFiles = readTree(NORD_DRIVER_SOURCE_DIR);
  return kFiles;
}

std::string list(const Violations& violations) {
  std::string text;
  for (const std::string& violation : violations) text += "\n  " + violation;
  return text;
}

// The reader found this very file: the rules below look at the right tree.
TEST(Project, IsRead) {
  std::size_t found = 0;
  for (const SourceFile& file : project()) {
    if (file.path == "test/rules/test_project.cpp" || file.path == "include/nord_driver/core/bytes.h" ||
        file.path == "CMakeLists.txt") {
      ++found;
    }
  }
  EXPECT_EQ(3u, found);
}

// Architecture: which folder may use which.
TEST(Project, EveryIncludeKeepsTheLayers) {
  EXPECT_EQ("", list(checkIncludes(project())));
}

// A bus that is added needs no change above its transport.
TEST(Project, NoLayerAboveTheTransportsNamesABus) {
  EXPECT_EQ("", list(checkBusNames(project(), namedBuses())));
}

// Small files, one idea each; every header says what it is for.
TEST(Project, CppFilesAreSmallAndHeadersSayWhatTheyAreFor) {
  EXPECT_EQ("", list(checkCppFiles(project())));
}

// A start knows nothing of the one before it.
TEST(Project, EveryStartForgetsTheParametersOfTheLast) {
  EXPECT_EQ("", list(checkLaunchFiles(project())));
}

// Who has run the demo and the tests is not asked by rosrun which of them is meant.
TEST(Project, ProgramsOfTestsAreBuiltWhereRosrunDoesNotLook) {
  EXPECT_EQ("", list(checkBuildFolders(project())));
}

// The project stands alone and leaves no work for later.
TEST(Project, HoldsNoForbiddenWord) {
  EXPECT_EQ("", list(checkWords(project())));
}

// What nobody lists is not built and not tested.
TEST(Project, EverySourceIsListed) {
  EXPECT_EQ("", list(checkSourceLists(project())));
}

// What rosdep, apt and CMake are told is the same.
TEST(Project, DependenciesAreNamedAlikeEverywhere) {
  EXPECT_EQ("", list(checkDependencies(project(), dependencies())));
}

// What comes from outside is never a command line, a program or a format.
TEST(Project, NothingFromOutsideIsACommandOrAFormat) {
  EXPECT_EQ("", list(checkCalls(project())));
  EXPECT_EQ("", list(checkFormats(project())));
}

// Whoever follows a document finds what it names.
TEST(Project, DocumentsNameOnlyWhatExists) {
  EXPECT_EQ("", list(checkDocuments(project(), foreignNames())));
}

}  // namespace
}  // namespace nord_driver::rules
