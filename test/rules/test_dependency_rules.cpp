#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rules/dependency_rules.h"

namespace nord_driver::rules {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::vector<Dependency> kTable{{"", {"cmake"}, {"Threads"}},
                                     {"libboost-dev", {"libboost-dev"}, {"Boost", "any"}},
                                     {"roscpp", {"ros-core-dev"}, {"roscpp"}},
                                     {"rosbag", {"ros-core-dev"}, {}},
                                     {"google-mock", {"libgmock-dev"}, {"gmock"}}};

std::vector<SourceFile> tree() {
  return {
      {"package.xml",
       "<depend>roscpp</depend>\n<depend>libboost-dev</depend><exec_depend>rosbag</exec_depend>\n"
       "<test_depend version_gte=\"1.8\">google-mock</test_depend>"},
      {"scripts/install_deps.sh",
       "packages=(\n  cmake ros-core-dev # builds (and runs)\n  libboost-dev libgmock-dev\n)\ntest_packages=(\n  "
       "tshark\n)\n"},
      {"CMakeLists.txt", "find_package(roscpp)"},
      {"src/CMakeLists.txt", "find_package(Boost REQUIRED COMPONENTS any) # find_package(Old)\nfind_package(Threads)"},
      {"cmake/a.cmake", "find_library(A_LIBRARY gmock)"},
      {"bench/CMakeLists.txt", "find_package(benchmark REQUIRED)"}};
}

std::vector<SourceFile> treeWith(std::size_t file, const std::string& text) {
  auto files = tree();
  files[file].text = text;
  return files;
}

TEST(DependencyRules, WhatIsNamedAlikePasses) {
  EXPECT_THAT(checkDependencies(tree(), kTable), IsEmpty());
}

// Each of the three is found out when it lacks a name, and when it has one more.
TEST(DependencyRules, WhatIsMissingOrUnknownIsNamed) {
  EXPECT_THAT(
      checkDependencies(treeWith(2, "find_package(catkin_like QUIET)"), kTable),
      ElementsAre("CMakeLists.txt and cmake/: roscpp is missing, test/rules/dependency_rules.cpp expects it",
                  "CMakeLists.txt and cmake/: catkin_like is not in the table of test/rules/dependency_rules.cpp"));
  EXPECT_THAT(checkDependencies(treeWith(0,
                                         "<depend>roscpp</depend><depend>libboost-dev</depend>"
                                         "<depend>google-mock</depend><build_depend>cli11</build_depend>"),
                                kTable),
              ElementsAre("package.xml: rosbag is missing, test/rules/dependency_rules.cpp expects it",
                          "package.xml: cli11 is not in the table of test/rules/dependency_rules.cpp"));
  EXPECT_THAT(
      checkDependencies(treeWith(1, "packages=(cmake ros-core-dev libgmock-dev libcli11-dev)"), kTable),
      ElementsAre("scripts/install_deps.sh: libboost-dev is missing, test/rules/dependency_rules.cpp expects it",
                  "scripts/install_deps.sh: libcli11-dev is not in the table of test/rules/dependency_rules.cpp"));
}

}  // namespace
}  // namespace nord_driver::rules
