// A conversation of a class-2 master (DP-V1, MS2) with a module at address 8, typed in hexadecimal; time is a variable.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "profibus/class2_master.h"
#include "profibus/record_wire.h"

namespace nord_driver::profibus {

constexpr const char* kInitiate6C =
    "68 19 19 68 88 81 6C 31 32 57 00 00 00 00 64 01 00 00 00 00 00 00 02 00 02 00 00 00 00 98 16";
constexpr const char* kInitiate5C =
    "68 19 19 68 88 81 5C 31 32 57 00 00 00 00 64 01 00 00 00 00 00 00 02 00 02 00 00 00 00 88 16";
constexpr const char* kInitiate7C =
    "68 19 19 68 88 81 7C 31 32 57 00 00 00 00 64 01 00 00 00 00 00 00 02 00 02 00 00 00 00 A8 16";
constexpr const char* kManagerPoll5C = "68 05 05 68 88 81 5C 31 32 C8 16";
constexpr const char* kManagerPoll7C = "68 05 05 68 88 81 7C 31 32 E8 16";
/// Access point 48, Min_Send_Timeout 200 ms.
constexpr const char* kGrant = "68 09 09 68 81 88 08 32 31 56 30 00 14 0E 16";
constexpr const char* kServerPoll5C = "68 05 05 68 88 81 5C 30 32 C7 16";
constexpr const char* kServerPoll7C = "68 05 05 68 88 81 7C 30 32 E7 16";
constexpr const char* kAccepted = "68 15 15 68 81 88 08 32 30 57 F0 01 00 00 00 00 00 00 02 00 02 00 00 00 00 BF 16";
constexpr const char* kClass2Write5C = "68 11 11 68 88 81 5C 30 32 5F 00 65 08 15 E4 00 00 00 00 00 00 8C 16";
constexpr const char* kClass2Write7C = "68 11 11 68 88 81 7C 30 32 5F 00 65 08 15 E4 00 00 00 00 00 00 AC 16";
constexpr const char* kClass2Written = "68 09 09 68 81 88 08 32 30 5F 00 65 08 3F 16";
constexpr const char* kClass2Read5C = "68 09 09 68 88 81 5C 30 32 5E 00 65 08 92 16";
constexpr const char* kClass2Read7C = "68 09 09 68 88 81 7C 30 32 5E 00 65 08 B2 16";
constexpr const char* kClass2ReadDone = "68 11 11 68 81 88 08 32 30 5E 00 65 08 15 E4 00 00 00 00 00 01 38 16";
constexpr const char* kIdle5C = "68 06 06 68 88 81 5C 30 32 48 0F 16";
constexpr const char* kIdle7C = "68 06 06 68 88 81 7C 30 32 48 2F 16";
constexpr const char* kIdleBack = "68 06 06 68 81 88 08 32 30 48 BB 16";

class Class2Wire {
 public:
  explicit Class2Wire(const BusParameters& bus = quietBus(), const Class2Times& times = {})
      : master(bus, {station(8)}, times), bus_(bus) {
    master.restart(now);
    advance(std::chrono::milliseconds{10});
  }

  void advance(Duration span) { now += span; }

  /// The next telegram, once the pause is over.
  void sends(const std::string& hex, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    testing::ScopedTrace trace(file, line, "sends");
    ASSERT_TRUE(master.wantsBus(now)) << "the master has nothing to send";
    ByteView bytes = master.pollTransmit(now);
    if (bytes.empty()) {
      ASSERT_TRUE(master.nextDeadline());
      now = std::max(now, *master.nextDeadline());
      bytes = master.pollTransmit(now);
    }
    EXPECT_EQ(hex, toHex(bytes));
    now += bus_.baud.characters(bytes.size());
  }
  void receives(const std::string& hex) {
    const auto bytes = fromHex(hex);
    now += bus_.baud.bits(11) + bus_.baud.characters(bytes.size());
    master.handleBytes(bytes, now);
  }
  void asks(const std::string& request, const std::string& answer, const char* file = __builtin_FILE(),
            int line = __builtin_LINE()) {
    sends(request, file, line);
    receives(answer);
  }
  /// Nobody answers.
  void staysSilent() {
    ASSERT_TRUE(master.nextDeadline());
    now = *master.nextDeadline();
    master.handleTimeout(now);
  }
  void isQuiet(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    testing::ScopedTrace trace(file, line, "isQuiet");
    EXPECT_FALSE(master.wantsBus(now));
    EXPECT_EQ("", toHex(master.pollTransmit(now)));
  }
  void arrives(const std::string& hex) { master.handleBytes(fromHex(hex), now); }

  /// Up to the moment the record is to be sent, with FC 7C.
  void connects() {
    asks(kInitiate6C, "E5");
    asks(kManagerPoll5C, "E5");
    asks(kManagerPoll7C, kGrant);
    asks(kServerPoll5C, kAccepted);
    EXPECT_TRUE(master.isConnected(0));
  }
  RecordResult result(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    testing::ScopedTrace trace(file, line, "result");
    const auto found = master.pollRecord();
    EXPECT_TRUE(found) << "no result";
    return found.value_or(RecordResult{});
  }
  std::string trouble() const { return master.trouble(0).str(); }

  Class2Master master;
  Instant now{std::chrono::hours{1}};

 private:
  BusParameters bus_;
};

}  // namespace nord_driver::profibus
