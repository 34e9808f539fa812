// A recording of DeviceNet as others read it: tshark must know every frame, whatever our own decoder thinks of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "system/devicenet_robot.h"
#include "system/recording.h"

namespace nord_driver::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::Not;
using ::testing::UnorderedElementsAreArray;

/// Start-up, a drive, a parameter, a fault, an acknowledgement, a module that comes back, the clean end.
void live(DevicenetRobot& robot) {
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(0.3, 0.2, std::chrono::seconds{2});
  cycle::Request read;
  read.kind = cycle::RequestKind::kReadParameter;
  read.drive = 0;
  read.parameter.number = 999;  // refused
  robot.ask(read);
  robot.unit(1).inverter().trip(30, false);
  robot.run(std::chrono::seconds{2});
  robot.ask(cycle::RequestKind::kAcknowledge, 1);
  robot.module(1).setPowered(false);
  robot.run(std::chrono::seconds{1});
  robot.module(1).setPowered(true);
  EXPECT_TRUE(robot.runUntil([&] { return robot.online(1); }, std::chrono::seconds{6}));
  robot.transport().close();
}

/// `kinds`: what tshark must have named.
void expectKnown(const DevicenetRobot::Options& options, const std::vector<std::string>& kinds) {
  if (!isTsharkThere()) GTEST_SKIP() << "tshark is not installed";
  DevicenetRobot robot{options};
  live(robot);
  const TelegramTrace& trace = *robot.transport().trace();
  ASSERT_LT(trace.recorded(), TelegramTrace::kCapacity) << "the start-up is still in it";
  const std::vector<std::string> lines = Recording{trace}.decodedBy("devicenet");
  ASSERT_EQ(trace.recorded(), lines.size());
  std::set<std::string> named;
  for (const std::string& line : lines) {
    ASSERT_EQ(0u, line.rfind("DeviceNet", 0)) << line;
    ASSERT_THAT(line, Not(ContainsRegex("[Mm]alformed|[Uu]nknown|[Ii]llegal|[Ww]rong|[Ii]nvalid"))) << line;
    named.insert(line.substr(line.rfind('\t') + 1));
  }
  EXPECT_THAT(named, UnorderedElementsAreArray(kinds));
}

// The names of DeviceNet's connection set, as tshark has them.
constexpr const char* kDuplicateMac = "Duplicate MAC ID Check Messages";
constexpr const char* kUnconnected = "Group 2 Only Unconnected Explicit Request Messages";
constexpr const char* kRequest = "Master's Explicit Request Messages";
constexpr const char* kResponse = "Slave's Explicit/Unconnected Response Messages";
constexpr const char* kOutputs = "Master's I/O Poll Command/COS/Cyclic Messages";
constexpr const char* kInputs = "Slave's I/O Poll Response or COS/Cyclic Ack Message";

TEST(DevicenetTrace, TsharkKnowsEveryFrameOfADrive) {
  expectKnown({}, {kDuplicateMac, kUnconnected, kRequest, kResponse, kOutputs, kInputs});
}

TEST(DevicenetTrace, TsharkKnowsChangeOfState) {
  DevicenetRobot::Options options;
  options.assembly = 101;
  options.drives = {{"io", std::string{"cos"}}};
  expectKnown(options, {kDuplicateMac, kUnconnected, kRequest, kResponse, kOutputs, kInputs,
                        "Slave's I/O Change of State or Cyclic Message",
                        "Master's Change of State or Cyclic Acknowledge Message"});
}

// Our own words beside each frame: none is a stranger's.
TEST(DevicenetTrace, EveryFrameHasItsWords) {
  DevicenetRobot robot;
  live(robot);
  const TelegramTrace& trace = *robot.transport().trace();
  std::map<std::string, int> kinds;
  for (const TraceRecord& record : trace.copy()) {
    const std::string text = trace.describe(record);
    EXPECT_THAT(text, Not(ContainsRegex("no device of ours|wrong length|no frame|too short|remote frame|29 bit")))
        << trace.raw(record);
    ++kinds[text.substr(0, text.find(' '))];
    EXPECT_EQ('#', trace.raw(record)[3]) << "as candump writes it";
  }
  for (const char* kind : {"poll", "answer", "explicit", "is"}) EXPECT_GT(kinds[kind], 0) << kind;
}

}  // namespace
}  // namespace nord_driver::test
