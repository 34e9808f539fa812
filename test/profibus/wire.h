// A conversation on the wire with a DP master: time is a variable, the other end is typed in hexadecimal.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "nord_driver/core/bytes.h"
#include "profibus/dp_master.h"

namespace nord_driver::profibus {

inline StationAddress station(int address) {
  return *StationAddress::from(address);
}

/// 19.2 kbit/s, master 1, without the periodic Global_Control: tests that want it switch it on.
inline BusParameters quietBus() {
  BusParameters bus = BusParameters::forBaudRate(BaudRate{19'200}, station(1));
  bus.operate_interval = Duration::zero();
  return bus;
}

/// A NORD module with ident 7531h and PPO 1 (F3 F1, 12 bytes each way), watchdog 100 ms.
inline SlaveConfig nordModule(int address) {
  SlaveConfig slave;
  slave.address = station(address);
  slave.ident_number = 0x7531;
  slave.configuration = {0xF3, 0xF1};
  slave.output_length = 12;
  slave.input_length = 12;
  slave.watchdog = std::chrono::milliseconds{100};
  return slave;
}

/// Plays the other end. It is a referee, too: every request must follow at least 33 idle bit times (T_SYN).
class Wire {
 public:
  Wire(const BusParameters& bus, const std::vector<SlaveConfig>& slaves) : bus_(bus), master(bus, slaves) { restart(); }

  void restart() {
    master.restart(now);
    silent_since_ = now;
  }

  void advance(Duration span) { now += span; }
  void advanceBits(std::uint64_t bits) { now += bus_.baud.bits(bits); }

  void startCycle() { master.startCycle(now); }

  /// Lets time pass to the moment the master may send, and expects these bytes.
  void sends(const std::string& hex, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    testing::ScopedTrace trace(file, line, "sends");
    ByteView bytes = master.pollTransmit(now);
    if (bytes.empty()) {
      const auto deadline = master.nextDeadline();
      ASSERT_TRUE(deadline) << "the master has nothing to send";
      if (*deadline > now) now = *deadline;
      bytes = master.pollTransmit(now);
    }
    EXPECT_EQ(hex, toHex(bytes));
    EXPECT_GE((now - silent_since_).count(), bus_.baud.bits(33).count()) << "the pause before a request is too short";
    idle_before_ = now - silent_since_;
    silent_since_ = now + bus_.baud.characters(bytes.size());
    sent_end_ = silent_since_;
  }

  /// The line is silent for 11 bit times after the request, then these bytes come, all at once.
  void receives(const std::string& hex) {
    const auto bytes = fromHex(hex);
    now = std::max(now, sent_end_) + bus_.baud.bits(11) + bus_.baud.characters(bytes.size());
    silent_since_ = now;
    master.handleBytes(bytes, now);
  }

  /// These bytes come now, whatever is under way.
  void arrives(const std::string& hex) {
    silent_since_ = std::max(silent_since_, now);
    master.handleBytes(fromHex(hex), now);
  }

  /// Nobody answers: time passes to the end of the slot.
  void staysSilent(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    testing::ScopedTrace trace(file, line, "staysSilent");
    EXPECT_TRUE(master.pollTransmit(now).empty()) << "the master sends instead of waiting";
    ASSERT_TRUE(master.nextDeadline());
    now = *master.nextDeadline();
    master.handleTimeout(now);
  }

  void cycleEnds(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    testing::ScopedTrace trace(file, line, "cycleEnds");
    EXPECT_TRUE(master.cycleDone());
    EXPECT_EQ("", toHex(master.pollTransmit(now)));
    EXPECT_FALSE(master.nextDeadline());
  }

  /// The next event is this one.
  DpEvent tells(DpEventKind kind, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    testing::ScopedTrace trace(file, line, "tells");
    const auto event = master.pollEvent();
    EXPECT_TRUE(event) << "no event";
    if (!event) return {};
    EXPECT_EQ(static_cast<int>(kind), static_cast<int>(event->kind)) << event->text;
    return *event;
  }
  void tellsNothing(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    testing::ScopedTrace trace(file, line, "tellsNothing");
    const auto event = master.pollEvent();
    EXPECT_FALSE(event) << event->text;
  }
  void forgetEvents() {
    while (master.pollEvent()) {
    }
  }

  const SlaveStatus& status(std::size_t slave = 0) const { return master.status(slave); }
  /// The pause before the telegram that `sends()` saw last.
  Duration idleBefore() const { return idle_before_; }
  Instant sentEnd() const { return sent_end_; }

 private:
  BusParameters bus_;
  Instant silent_since_{};
  Instant sent_end_{};
  Duration idle_before_{};

 public:
  DpMaster master;
  Instant now{std::chrono::hours{1}};
};

}  // namespace nord_driver::profibus
