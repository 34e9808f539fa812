#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "link/serial/serial_devices.h"
#include "link/serial/serial_port.h"
#include "support/pty_pair.h"

namespace nord_driver::link {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::PtyPair;
using ::testing::HasSubstr;

SerialSettings settingsFor(const PtyPair& pty) {
  SerialSettings settings;
  settings.device = pty.path();
  settings.baud_rate = BaudRate{93'750};
  return settings;
}

TEST(SerialPort, PassesEveryByteUnchangedBothWays) {
  PtyPair pty;
  SerialSettings settings = settingsFor(pty);
  settings.echo = EchoMode::kOff;  // the far end sends what it was sent
  SerialPort port{settings};
  ASSERT_TRUE(port.open()) << port.lastError();
  // All 256 values: XON, XOFF, CR, NL, FF and the terminal's other special characters are only data here.
  std::vector<std::uint8_t> bytes(256);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i);

  ASSERT_TRUE(port.write(ByteView{bytes}));
  EXPECT_EQ(bytes, pty.receive());

  pty.send(bytes);
  std::vector<std::uint8_t> seen;
  std::uint8_t buffer[64];
  while (seen.size() < bytes.size() && port.waitReadable(port.now() + seconds{1})) {
    const std::size_t count = port.read(buffer, sizeof buffer);
    seen.insert(seen.end(), buffer, buffer + count);
  }
  EXPECT_EQ(bytes, seen);
}

TEST(SerialPort, KnowsAPty) {
  PtyPair pty;
  EXPECT_FALSE(isNativeUart(pty.path()));
  EXPECT_FALSE(isNativeUart("/nowhere"));
  SerialPort port{settingsFor(pty)};
  ASSERT_TRUE(port.open());
  EXPECT_FALSE(port.keepsBaudRate());
}

TEST(SerialPort, NamesWhatCannotBeOpened) {
  SerialSettings settings;
  settings.device = "/dev/nord_driver_no_such_device";
  SerialPort port{settings};
  EXPECT_FALSE(port.open());
  EXPECT_FALSE(port.isOpen());
  EXPECT_THAT(port.lastError(), HasSubstr("/dev/nord_driver_no_such_device"));
  EXPECT_THAT(port.lastError(), HasSubstr("No such file"));
}

TEST(SerialPort, RefusesWhatIsNoSerialDevice) {
  SerialSettings settings;
  settings.device = "/dev/null";
  SerialPort port{settings};
  EXPECT_FALSE(port.open());
  EXPECT_THAT(port.lastError(), HasSubstr("no serial device"));
}

// Two masters that do not know of each other on one line would talk into each other's telegrams.
TEST(SerialPort, RefusesADeviceAnotherOneHolds) {
  PtyPair pty;
  SerialPort first{settingsFor(pty)}, second{settingsFor(pty)};
  ASSERT_TRUE(first.open());
  EXPECT_FALSE(second.open());
  EXPECT_THAT(second.lastError(), HasSubstr("in use"));
  first.close();
  EXPECT_TRUE(second.open()) << second.lastError();
}

TEST(SerialPort, AnUnpluggedDeviceClosesThePortAndIsNamed) {
  PtyPair pty;
  SerialPort port{settingsFor(pty)};
  ASSERT_TRUE(port.open());
  pty.hangUp();
  port.waitReadable(port.now() + seconds{1});
  std::uint8_t buffer[8];
  EXPECT_EQ(0u, port.read(buffer, sizeof buffer));
  EXPECT_FALSE(port.isOpen());
  EXPECT_THAT(port.lastError(), HasSubstr("unplugged"));
  EXPECT_FALSE(port.write(ByteView{std::vector<std::uint8_t>{1}}));
}

TEST(SerialPort, WaitingEndsAtTheDeadline) {
  PtyPair pty;
  SerialPort port{settingsFor(pty)};
  ASSERT_TRUE(port.open());
  const Instant deadline = port.now() + milliseconds{2};
  EXPECT_FALSE(port.waitReadable(deadline));
  EXPECT_GE(port.now(), deadline);
  EXPECT_TRUE(port.isOpen());
}

// Nobody reads: the port fails when no more fits, and what lies there is discarded but for the 4 KiB that have reached the
// far end's own buffer. (A pty cannot show that closing waits for an adapter.)
TEST(SerialPort, AFailureDiscardsWhatWasNotSent) {
  PtyPair pty;
  SerialPort port{settingsFor(pty)};
  ASSERT_TRUE(port.open()) << port.lastError();
  const std::vector<std::uint8_t> telegram(249, 0x5A);
  std::size_t written = 0, received = 0;
  while (written < 10'000'000 && port.write(ByteView{telegram})) written += telegram.size();
  ASSERT_FALSE(port.isOpen());
  for (auto bytes = pty.receive(); !bytes.empty(); bytes = pty.receive()) received += bytes.size();
  EXPECT_LT(received, written);
}

TEST(SerialPort, ACleanExitLeavesWhatWasWritten) {
  PtyPair pty;
  SerialPort port{settingsFor(pty)};
  ASSERT_TRUE(port.open()) << port.lastError();
  const std::vector<std::uint8_t> telegram{0x10, 0x08, 0x01, 0x49, 0x52, 0x16};
  ASSERT_TRUE(port.write(ByteView{telegram}));
  port.close();
  EXPECT_EQ(telegram, pty.receive());
}

// Bytes from before belong to no telegram of ours, whoever sent them.
TEST(SerialPort, OpeningDiscardsWhatArrivedBefore) {
  PtyPair pty;
  pty.send({1, 2, 3, '\n'});
  SerialPort port{settingsFor(pty)};
  ASSERT_TRUE(port.open()) << port.lastError();
  EXPECT_FALSE(port.waitReadable(port.now() + milliseconds{20}));
  pty.send({4});
  std::uint8_t buffer[8];
  ASSERT_TRUE(port.waitReadable(port.now() + seconds{1}));
  ASSERT_EQ(1u, port.read(buffer, sizeof buffer));
  EXPECT_EQ(4, buffer[0]);
}

TEST(SerialPort, DiscardsWhatArrivedBeforeItWasAskedTo) {
  PtyPair pty;
  SerialPort port{settingsFor(pty)};
  ASSERT_TRUE(port.open());
  pty.send({1, 2, 3});
  ASSERT_TRUE(port.waitReadable(port.now() + seconds{1}));
  port.discardInput();
  std::uint8_t buffer[8];
  EXPECT_EQ(0u, port.read(buffer, sizeof buffer));
}

}  // namespace
}  // namespace nord_driver::link
