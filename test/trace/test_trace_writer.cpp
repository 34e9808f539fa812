#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "trace/trace_fixture.h"
#include "trace/trace_writer.h"

namespace nord_driver::trace {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class TraceWriterTest : public TraceTest {
 protected:
  std::string hexOf(const std::string& name) const {
    const std::string bytes = read(name);
    return toHex(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
  }

  TelegramTrace trace_{kLinkTypeProfibusDl, nullptr};
};

// Names carry the time and the cause; the message is the path.
TEST_F(TraceWriterTest, WritesATextAndAPcap) {
  cycle(1000, 0x0B37, 0x0B37);
  TraceWriter traces{{directory_, 20}, drives(), &trace_, feed_.history()};
  const TraceResult result = traces.write({"fault_left", {"because"}, at(1234), 0}, clockAt(1500));
  EXPECT_TRUE(result.written);
  EXPECT_EQ(directory_ + "/nord_driver_20231114T221321.234Z_fault_left.txt", result.message);
  EXPECT_EQ("", result.warning);
  EXPECT_THAT(files(), ElementsAre("nord_driver_20231114T221321.234Z_fault_left.pcap",
                                   "nord_driver_20231114T221321.234Z_fault_left.txt"));
  EXPECT_THAT(read(files()[1]), HasSubstr("\nreason: because\n"));
  EXPECT_THAT(read(files()[1]), HasSubstr(" 047F 2000 0000 0000  0B37 2000 0000 0000\n"));
}

// The pcap byte for byte: 24 bytes of header with link type 257 (0101h), 16 per packet, every telegram once, in both
// directions, and no byte that was no telegram.
TEST_F(TraceWriterTest, ThePcapHoldsTheTelegramsAndNoNoise) {
  trace_.record(TraceKind::kSent, fromHex("10 03 01 49 4D 16"), at(0));
  trace_.record(TraceKind::kNoise, fromHex("00 FF"), at(1));
  trace_.record(TraceKind::kReceived, fromHex("E5"), at(2));
  TraceWriter traces{{directory_, 20}, drives(), &trace_, feed_.history()};
  traces.write({"request", {}, at(0), 0}, clockAt(10));
  ASSERT_EQ(2u, files().size());
  EXPECT_EQ(
      "D4 C3 B2 A1 02 00 04 00 00 00 00 00 00 00 00 00 FF FF 00 00 01 01 00 00 "
      "00 F1 53 65 00 00 00 00 06 00 00 00 06 00 00 00 10 03 01 49 4D 16 "
      "00 F1 53 65 D0 07 00 00 01 00 00 00 01 00 00 00 E5",
      hexOf(files()[0]));
}

// Two of the same millisecond do not overwrite each other.
TEST_F(TraceWriterTest, NeverOverwrites) {
  TraceWriter traces{{directory_, 20}, drives(), &trace_, feed_.history()};
  traces.writeNow(clockAt(5));
  traces.writeNow(clockAt(5));
  EXPECT_THAT(
      files(),
      ElementsAre("nord_driver_20231114T221320.005Z_request.pcap", "nord_driver_20231114T221320.005Z_request.txt",
                  "nord_driver_20231114T221320.006Z_request.pcap", "nord_driver_20231114T221320.006Z_request.txt"));
}

// The oldest of our own go when there are too many; what somebody else put there stays.
TEST_F(TraceWriterTest, KeepsTheNewest) {
  std::ofstream{directory_ + "/nord_driver_notes.txt"} << "mine";
  TraceWriter traces{{directory_, 2}, drives(), &trace_, feed_.history()};
  for (int second = 0; second < 4; ++second) EXPECT_TRUE(traces.writeNow(clockAt(1000 * second)).written);
  EXPECT_THAT(files(), ElementsAre("nord_driver_20231114T221322.000Z_request.pcap",
                                   "nord_driver_20231114T221322.000Z_request.txt",
                                   "nord_driver_20231114T221323.000Z_request.pcap",
                                   "nord_driver_20231114T221323.000Z_request.txt", "nord_driver_notes.txt"));
}

// A clock that was set back names it before all others: it is the newest all the same.
// Else each new one would be the oldest but one, and removed by the next.
TEST_F(TraceWriterTest, ThoseFromBeforeTheClockWasSetBackAreTheOldest) {
  TraceWriter traces{{directory_, 2}, drives(), &trace_, feed_.history()};
  for (const char* second : {"0", "1", "2"}) {
    std::ofstream(directory_ + "/nord_driver_20990101T00000" + second + ".000Z_fault_left.txt") << "x";
  }
  for (int second = 0; second < 2; ++second) EXPECT_TRUE(traces.writeNow(clockAt(1000 * second)).written);
  EXPECT_THAT(files(), ::testing::Each(HasSubstr("_2023")));
  EXPECT_EQ(4u, files().size()) << "a text and a pcap each";
}

// A fault is named by its own time and written 200 ms later: what was asked for in between bears a later name, and no clock
// was set back.
TEST_F(TraceWriterTest, AFaultThatIsWrittenLaterRemovesNoneOfTheNewest) {
  TraceWriter traces{{directory_, 3}, drives(), nullptr, feed_.history()};
  for (const int second : {1, 2, 3}) EXPECT_TRUE(traces.writeNow(clockAt(1000 * second)).written);
  EXPECT_TRUE(traces.writeNow(clockAt(10'100)).written);
  EXPECT_TRUE(traces.write({"fault_left", {}, at(10'000), 0}, clockAt(10'200)).written);
  EXPECT_THAT(files(), ElementsAre("nord_driver_20231114T221323.000Z_request.txt",
                                   "nord_driver_20231114T221330.000Z_fault_left.txt",
                                   "nord_driver_20231114T221330.100Z_request.txt"));
}

// Who asked first may write last: the one that is there has a later time than the clock that was read for this one.
TEST_F(TraceWriterTest, TwoThatAreWrittenInTheOtherOrderRemoveNoneOfTheNewest) {
  TraceWriter traces{{directory_, 2}, drives(), nullptr, feed_.history()};
  for (const int milliseconds : {1000, 10'100, 10'000}) EXPECT_TRUE(traces.writeNow(clockAt(milliseconds)).written);
  EXPECT_THAT(files(), ElementsAre("nord_driver_20231114T221330.000Z_request.txt",
                                   "nord_driver_20231114T221330.100Z_request.txt"));
}

TEST_F(TraceWriterTest, KeepsTheOneThatWasJustWritten) {
  TraceWriter traces{{directory_, 2}, drives(), &trace_, feed_.history()};
  for (const int second : {5, 6, 0}) {
    const TraceResult result = traces.writeNow(clockAt(1000 * second));
    ASSERT_TRUE(result.written);
    EXPECT_TRUE(std::ifstream(result.message).is_open()) << result.message;
  }
  EXPECT_EQ(4u, files().size());
}

// A directory that is not there, or is a file, is named at once and at every attempt in the same words.
TEST_F(TraceWriterTest, NamesAMissingDirectory) {
  const std::string missing = directory_ + "/missing";
  TraceWriter traces{{missing, 2}, drives(), &trace_, feed_.history()};
  EXPECT_EQ("no trace can be written: trace_directory " + missing + " is no directory", traces.whyNotWritable());
  const TraceResult result = traces.writeNow(clockAt(0));
  EXPECT_FALSE(result.written);
  EXPECT_EQ(traces.whyNotWritable(), result.message);
}

// Nobody, not even root, can create a file in /proc.
TEST_F(TraceWriterTest, NamesADirectoryThatCannotBeWritten) {
  TraceWriter traces{{"/proc", 2}, drives(), &trace_, feed_.history()};
  const TraceResult first = traces.writeNow(clockAt(0)), second = traces.writeNow(clockAt(1000));
  EXPECT_FALSE(first.written);
  EXPECT_THAT(first.message, StartsWith("no trace can be written: trace_directory /proc: "));
  EXPECT_EQ(first.message, second.message);
}

// A disk that is full behind the pcap (here: a limit of file size) leaves no half of a trace.
TEST_F(TraceWriterTest, LeavesNoHalfOfATrace) {
  for (int i = 0; i < 5000; ++i) trace_.record(TraceKind::kReceived, fromHex("E5"), at(i));
  signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 100'000;  // enough for the pcap, not for the text
  setrlimit(RLIMIT_FSIZE, &small);
  TraceWriter traces{{directory_, 2}, drives(), &trace_, feed_.history()};
  const TraceResult result = traces.writeNow(clockAt(0));
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_FALSE(result.written);
  EXPECT_THAT(result.message, EndsWith(directory_ + ": File too large"));
  EXPECT_THAT(files(), IsEmpty());
}

// Whoever looks into the folder while a trace is written, or after the program was killed then (here: by the signal of a
// limit of file size), finds no file that looks whole and is not.
TEST_F(TraceWriterTest, AKilledProgramLeavesNoTraceThatLooksWhole) {
  for (int i = 0; i < 5000; ++i) trace_.record(TraceKind::kReceived, fromHex("E5"), at(i));
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    signal(SIGXFSZ, SIG_DFL);
    const rlimit small{100'000, 100'000};  // enough for the pcap, not for the text
    setrlimit(RLIMIT_FSIZE, &small);
    TraceWriter traces{{directory_, 2}, drives(), &trace_, feed_.history()};
    static_cast<void>(traces.writeNow(clockAt(0)));
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(child, ::waitpid(child, &status, 0));
  ASSERT_TRUE(WIFSIGNALED(status));
  for (const std::string& file : files()) EXPECT_THAT(file, ::testing::Not(EndsWith(".txt")));
  // What is left does not stay for ever, and is in nobody's way.
  TraceWriter traces{{directory_, 1}, drives(), &trace_, feed_.history()};
  EXPECT_TRUE(traces.writeNow(clockAt(0)).written);
  EXPECT_TRUE(traces.writeNow(clockAt(5000)).written);
  EXPECT_EQ(2u, files().size());
}

}  // namespace
}  // namespace nord_driver::trace
