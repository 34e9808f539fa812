#include "link/serial/port_fixture.h"

namespace nord_driver::link {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

constexpr std::uint8_t kTelegram[] = {0x10, 0x08, 0x01, 0x49, 0x52, 0x16};

class PortFailures : public PortFixture {
 protected:
  PortFailures() {
    settings.echo = EchoMode::kOff;
    EXPECT_TRUE(port.open()) << port.lastError();
  }
  bool send() { return port.write({kTelegram, sizeof kTelegram}); }
  void expectClosed(const char* reason) {
    EXPECT_FALSE(port.isOpen());
    EXPECT_EQ(0, system.open_descriptors);
    EXPECT_THAT(port.lastError(), HasSubstr(reason));
  }

  SerialPort port{settings, system};
  std::uint8_t buffer[16] = {};
};

// The rest of a telegram after a gap is no part of it: a short write is the end of the line.
TEST_F(PortFailures, AShortWriteClosesThePort) {
  system.write_results = {3};
  EXPECT_FALSE(send());
  expectClosed("whole telegram");
}

TEST_F(PortFailures, AFullBufferClosesThePort) {
  system.write_results = {-EAGAIN};
  EXPECT_FALSE(send());
  expectClosed("whole telegram");
}

// Closing waits for what was written: an adapter that sends nothing any more would hold the bus cycle up. What a clean
// exit has written is still to go out.
TEST_F(PortFailures, WhatWasNotSentIsDiscardedAfterAFailureOnly) {
  EXPECT_TRUE(send());
  port.close();
  EXPECT_EQ(0, system.output_flushes);
  for (int failures = 1; failures <= 3; ++failures) {
    ASSERT_TRUE(port.open());
    EXPECT_TRUE(send());
    if (failures == 1) system.write_results = {-EAGAIN};
    if (failures == 2) system.read_errors = {EIO};
    if (failures == 3) system.poll_errors = {EBADF};
    EXPECT_FALSE(failures == 1   ? send()
                 : failures == 2 ? port.read(buffer, sizeof buffer) > 0
                                 : port.waitReadable(port.now() + milliseconds{1}));
    EXPECT_FALSE(port.isOpen());
    EXPECT_EQ(failures, system.output_flushes);
  }
}

// Another process has it: what waits there is of that one.
TEST_F(PortFailures, NothingIsDiscardedOfADeviceThatIsNotOurs) {
  port.close();
  system.lock_error = EWOULDBLOCK;
  EXPECT_FALSE(port.open());
  EXPECT_EQ(0, system.output_flushes);
}

TEST_F(PortFailures, AnInterruptedWriteIsRepeatedWhole) {
  system.write_results = {-EINTR, -EINTR};
  EXPECT_TRUE(send());
  ASSERT_EQ(1u, system.written.size());
  EXPECT_EQ(6u, system.written[0].size());
}

TEST_F(PortFailures, WritingToAnAdapterThatIsGone) {
  system.write_results = {-EIO};
  EXPECT_FALSE(send());
  expectClosed("was unplugged");
  EXPECT_FALSE(send()) << "a closed port";
}

TEST_F(PortFailures, AnotherErrorOfWritingIsNamed) {
  system.write_results = {-ENOSPC};
  EXPECT_FALSE(send());
  expectClosed("No space left");
}

TEST_F(PortFailures, ReadingNothingIsNoFailure) {
  system.read_errors = {EAGAIN, EINTR};
  EXPECT_EQ(0u, port.read(buffer, sizeof buffer));
  EXPECT_EQ(0u, port.read(buffer, sizeof buffer));
  EXPECT_TRUE(port.isOpen());
}

TEST_F(PortFailures, ReadingFromAnAdapterThatIsGone) {
  system.read_errors = {EIO};
  EXPECT_EQ(0u, port.read(buffer, sizeof buffer));
  expectClosed("was unplugged");
}

TEST_F(PortFailures, AHangUpWithoutAnError) {
  system.hung_up = true;
  EXPECT_EQ(0u, port.read(buffer, sizeof buffer));
  expectClosed("was unplugged");
}

// What arrived before the hang-up is still handed out.
TEST_F(PortFailures, AHangUpSeenWhileWaiting) {
  system.incoming = {{0xE5}};
  system.hung_up = true;
  EXPECT_TRUE(port.waitReadable(port.now() + milliseconds{1}));
  EXPECT_EQ(1u, port.read(buffer, sizeof buffer));
  EXPECT_TRUE(port.isOpen());
  EXPECT_FALSE(port.waitReadable(port.now() + milliseconds{1}));
  expectClosed("was unplugged");
}

TEST_F(PortFailures, AnInterruptedWaitGoesOn) {
  system.poll_errors = {EINTR, EINTR};
  const Instant until = port.now() + milliseconds{5};
  EXPECT_FALSE(port.waitReadable(until));
  EXPECT_EQ(until, port.now());
  EXPECT_TRUE(port.isOpen());
}

TEST_F(PortFailures, AWaitThatCannotBe) {
  system.poll_errors = {EBADF};
  EXPECT_FALSE(port.waitReadable(port.now() + milliseconds{5}));
  expectClosed("Bad file descriptor");
}

// What an adapter collected while nobody listened, opening after opening.
TEST_F(PortFailures, OpeningDiscardsWhatArrivedBefore) {
  for (int i = 0; i < 2; ++i) {
    port.close();
    system.incoming = {{0x68, 0x0F}, {0xE5}};
    ASSERT_TRUE(port.open());
    EXPECT_EQ(0u, port.read(buffer, sizeof buffer));
    EXPECT_FALSE(port.waitReadable(port.now() + milliseconds{1}));
  }
}

// What to do about the two that everybody meets on the first day.
TEST_F(PortFailures, ADeviceThatIsNotThereOrNotAllowedIsToldWithTheRemedy) {
  port.close();
  system.open_error = EACCES;
  EXPECT_FALSE(port.open());
  EXPECT_EQ(
      "/dev/ttyUSB0: cannot be opened: Permission denied (only the group dialout may: sudo usermod -aG dialout $USER, "
      "then log in again)",
      port.lastError());
  settings.device = "/dev/ttyUSB7";
  SerialPort missing{settings, system};
  EXPECT_FALSE(missing.open());
  EXPECT_EQ(
      "/dev/ttyUSB7: cannot be opened: No such file or directory (the adapters that are there: ls /dev/serial/by-id)",
      missing.lastError());
}

// A character with a wrong parity bit reaches the reader as a zero: the UART's own counters tell it from noise.
TEST_F(PortFailures, ErrorsOfTheLineAreCountedFromTheOpening) {
  port.close();
  system.counters = {10, 20, 30, 40};
  ASSERT_TRUE(port.open());
  EXPECT_EQ(0u, port.lineCounters().parity_errors);
  system.counters = {11, 22, 33, 44};
  const LineCounters counters = port.lineCounters();
  EXPECT_EQ(1u, counters.parity_errors);
  EXPECT_EQ(2u, counters.framing_errors);
  EXPECT_EQ(7u, counters.overruns);
}

TEST_F(PortFailures, TheKernelsCountersWrap) {
  port.close();
  system.counters = {0xFFFF'FFFEu, 0x7FFF'FFFFu, 0, 0};
  ASSERT_TRUE(port.open());
  system.counters = {3, 0x8000'0001u, 0, 0};
  EXPECT_EQ(5u, port.lineCounters().parity_errors);
  EXPECT_EQ(2u, port.lineCounters().framing_errors);
}

// An adapter that was plugged in again begins at zero; the errors before it stay counted.
TEST_F(PortFailures, ErrorsAreKeptAcrossOpenings) {
  system.counters = {5, 0, 0, 0};
  port.close();
  system.counters = {};
  ASSERT_TRUE(port.open());
  system.counters = {2, 0, 0, 0};
  EXPECT_EQ(7u, port.lineCounters().parity_errors);
}

TEST_F(PortFailures, WithoutCountersThereAreNoErrors) {
  port.close();
  system.counters_error = ENOTTY;
  system.counters = {9, 9, 9, 9};
  ASSERT_TRUE(port.open());
  EXPECT_EQ(0u, port.lineCounters().parity_errors);
}

}  // namespace
}  // namespace nord_driver::link
