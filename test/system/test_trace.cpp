// A fault of a simulated drive becomes a page: what the drives were sent and answered before it, and every telegram.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "system/simulated_robot.h"
#include "trace/fault_tracer.h"
#include "trace/trace_feed.h"
#include "trace/trace_writer.h"

namespace nord_driver::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::uint16_t kOvercurrent = 40;  // E4.0

class TraceOfARobot : public ::testing::Test {
 protected:
  TraceOfARobot() {
    char name[] = "/tmp/nord_driver_system_trace.XXXXXX";
    directory_ = mkdtemp(name);
    robot_.ports().setObserver(&feed_);
  }
  ~TraceOfARobot() override { std::filesystem::remove_all(directory_); }

  trace::TraceClock clock() {
    const Instant now = robot_.transport().now();
    return {now, std::chrono::system_clock::time_point{std::chrono::seconds{1'700'000'000}}};
  }
  /// Drives on for `span` and returns what was written meanwhile.
  std::vector<trace::TraceResult> drive(trace::FaultTracer& tracer, Duration span) {
    std::vector<trace::TraceResult> results;
    const Instant end = robot_.transport().now() + span;
    while (robot_.transport().now() < end) {
      robot_.drive(kHalfSpeed, 0.0, std::chrono::milliseconds{10});
      if (const auto result = tracer.poll(clock())) results.push_back(*result);
    }
    return results;
  }
  static std::string read(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, {}};
  }
  static std::vector<std::string> linesOf(const std::string& text) {
    std::istringstream stream{text};
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }

  std::string directory_;
  SimulatedRobot robot_;
  trace::TraceFeed feed_{2};
};

// One fault, one trace, with the 32 cycles before it and the telegrams on both sides of it.
TEST_F(TraceOfARobot, AFaultIsWrittenWithItsPast) {
  ASSERT_TRUE(robot_.bringUpAndEnable());
  trace::TraceWriter writer{
      {directory_, 20},
      {{"left", robot_.transport().identity(0).address}, {"right", robot_.transport().identity(1).address}},
      robot_.transport().trace(),
      feed_.history()};
  trace::FaultTracer tracer{feed_, writer};
  EXPECT_TRUE(drive(tracer, std::chrono::seconds{4}).empty());

  robot_.unit(0).inverter().trip(kOvercurrent, false);
  const auto results = drive(tracer, std::chrono::seconds{2});
  ASSERT_EQ(1u, results.size());
  ASSERT_TRUE(results[0].written) << results[0].message;
  EXPECT_THAT(results[0].message, EndsWith("Z_fault_left.txt"));

  const std::vector<std::string> lines = linesOf(read(results[0].message));
  EXPECT_THAT(lines[1], StartsWith("reason: drive left stopped: a fault "));
  std::size_t at = 0;
  while (at < lines.size() && lines[at].find("  drive  STW") == std::string::npos) ++at;
  ASSERT_LT(at + 66, lines.size());
  // 32 cycles of two drives, running at half speed, then the cycle in which the left one has its fault: bit 3.
  const std::vector<std::string> table(lines.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                                       lines.begin() + static_cast<std::ptrdiff_t>(at) + 67);
  for (std::size_t i = 0; i < 64; i += 2) {
    EXPECT_THAT(table[i], HasSubstr("  left   047F 2000 0000 0000  0B37 2000 "));
    EXPECT_THAT(table[i + 1], HasSubstr("  right  047F E000 0000 0000  1337 E000 "));
  }
  EXPECT_THAT(table[62], StartsWith("     -0.010"));
  EXPECT_THAT(table[64], StartsWith("      0.000000  left   047F 2000 0000 0000  "));
  EXPECT_THAT(lines[at + 67], "");

  // Telegrams before it ("DX ... 047F") and after it: the left drive is sent the idle word, the right one setpoint 0.
  const std::string text = read(results[0].message);
  const std::size_t telegrams = text.find("\ntelegrams, ");
  ASSERT_NE(std::string::npos, telegrams);
  const std::size_t fault = text.find("ZSW " + table[64].substr(table[64].size() - 19, 4), telegrams);
  ASSERT_NE(std::string::npos, fault);
  EXPECT_LT(text.find("DX 3 <- 1 STW 047F SW1 2000", telegrams), fault);
  EXPECT_NE(std::string::npos, text.find("DX 3 <- 1 STW 047E SW1 0000", fault));
  EXPECT_NE(std::string::npos, text.find("DX 4 <- 1 STW 047F SW1 0000", fault));
  EXPECT_NE(std::string::npos, text.find("Set_Prm 3 <- 1", telegrams));  // the start-up is in the ring, too
}

// A program that shares nothing with us, libpcap's tcpdump, finds the link type and as many packets as the text has
// telegrams. (Wireshark 4.0 and its capinfos refuse link type 257.)
TEST_F(TraceOfARobot, TcpdumpReadsThePcap) {
  if (std::system("tcpdump --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "tcpdump is not installed";
  ASSERT_TRUE(robot_.bringUp());
  trace::TraceWriter writer{
      {directory_, 20}, {{"left", ""}, {"right", ""}}, robot_.transport().trace(), feed_.history()};
  std::string path = writer.writeNow(clock()).message;
  path.replace(path.size() - 3, 3, "pcap");
  std::string said;
  FILE* tcpdump = popen(("tcpdump --count -r " + path + " 2>&1").c_str(), "r");
  ASSERT_NE(nullptr, tcpdump);
  for (int c = std::fgetc(tcpdump); c != EOF; c = std::fgetc(tcpdump)) said += static_cast<char>(c);
  EXPECT_EQ(0, pclose(tcpdump));
  EXPECT_THAT(said, HasSubstr("link-type PROFIBUS_DL"));
  EXPECT_THAT(said, HasSubstr("\n" + std::to_string(robot_.transport().trace()->recorded()) + " packets\n"));
}

// A transport's trace is what went over the line: every telegram sent and received, the unanswered calls too.
TEST_F(TraceOfARobot, HoldsEveryTelegramTheCountersCount) {
  robot_.unit(1).setPlugged(false);
  robot_.run(std::chrono::seconds{1});
  std::uint64_t sent = 0, received = 0;
  for (const TraceRecord& record : robot_.transport().trace()->copy()) {
    ++(record.kind == TraceKind::kSent ? sent : received);
  }
  EXPECT_GT(robot_.transport().counters().value(bus_counter::kTimeouts), 0u);
  EXPECT_EQ(robot_.transport().counters().value(bus_counter::kTelegramsSent), sent);
  EXPECT_EQ(robot_.transport().counters().value(bus_counter::kTelegramsReceived), received);
}

}  // namespace
}  // namespace nord_driver::test
