// A file that is changed as a whole, or not at all.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "state/state_file.h"
#include "support/temporary_folder.h"

namespace nord_driver::state {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(StateFile, IsMadeWithItsFolders) {
  const test::TemporaryFolder folder;
  const StateFile file{folder.path("a/b/counts.yaml")};
  EXPECT_FALSE(file.read());
  file.replace("one\n");
  EXPECT_EQ("one\n", file.read());
  file.replace("another\n");
  EXPECT_EQ("another\n", folder.read("a/b/counts.yaml"));
}

// Whoever has the old file open goes on reading the old one: nobody sees a half of two.
TEST(StateFile, IsReplacedAsAWhole) {
  const test::TemporaryFolder folder;
  folder.write("counts.yaml", "before");
  const int reader = ::open(folder.path("counts.yaml").c_str(), O_RDONLY);
  ASSERT_GE(reader, 0);
  StateFile{folder.path("counts.yaml")}.replace("after");
  char text[16] = {};
  EXPECT_EQ(6, ::read(reader, text, sizeof text));
  EXPECT_STREQ("before", text);
  ::close(reader);
  EXPECT_EQ("after", folder.read("counts.yaml"));
}

// What a run that was killed has left beside it is no part of it.
TEST(StateFile, IgnoresWhatWasNotFinished) {
  const test::TemporaryFolder folder;
  folder.write("counts.yaml", "whole");
  folder.write("counts.yaml.new", "ha");
  const StateFile file{folder.path("counts.yaml")};
  EXPECT_EQ("whole", file.read());
  file.replace("next");
  EXPECT_EQ("next", file.read());
}

TEST(StateFile, SaysWhyItCannotBeUsed) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("folder"));
  const StateFile file{folder.path("folder")};
  EXPECT_THROW(file.read(), StateError);
  folder.write("no_folder", "");
  try {
    const StateFile none{folder.path("no_folder/counts.yaml")};
    FAIL() << "not refused";
  } catch (const StateError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("no_folder/counts.yaml.lock cannot be opened"), HasSubstr("(")));
  }
}

TEST(StateFile, StandsInTheHomeOfRos) {
  EXPECT_EQ("/r/nord_driver/x", stateFilePath("/r", "/h", "x"));
  EXPECT_EQ("/h/.ros/nord_driver/x", stateFilePath("", "/h", "x"));
  EXPECT_EQ("/h/.ros/nord_driver/x", stateFilePath(nullptr, "/h", "x"));
  EXPECT_EQ("", stateFilePath(nullptr, nullptr, "x"));
  EXPECT_THROW(StateFile{""}, StateError);
}

}  // namespace
}  // namespace nord_driver::state
