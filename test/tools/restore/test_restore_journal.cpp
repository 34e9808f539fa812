// The journal of a restore: read as it was written, whole or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tools/restore/restore_journal.h"
#include "tools/restore/scripted_drive.h"

namespace nord_driver::tools {
namespace {

using ::testing::HasSubstr;

RestoreRecord record() {
  RestoreRecord made;
  made.drive = "left";
  made.address = "PROFIBUS station 3";
  made.file = "/tmp/a \"dump\": of left.yaml";
  made.persistent = true;
  made.state = RestoreState::kTakingBack;
  made.why = "P105 set 1: refused";
  made.eeprom_switch = 1;
  RestoreRecord::Change change;
  change.address = parseParameterName("P546[-02] set 3");
  change.before = -1;
  change.after = 50'000'000;
  change.state = ChangeState::kBegun;
  made.changes = {change};
  made.same = {{parseParameterName("P513"), -1}};
  return made;
}

/// A folder of this test, gone with it.
class RestoreJournalTest : public ::testing::Test {
 protected:
  ~RestoreJournalTest() override { std::filesystem::remove_all(folder_); }

  const std::string folder_ = ::testing::TempDir() + "nord_journal_" + std::to_string(::getpid());
  const RestoreJournal journal_{folder_ + "/restore/left.journal"};
};

TEST_F(RestoreJournalTest, IsReadAsItWasWritten) {
  EXPECT_FALSE(journal_.read());
  journal_.write(record());
  const auto read = journal_.read();
  ASSERT_TRUE(read);
  EXPECT_EQ(recordText(record()), recordText(*read));
  EXPECT_EQ("/tmp/a \"dump\": of left.yaml", read->file);
  EXPECT_TRUE(read->persistent);
  EXPECT_EQ(RestoreState::kTakingBack, read->state);
  EXPECT_EQ("P105 set 1: refused", read->why);
  EXPECT_EQ(1, read->eeprom_switch.value_or(-1));
  ASSERT_EQ(1u, read->changes.size());
  EXPECT_EQ("P546[-02] set 3", parameterName(read->changes[0].address));
  EXPECT_EQ(-1, read->changes[0].before);
  EXPECT_EQ(50'000'000, read->changes[0].after);
  EXPECT_EQ(ChangeState::kBegun, read->changes[0].state);
  ASSERT_EQ(1u, read->same.size());
  EXPECT_EQ(-1, read->same[0].raw);
}

// A program that is killed while it writes leaves the file beside it, and the one before as it was.
TEST_F(RestoreJournalTest, IsReplacedAsAWhole) {
  journal_.write(record());
  std::ofstream(journal_.path() + ".new") << "drive: le";
  EXPECT_EQ(recordText(record()), recordText(*journal_.read()));
  journal_.write(record());
  EXPECT_FALSE(std::filesystem::exists(journal_.path() + ".new"));
}

TEST_F(RestoreJournalTest, ThatCannotBeWrittenIsTrouble) {
  std::filesystem::create_directories(folder_);
  std::ofstream(folder_ + "/restore") << "a file where the folder belongs";
  try {
    journal_.write(record());
    FAIL() << "written";
  } catch (const Trouble& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("cannot be opened (Not a directory); nothing is written to the drive without this journal"));
  }
}

TEST_F(RestoreJournalTest, ThatIsBrokenIsNamed) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      recordFrom(text, "a.journal");
    } catch (const UsageError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal("drive: left\n"), HasSubstr("a.journal is no journal of nord_param restore"));
  std::string text = recordText(record());
  text.replace(text.find("taking back"), 11, "resting");
  EXPECT_THAT(refusal(text), HasSubstr("state \"resting\" is not known, expected one of writing, taking back, done"));
}

TEST(JournalPath, IsInTheFolderOfRos) {
  EXPECT_EQ("/ros/nord_driver/restore/left.journal", journalPath("/ros", "/home/a", "left"));
  EXPECT_EQ("/home/a/.ros/nord_driver/restore/left.journal", journalPath(nullptr, "/home/a", "left"));
  EXPECT_EQ("/home/a/.ros/nord_driver/restore/left.journal", journalPath("", "/home/a", "left"));
  EXPECT_THROW(journalPath(nullptr, nullptr, "left"), UsageError);
}

}  // namespace
}  // namespace nord_driver::tools
