// A recording of the bus as others read it: tshark must know every frame, whatever our own decoder thinks of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "system/can_robot.h"
#include "system/recording.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

/// Start-up, a drive, a parameter, a fault, an acknowledgement, the clean end.
void live(CanRobot& robot) {
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(0.3, 0.2, std::chrono::seconds{2});
  cycle::Request read;
  read.kind = cycle::RequestKind::kReadParameter;
  read.drive = 0;
  read.parameter.number = 999;  // an abort
  robot.ask(read);
  robot.unit(1).inverter().trip(30, false);
  robot.run(std::chrono::seconds{2});
  robot.ask(cycle::RequestKind::kAcknowledge, 1);
  robot.transport().close();
}

void expectKnown(const CanRobot::Options& options) {
  if (!isTsharkThere()) GTEST_SKIP() << "tshark is not installed";
  CanRobot robot{options};
  live(robot);
  const TelegramTrace& trace = *robot.transport().trace();
  ASSERT_LT(trace.recorded(), TelegramTrace::kCapacity) << "the start-up is still in it";
  const std::vector<std::string> lines = Recording{trace}.decodedBy("canopen");
  ASSERT_EQ(trace.recorded(), lines.size());
  for (const std::string& line : lines) {
    // tshark hands no remote frame on: guarding's questions stay "CAN".
    const bool question = line.find("Remote Transmission Request") != std::string::npos;
    ASSERT_EQ(question ? 0u : line.size(), line.rfind("CANopen", 0) == 0 ? line.size() : 0u) << line;
    ASSERT_THAT(line, Not(ContainsRegex("[Mm]alformed|[Uu]nknown|[Ii]llegal|[Ww]rong")));
  }
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  for (const char* kind : {"NMT", "PDO", "SDO", "EMCY", "Boot-up"}) EXPECT_THAT(all, HasSubstr(kind));
}

TEST(CanopenTrace, TsharkKnowsEveryFrameOfADrive) {
  expectKnown({});
}

TEST(CanopenTrace, TsharkKnowsEveryFrameWithSyncAndHeartbeats) {
  CanRobot::Options options;
  options.bus = {{"sync", true}, {"heartbeat", 0.1}};
  options.drives = {{"error_control", std::string{"heartbeat"}}};
  expectKnown(options);
}

// Our own words beside each frame: none is a stranger's.
TEST(CanopenTrace, EveryFrameHasItsWords) {
  CanRobot robot;
  live(robot);
  const TelegramTrace& trace = *robot.transport().trace();
  std::map<std::string, int> kinds;
  for (const TraceRecord& record : trace.copy()) {
    const std::string text = trace.describe(record);
    EXPECT_THAT(text, Not(ContainsRegex("no node of ours|wrong length|no frame|too short|remote frame|29 bit")))
        << trace.raw(record);
    ++kinds[text.substr(0, text.find(' '))];
    EXPECT_EQ('#', trace.raw(record)[3]) << "as candump writes it";
  }
  for (const char* kind : {"NMT", "RPDO", "TPDO", "SDO", "EMCY", "guarding", "node"}) EXPECT_GT(kinds[kind], 0) << kind;
}

}  // namespace
}  // namespace nord_driver::test
