// Start-up, drive, parameter write and fault of one drive on DeviceNet as literal frames: those of doc/devicenet.md, which
// this test reads.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/can_trace.h"
#include "system/devicenet_robot.h"

namespace nord_driver::test {
namespace {

using Lines = std::vector<std::string>;

/// The blocks of the document's chapter, by how the paragraph before each begins: "> 42D#007F040020  poll 5 STW 047F SW1 2000".
std::map<std::string, Lines> documented() {
  std::ifstream file{NORD_DRIVER_SOURCE_DIR "/doc/devicenet.md"};
  std::map<std::string, Lines> blocks;
  std::string line, title, before;
  for (bool in_chapter = false, in_block = false; std::getline(file, line);) {
    if (line.rfind("## ", 0) == 0) in_chapter = line == "## One drive, frame by frame";
    if (!in_chapter) continue;
    if (line.rfind("```", 0) == 0) {
      in_block = !in_block;
    } else if (in_block) {
      blocks[title].push_back(line);
    } else if (!line.empty() && before.empty()) {
      title = line.substr(0, line.find(':'));
    }
    before = line;
  }
  return blocks;
}

/// The frames from and to the device with MAC id 5, and our own duplicate-MAC check, with the trace's words. Process data
/// that say again what was said before are left out.
class Dialogue {
 public:
  explicit Dialogue(DevicenetRobot& robot) : trace_(*robot.transport().trace()) {}

  /// What came since the last call.
  Lines take() {
    Lines lines;
    const std::vector<TraceRecord> records = trace_.copy();
    for (; taken_ < records.size(); ++taken_) {
      const TraceRecord& record = records[taken_];
      const CanFrame frame = *fromPacket(record.view());
      const bool process_data = frame.id == 0x42D || frame.id == 0x3C5;
      const bool explicit_message = frame.id >= 0x42A && frame.id <= 0x42F;
      if (!process_data && !explicit_message && frame.id != 0x407) continue;
      const std::string text = candumpText(frame);
      if (process_data && last_[frame.id] == text) continue;
      last_[frame.id] = text;
      const bool sent = record.kind == TraceKind::kSent;
      lines.push_back((sent ? "> " : "< ") + text + "  " + trace_.describe(record));
    }
    return lines;
  }

 private:
  const TelegramTrace& trace_;
  std::size_t taken_ = 0;
  std::map<std::uint32_t, std::string> last_;
};

std::string joined(const Lines& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

/// Each in `lines`, in this order, whatever is between them.
void expectInOrder(const Lines& wanted, const Lines& lines) {
  ASSERT_FALSE(wanted.empty());
  auto from = lines.begin();
  for (const std::string& line : wanted) {
    from = std::find(from, lines.end(), line);
    ASSERT_NE(lines.end(), from) << line << "\nis not among, or not behind the line before it:\n" << joined(lines);
    ++from;
  }
}

TEST(DevicenetDialogue, IsThatOfTheDocument) {
  DevicenetRobot::Options options;
  options.bus = {{"serial_number", 0x11223344}};
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.motor.slip = 0.001;
  };
  DevicenetRobot robot{options};
  Dialogue dialogue{robot};
  std::map<std::string, Lines> document = documented();

  ASSERT_TRUE(robot.runUntil([&] { return robot.online(0); }));
  EXPECT_EQ(joined(document["Start-up"]), joined(dialogue.take()));

  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  expectInOrder(document["Drive"], dialogue.take());

  robot.run(std::chrono::seconds{1});
  dialogue.take();
  cycle::Request write;
  write.kind = cycle::RequestKind::kWriteParameter;
  write.drive = 0;
  write.parameter.number = 102;
  write.parameter.shape = profile::ParameterShape::kPerSet;
  write.parameter.action = profile::ParameterAction::kWritePersistent;
  write.parameter.raw = 150;
  ASSERT_TRUE(robot.ask(write).success);
  EXPECT_EQ(joined(document["Parameter write"]), joined(dialogue.take()));

  robot.unit(0).inverter().trip(30, false);
  robot.run(std::chrono::seconds{2});
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kAcknowledge, 0).success);
  expectInOrder(document["Fault"], dialogue.take());
  EXPECT_EQ("no rule broken", robot.bus().referee().report());
}

}  // namespace
}  // namespace nord_driver::test
