#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tools/key_lines.h"

namespace nord_driver::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class KeyLinesTest : public ::testing::Test {
 protected:
  std::string write(const std::string& text) {
    file_ = ::testing::TempDir() + "key_lines_" + std::to_string(::getpid()) + ".yaml";
    std::ofstream(file_) << text;
    return file_;
  }
  ~KeyLinesTest() override { ::unlink(file_.c_str()); }

 private:
  std::string file_;
};

TEST_F(KeyLinesTest, TellsWhereTheKeyOfASentenceStands) {
  const KeyLines lines(
      {write("bus: {device: /dev/ttyUSB0}\n"
             "drives:\n"
             "  left:\n"
             "    address: 3\n"
             "linear/x:\n"
             "  max_velocity: 0.5\n")});
  EXPECT_EQ(1, lines.lineOf("bus/device: ..."));
  EXPECT_EQ(4, lines.lineOf("drives/left/address: 3 is not valid"));
  EXPECT_EQ(3, lines.lineOf("drives/left/series is missing")) << "the group it belongs to";
  EXPECT_EQ(6, lines.lineOf("~linear/x/max_velocity is 0.5"));
  EXPECT_EQ(0, lines.lineOf("right_wheel is missing"));
  EXPECT_THAT(lines.keysTwice(), IsEmpty());
}

TEST_F(KeyLinesTest, OfSeveralFilesALineWouldMislead) {
  const std::string file = write("bus: {device: /dev/ttyUSB0}\n");
  EXPECT_EQ(0, KeyLines({file, file}).lineOf("bus/device: ..."));
}

TEST_F(KeyLinesTest, NamesAKeyThatIsThereTwice) {
  const KeyLines lines({write("drives:\n  left: {address: 3}\n  left: {address: 4}\n")});
  EXPECT_THAT(lines.keysTwice(), ElementsAre(HasSubstr("drives/left is there twice, the second time in line 3")));
}

// Of two merge keys each counts; and what is merged is not there twice.
TEST_F(KeyLinesTest, MergeKeysAreNotThereTwice) {
  const KeyLines lines({write("a: &a {x: 1}\nb: &b {y: 1, y: 2}\nc: {<<: *a, <<: *b}\n")});
  EXPECT_THAT(lines.keysTwice(), ElementsAre(HasSubstr("b/y is there twice")));
}

}  // namespace
}  // namespace nord_driver::tools
