// compare and restore as a technician runs them, against simulated drives on a pty.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <memory>

#include "tools/param_on_pty.h"
#include "tools/program.h"

namespace nord_driver::test {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class NordParamRestore : public ParamOnPty {};

// Two drives, two files, and one of each; a name of both is the drive's.
TEST_F(NordParamRestore, ComparesInAnyPair) {
  const std::string left = config_ + "_left.yaml", right = config_ + "_right.yaml";
  std::ofstream(left) << "series: sk5xxe\nsettings: {\"P102 set 1\": {raw: 200}, \"P513\": {raw: 0}}\n";
  std::ofstream(right) << "series: sk5xxe\nsettings: {\"P102 set 1\": {raw: 250}}\n";
  const std::string found = "P102 set 1 Acceleration time: 2.00 s in " + left + ", 2.50 s in " + right +
                            "\nP513 Telegram timeout: 0.0 s Off in " + left + ", not in " + right +
                            "\n2 of 2 settings differ\n";
  const Ended files = runProgram({NORD_PARAM_PROGRAM, "diff", left, right});
  EXPECT_EQ(1, files.code) << files.errors;
  EXPECT_EQ(found, files.output) << "without a configuration";
  const Ended json = run({"compare", left, right, "--json"});
  EXPECT_THAT(json.output, HasSubstr("\"compared\": 2, \"differences\": [{\"parameter\": \"P102 set 1\""));
  const Ended drives = run({"compare", "left", "right"});
  EXPECT_EQ(1, drives.code) << drives.errors;
  EXPECT_THAT(drives.output, HasSubstr("P508 PROFIBUS address: 3 in left, 4 in right\n"));
  EXPECT_THAT(drives.errors, IsEmpty());
  const Ended neither = run({"compare", "left", "middle"});
  EXPECT_EQ(2, neither.code);
  EXPECT_THAT(neither.errors,
              HasSubstr("\"middle\" is neither a drive of the configuration nor a file, expected left, "));
  EXPECT_EQ(2, run({"compare", "left", "left"}).code);
  std::ofstream(right) << "series: sk5xxe\nsettings:\n";
  const Ended nothing = runProgram({NORD_PARAM_PROGRAM, "diff", right, right});
  EXPECT_EQ("0 of 0 settings differ\n", nothing.output);
  EXPECT_EQ(1, nothing.code) << "what compared nothing has not shown that they are alike";
  ::unlink(left.c_str());
  ::unlink(right.c_str());
}

// Without --yes nobody writes anything where nobody can be asked.
TEST_F(NordParamRestore, Restores) {
  const std::string file = config_ + "_restore.yaml", journal = config_ + "_journal";
  std::ofstream(file) << "series: sk5xxe\nsettings: {\"P426 set 1\": {raw: 20}, \"P426 set 2\": {raw: 30}, "
                         "\"P508\": {raw: 9}}\n";
  const std::vector<std::string> restore{"restore", "right", file, "--journal", journal};
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const Ended planned = run(with(restore, {"--dry-run"}));
  EXPECT_EQ(0, planned.code) << planned.errors;
  EXPECT_THAT(planned.output,
              HasSubstr("  P426 set 1 Quick stop time  10  ->  20\n  P426 set 2 Quick stop time  10  ->  30"
                        "\nleft out:\n  P508 PROFIBUS address: 4 in the drive, 9 in the file ("));
  const Ended restored = run(with(restore, {"--yes", "--json"}));
  EXPECT_EQ(0, restored.code) << restored.errors;
  EXPECT_THAT(restored.output, HasSubstr("\"state\": \"done\""));
  EXPECT_THAT(restored.output, HasSubstr("\"state\": \"written\""));
  EXPECT_THAT(run({"read", "right", "P426 set 2"}).output, HasSubstr("(raw 30)"));
  // The journal of a drive of the same name on another bus.
  std::ifstream of_right(journal);
  std::string text{std::istreambuf_iterator<char>(of_right), {}};
  const std::size_t station = text.find("PROFIBUS station 4");
  ASSERT_NE(std::string::npos, station) << text;
  std::ofstream(journal + ".other") << text.replace(station, 18, "PROFIBUS station 9");
  const Ended elsewhere = run({"restore", "right", "--take-back", "--yes", "--journal", journal + ".other"});
  EXPECT_EQ(1, elsewhere.code);
  EXPECT_THAT(elsewhere.errors,
              HasSubstr("is of PROFIBUS station 9, and drive right is PROFIBUS station 4 here: nothing was written"));
  ::unlink((journal + ".other").c_str());
  const Ended taken_back = run({"restore", "right", "--take-back", "--yes", "--journal", journal});
  EXPECT_EQ(0, taken_back.code) << taken_back.errors;
  EXPECT_EQ("taken back: drive right has what it had before\n", taken_back.output);
  EXPECT_THAT(run({"read", "right", "P426 set 2"}).output, HasSubstr("(raw 10)"));
  EXPECT_EQ(1, run({"restore", "right", "--resume", "--yes", "--journal", journal}).code);
  EXPECT_EQ(2, run({"restore", "right", file, "--resume", "--yes"}).code);
  EXPECT_EQ(2, run({"restore", "right", "--yes"}).code) << "no file";
  std::ofstream(file) << "series: sk5xxe\nsettings:\n";
  const Ended nothing = run(with(restore, {"--yes"}));
  EXPECT_EQ(2, nothing.code) << "cut off, by a version that did not count";
  EXPECT_THAT(nothing.errors, HasSubstr(file + " has no settings, expected at least one to restore"));
  ::unlink(file.c_str());
  ::unlink(journal.c_str());
}

// Another one would replace the journal of the restore that waits for its answer, or take it for broken off.
TEST_F(NordParamRestore, BeginsNothingWhileAnotherRestoreRuns) {
  const std::string file = config_ + "_held.yaml", journal = config_ + "_held_journal";
  std::ofstream(file) << "series: sk5xxe\nsettings: {\"P426 set 3\": {raw: 25}}\n";
  ASSERT_EQ(0, run({"restore", "right", file, "--yes", "--journal", journal}).code);
  const auto noted = [&journal] {
    std::ifstream kept(journal);
    return std::string{std::istreambuf_iterator<char>(kept), {}};
  };
  const std::string before = noted();
  const int held = ::open((journal + ".run").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_GE(held, 0) << "it stays where it was made";
  ASSERT_EQ(0, ::flock(held, LOCK_EX | LOCK_NB));
  std::ofstream(file) << "series: sk5xxe\nsettings: {\"P426 set 3\": {raw: 35}}\n";
  for (const std::string& word : {file, std::string("--resume"), std::string("--take-back")}) {
    const Ended second = run({"restore", "right", word, "--yes", "--journal", journal});
    EXPECT_EQ(1, second.code) << word;
    EXPECT_THAT(second.errors, HasSubstr("another nord_param (process " + std::to_string(::getpid()) +
                                         ") restores drive right now: nothing was written"))
        << word;
    EXPECT_EQ(before, noted()) << word;
  }
  EXPECT_EQ(0, run({"restore", "right", file, "--dry-run", "--journal", journal}).code) << "it only reads";
  EXPECT_THAT(run({"read", "right", "P426 set 3"}).output, HasSubstr("(raw 25)"));
  ::close(held);
  EXPECT_EQ(0, run({"restore", "right", "--take-back", "--yes", "--journal", journal}).code);
  for (const std::string& made : {file, journal, journal + ".run"}) ::unlink(made.c_str());
}

// A dump is somebody's only copy of a drive: on a disk that is full it has not been made.
TEST_F(NordParamRestore, ADumpThatCouldNotBePrintedIsAFailure) {
  const std::string dump =
      std::string(NORD_PARAM_PROGRAM) + " --config " + config_ + " --device " + device_ + " dump right";
  const Ended full = runProgram({"/bin/sh", "-c", dump + " >/dev/full"});
  EXPECT_EQ(1, full.code);
  EXPECT_THAT(full.errors, HasSubstr("not all of it could be printed"));
}

// Whoever reads may go: the program ends, and in order.
TEST_F(NordParamRestore, WatchEndsWithWhoeverReadsIt) {
  const std::string watch =
      std::string(NORD_PARAM_PROGRAM) + " --config " + config_ + " --device " + device_ + " watch right --json";
  const Ended read = runProgram({"/bin/sh", "-c", watch + " | head -n 1"});
  EXPECT_EQ(0, read.code) << "of head";
  EXPECT_THAT(read.output, HasSubstr("{"));
  EXPECT_EQ(0, run({"read", "right", "P102"}).code) << "the bus is free again";
}

// Killed in the middle of its work, whenever: the journal says where it was, and the next run ends it.
TEST_F(NordParamRestore, GoesOnWithARestoreThatWasKilled) {
  const std::string dump = config_ + "_killed.yaml", journal = config_ + "_killed_journal";
  ASSERT_EQ(0, run({"dump", "right", "--json"}).code);
  std::ofstream(dump) << run({"dump", "right"}).output;
  std::ofstream other(dump + ".other");
  other << "series: sk5xxe\nsettings:\n";
  for (int set = 1; set <= 4; ++set) {
    for (const int number : {102, 103, 426, 543, 544, 545}) {
      other << "  \"P" << number << " set " << set << "\": {raw: " << 11 << "}\n";
    }
  }
  other.close();
  {
    Program killed{{NORD_PARAM_PROGRAM, "--config", config_, "--device", device_, "restore", "right", dump + ".other",
                    "--yes", "--journal", journal}};
    const auto end = std::chrono::steady_clock::now() + seconds{30};
    const auto written = [&journal] {
      std::ifstream file(journal);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      return text.find("state: written") != std::string::npos;
    };
    while (!written() && std::chrono::steady_clock::now() < end) ::usleep(1000);
    killed.signal(SIGKILL);
    EXPECT_EQ(-1, killed.wait(seconds{30}));
  }
  const Ended again = run({"restore", "right", dump, "--yes", "--journal", journal});
  EXPECT_EQ(1, again.code);
  EXPECT_THAT(again.errors,
              HasSubstr("was broken off: --resume goes on with it, --take-back puts back what was there"));
  const Ended resumed = run({"restore", "right", "--resume", "--yes", "--journal", journal});
  EXPECT_EQ(0, resumed.code) << resumed.errors;
  EXPECT_THAT(resumed.output, HasSubstr("24 written and read back, 24 verified"));
  EXPECT_EQ(0, run({"compare", "right", dump + ".other"}).code);
  EXPECT_EQ(0, run({"restore", "right", dump, "--yes", "--journal", journal}).code);
  EXPECT_EQ(0, run({"compare", "right", dump}).code);
  for (const std::string& file : {dump, dump + ".other", journal}) ::unlink(file.c_str());
}

}  // namespace
}  // namespace nord_driver::test
