// Files that the configuration names: what would hold up the start or take all memory is no file to read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "config/text_file.h"
#include "support/map_settings.h"
#include "support/temporary_folder.h"

namespace nord_driver {
namespace {

using ::testing::HasSubstr;

std::string read(const std::string& path) {
  return readTextFile(test::MapSettings{"~bus/"}, "eds", path, "an EDS file");
}
std::string refusal(const std::string& path) {
  try {
    return "accepted: " + read(path).substr(0, 20);
  } catch (const ConfigError& error) {
    return error.what();
  }
}

TEST(TextFile, IsReadAsAWhole) {
  const test::TemporaryFolder folder;
  folder.write("a.eds", "[FileInfo]\n");
  EXPECT_EQ("[FileInfo]\n", read(folder.path("a.eds")));
  std::filesystem::create_symlink(folder.path("a.eds"), folder.path("b.eds"));
  EXPECT_EQ("[FileInfo]\n", read(folder.path("b.eds")));
}

TEST(TextFile, SaysWhyItCannotBeRead) {
  const test::TemporaryFolder folder;
  folder.write("empty", "");
  EXPECT_EQ("~bus/eds: \"/nowhere\" is not valid, expected an EDS file that can be read (No such file or directory)",
            refusal("/nowhere"));
  EXPECT_THAT(refusal(folder.path("empty")), HasSubstr("(it is empty)"));
  EXPECT_THAT(refusal(folder.path("")), HasSubstr("(it is no ordinary file)"));
  EXPECT_THAT(refusal(""), HasSubstr("(No such file or directory)"));
}

TEST(TextFile, APipeADeviceAndAHugeFileAreNotBegun) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(0, ::mkfifo(folder.path("pipe").c_str(), 0600));
  EXPECT_THAT(refusal(folder.path("pipe")), HasSubstr("(it is no ordinary file)"));
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("(it is no ordinary file)"));
  folder.write("huge", "x");
  std::filesystem::resize_file(folder.path("huge"), kLargestTextFile + 1);
  EXPECT_THAT(refusal(folder.path("huge")), HasSubstr("(it has more than 4 MiB)"));
}

}  // namespace
}  // namespace nord_driver
