#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

/// Two scanners and one device; what each sends comes to all others.
class TwoScanners : public testing::Test {
 protected:
  void make(std::uint8_t first_mac, std::uint8_t second_mac) {
    ScannerConfig config = busConfig(1);
    config.mac = first_mac;
    first = std::make_unique<Scanner>(config);
    config.mac = second_mac;
    config.own.serial_number = 0x99;
    second = std::make_unique<Scanner>(config);
  }
  void pump(Scanner& from, Scanner& to, std::vector<std::string>& sent) {
    CanFrame frame;
    while (from.pollTransmit(frame)) {
      sent.push_back(text(frame));
      to.handleFrame(frame, now);
      device.receive(frame, now);
    }
  }
  void run(Duration span) {
    for (const Instant end = now + span; now < end;) {
      now += milliseconds{1};
      device.tick(now);
      CanFrame frame;
      while (device.next(frame)) {
        first->handleFrame(frame, now);
        second->handleFrame(frame, now);
      }
      const std::array<std::uint8_t, 5> output{0, 0x7E, 4, 0, 0};
      for (Scanner* scanner : {first.get(), second.get()}) {
        if (steps % 10 == 0) {
          scanner->setOutput(0, output);
          scanner->startCycle(now);
        }
        scanner->poll(now);
      }
      ++steps;
      pump(*first, *second, first_sent);
      pump(*second, *first, second_sent);
      while (const auto event = first->pollEvent()) first_events.push_back(*event);
      while (const auto event = second->pollEvent()) second_events.push_back(*event);
    }
  }
  static std::size_t count(const std::vector<DevicenetEvent>& events, DevicenetEventKind kind) {
    std::size_t found = 0;
    for (const DevicenetEvent& event : events) found += event.kind == kind ? 1 : 0;
    return found;
  }

  FakeDevice device{5};
  std::unique_ptr<Scanner> first, second;
  std::vector<std::string> first_sent, second_sent;
  std::vector<DevicenetEvent> first_events, second_events;
  Instant now{std::chrono::hours{1}};
  int steps = 0;
};

// Another MAC id, the same device: the second one is refused and names the first, the first names the second, nothing
// else happens.
TEST_F(TwoScanners, OfOneDevice) {
  make(0, 1);
  first->restart(now);
  run(seconds{4});
  ASSERT_EQ(NodeState::kExchanging, first->status(0).state);
  second->restart(now);
  run(seconds{20});
  EXPECT_EQ(NodeState::kExchanging, first->status(0).state);
  EXPECT_EQ(0u, first->status(0).counters.losses);
  EXPECT_EQ(NodeState::kRefused, second->status(0).state);
  EXPECT_STREQ("is allocated to another master, MAC id 0", second->status(0).reason.c_str());
  for (const std::string& frame : second_sent) {
    EXPECT_TRUE(frame.rfind("40F#", 0) == 0 || frame.rfind("42E#", 0) == 0) << frame;
  }
  EXPECT_LT(0u, count(first_events, DevicenetEventKind::kSecondScanner));
  EXPECT_EQ(0, device.master);
  EXPECT_THAT(device.violations, testing::IsEmpty());
  for (const DevicenetEvent& event : first_events) {
    if (event.kind != DevicenetEventKind::kSecondScanner) continue;
    EXPECT_THAT(event.text.c_str(), HasSubstr("another master, MAC id 1, is on the bus"));
  }
}

// The same MAC id: the second one stays in communication fault, the first one goes on.
TEST_F(TwoScanners, WithOneMacId) {
  make(0, 0);
  first->restart(now);
  run(seconds{4});
  second->restart(now);
  run(seconds{20});
  EXPECT_EQ(NodeState::kExchanging, first->status(0).state);
  EXPECT_EQ(0u, first->status(0).counters.losses);
  EXPECT_EQ(BusState::kOnline, first->busState());
  EXPECT_THAT(second->busReason().c_str(),
              HasSubstr("another device has our MAC id 0, vendor 4660, serial number 11223344h"));
  EXPECT_EQ(0u, count(second_events, DevicenetEventKind::kOnline));
  for (const std::string& frame : second_sent) EXPECT_EQ("407#00341299000000", frame);
}

// Both start together with one MAC id: at most one of them ever comes on-line, the other is silent and named.
TEST_F(TwoScanners, WithOneMacIdAtOnce) {
  make(0, 0);
  first->restart(now);
  second->restart(now);
  run(seconds{20});
  const bool one = first->busState() == BusState::kOnline;
  const bool other = second->busState() == BusState::kOnline;
  EXPECT_FALSE(one && other);
  EXPECT_LT(0u, count(one ? second_events : first_events, DevicenetEventKind::kCommunicationFault));
  EXPECT_GE(1u, count(first_events, DevicenetEventKind::kOnline) + count(second_events, DevicenetEventKind::kOnline));
  EXPECT_THAT(device.violations, testing::IsEmpty());
}

}  // namespace
}  // namespace nord_driver::devicenet
