#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/io_fragments.h"
#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<std::string> sent(std::size_t size, const Bytes& message) {
  IoSender sender{size};
  sender.start(ByteView{message});
  std::vector<std::string> frames;
  FramePayload payload;
  while (sender.next(payload)) frames.push_back(toHex(ByteView{payload}));
  return frames;
}

Bytes counted(std::size_t size) {
  Bytes bytes;
  for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(i + 1));
  return bytes;
}

IoReceiver::Result feed(IoReceiver& receiver, const std::string& hex) {
  return receiver.handle(ByteView{fromHex(hex)});
}

// Ten bytes of process data (facts 3.4): 44D `00 01..07`, `81 08 09 0A`.
TEST(IoFragments, TenBytes) {
  EXPECT_EQ((std::vector<std::string>{"00 01 02 03 04 05 06 07", "81 08 09 0A"}), sent(10, counted(10)));
  IoReceiver receiver{10};
  EXPECT_EQ(IoReceiver::Result::kNeedMore, feed(receiver, "00 01 02 03 04 05 06 07"));
  EXPECT_EQ(IoReceiver::Result::kComplete, feed(receiver, "81 08 09 0A"));
  EXPECT_EQ(ByteView{counted(10)}, ByteView{receiver.message()});
}

// NORD's assembly 102/112 (BU 0280 4.2.2): 33 bytes are five frames.
TEST(IoFragments, ThirtyThreeBytes) {
  EXPECT_EQ((std::vector<std::string>{"00 01 02 03 04 05 06 07", "41 08 09 0A 0B 0C 0D 0E", "42 0F 10 11 12 13 14 15",
                                      "43 16 17 18 19 1A 1B 1C", "84 1D 1E 1F 20 21"}),
            sent(33, counted(33)));
  EXPECT_EQ(5u, ioFrames(33, 33));
}

// The size of the connection decides, not that of the message.
TEST(IoFragments, ShortMessageOnALargeConnection) {
  EXPECT_EQ((std::vector<std::string>{"3F 01 02"}), sent(10, counted(2)));
  EXPECT_EQ((std::vector<std::string>{"01 02 03 04 05 06 07 08"}), sent(8, counted(8)));
  IoReceiver receiver{10};
  EXPECT_EQ(IoReceiver::Result::kComplete, feed(receiver, "3F 01 02"));
  EXPECT_EQ(2u, receiver.message().size());
}

// A whole multiple of seven ends with a full last fragment, not with an empty one.
TEST(IoFragments, WholeMultiple) {
  EXPECT_EQ((std::vector<std::string>{"00 01 02 03 04 05 06 07", "81 08 09 0A 0B 0C 0D 0E"}), sent(14, counted(14)));
}

TEST(IoFragments, RoundTripOfEverySize) {
  for (std::size_t size = 1; size <= kIoCapacity; ++size) {
    IoSender sender{size};
    IoReceiver receiver{size};
    sender.start(ByteView{counted(size)});
    FramePayload payload;
    std::size_t frames = 0;
    auto result = IoReceiver::Result::kNeedMore;
    while (sender.next(payload)) {
      EXPECT_EQ(IoReceiver::Result::kNeedMore, result);
      result = receiver.handle(ByteView{payload});
      ++frames;
    }
    EXPECT_EQ(IoReceiver::Result::kComplete, result) << size;
    EXPECT_EQ(ByteView{counted(size)}, ByteView{receiver.message()});
    EXPECT_EQ(ioFrames(size, size), frames);
  }
}

// A gap, a fragment twice, one without its first, or too many bytes: the message is dropped as a whole, and the next
// one is whole again.
TEST(IoFragments, DropsWhatIsBroken) {
  const std::vector<std::vector<std::string>> broken{
      {"00 01 02 03 04 05 06 07", "82 08 09 0A"},
      {"00 01 02 03 04 05 06 07", "41 08 09 0A 0B 0C 0D 0E", "41 08 09 0A 0B 0C 0D 0E"},
      {"81 08 09 0A"},
      {"41 08 09 0A"},
      {"C0 00"},
      {"05 01 02"},
      {"00 01 02 03 04 05 06 07", "41 08 09 0A 0B 0C 0D 0E", "82 0F 10 11"},
  };
  for (const auto& frames : broken) {
    IoReceiver receiver{16};
    auto result = IoReceiver::Result::kNeedMore;
    for (const std::string& hex : frames) result = feed(receiver, hex);
    EXPECT_EQ(IoReceiver::Result::kBroken, result) << frames.back();
    EXPECT_EQ(IoReceiver::Result::kBroken, feed(receiver, "81 08 09 0A")) << "the rest of it";
    feed(receiver, "00 01 02 03 04 05 06 07");
    feed(receiver, "41 08 09 0A 0B 0C 0D 0E");
    EXPECT_EQ(IoReceiver::Result::kComplete, feed(receiver, "82 0F 10"));
  }
}

// A new first fragment ends the message before it.
TEST(IoFragments, FirstBeginsAnew) {
  IoReceiver receiver{10};
  feed(receiver, "00 FF FF FF FF FF FF FF");
  EXPECT_EQ(IoReceiver::Result::kNeedMore, feed(receiver, "00 01 02 03 04 05 06 07"));
  EXPECT_EQ(IoReceiver::Result::kComplete, feed(receiver, "81 08 09 0A"));
  EXPECT_EQ(ByteView{counted(10)}, ByteView{receiver.message()});
}

// The whole way, both directions, through scanner and device.
TEST(IoFragments, OverTheBus) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].io.input_bytes = config.nodes[0].io.output_bytes = 33;
  ScannerRun run{config};
  run.output = counted(33);
  run.devices[0]->input = counted(33);
  ASSERT_TRUE(run.starts());
  EXPECT_EQ(counted(33), run.devices[0]->output);
  EXPECT_EQ(ByteView{counted(33)}, ByteView{run.scanner.input(0).bytes});
  // One fragment of an answer is lost: nothing of it is taken, and the next answer is.
  bool lost = false;
  run.loses = [&lost](const CanFrame& frame) {
    const bool loses = !lost && frame.id == 0x3C5 && frame.size > 0 && frame.data[0] == 0x42;
    lost = lost || loses;
    return loses;
  };
  run.devices[0]->input = Bytes(33, 0xAA);
  const auto inputs = run.scanner.status(0).counters.inputs;
  const auto outputs = run.scanner.status(0).counters.outputs;
  const auto cycles = run.scanner.counters().cycles;
  run.run(std::chrono::milliseconds{30});
  EXPECT_EQ(outputs + 3, run.scanner.status(0).counters.outputs) << "messages, not fragments";
  EXPECT_EQ(cycles + 3, run.scanner.counters().cycles);
  EXPECT_TRUE(lost);
  EXPECT_EQ(2u, run.scanner.status(0).counters.broken_inputs) << "the gap, and the last fragment behind it";
  EXPECT_EQ(inputs + 2, run.scanner.status(0).counters.inputs);
  EXPECT_EQ(ByteView{Bytes(33, 0xAA)}, ByteView{run.scanner.input(0).bytes});
  EXPECT_EQ(NodeState::kExchanging, run.scanner.status(0).state);
}

// The link takes two of five frames: the rest of the message is not sent later, and the device takes nothing of it.
TEST(IoFragments, ACutMessageIsNotFinishedLater) {
  ScannerConfig config = busConfig(1);
  config.nodes[0].io.input_bytes = config.nodes[0].io.output_bytes = 33;
  ScannerRun run{config};
  run.output = Bytes(33, 0x11);
  ASSERT_TRUE(run.starts());
  run.sets_outputs = false;
  run.scanner.setOutput(0, ByteView{Bytes(33, 0x22)});
  run.scanner.startCycle(run.now);
  CanFrame frame;
  ASSERT_TRUE(run.scanner.pollTransmit(frame));
  run.devices[0]->receive(frame, run.now);
  ASSERT_TRUE(run.scanner.pollTransmit(frame));
  run.scanner.notSent();
  EXPECT_FALSE(run.scanner.pollTransmit(frame));
  EXPECT_EQ(1u, run.scanner.counters().superseded);
  run.scanner.setOutput(0, ByteView{Bytes(33, 0x33)});
  run.sets_outputs = true;
  run.output = Bytes(33, 0x33);
  run.run(std::chrono::milliseconds{20});
  EXPECT_EQ(Bytes(33, 0x33), run.devices[0]->output);
}

}  // namespace
}  // namespace nord_driver::devicenet
