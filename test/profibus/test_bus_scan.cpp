#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "profibus/bus_scan.h"
#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

/// Answers by request, both as hexadecimal bytes; whatever is not in the table stays silent.
struct Line {
  std::map<std::string, std::string> answers;
  std::vector<std::string> requests{};
  Instant now{1h};
  std::size_t deaf = 0;  ///< nobody answers before so many requests: the baud rate is looked for

  /// How often something was sent.
  std::ptrdiff_t sent(const std::string& request) const {
    return std::count(requests.begin(), requests.end(), request);
  }

  void run(BusScan& scan) {
    Instant free = now;
    const Instant limit = now + 60s;
    while (!scan.done() && now < limit) {
      const ByteView sent = scan.pollTransmit(now);
      if (sent.empty()) {
        ASSERT_TRUE(scan.nextDeadline());
        now = std::max(now, *scan.nextDeadline());
        scan.handleTimeout(now);
        continue;
      }
      EXPECT_GE(now - free, BaudRate{19'200}.bits(33));
      now += BaudRate{19'200}.characters(sent.size());
      requests.push_back(toHex(sent));
      const auto found = answers.find(requests.back());
      if (found != answers.end() && requests.size() > deaf) {
        now += 1ms;
        scan.handleBytes(fromHex(found->second), now);
      }
      free = now;
    }
    EXPECT_TRUE(scan.done());
  }
};

// Every address but our own is asked, those that are silent again; a slave tells its ident number and its master.
TEST(BusScan, FindsEverybody) {
  Line line{{
      {kFdlStatus8, kHere8},
      {kDiag6D, kWantsPrm},
      {kFdlStatus9, kHere9},
      {kDiag9of6D, "68 0B 0B 68 81 89 08 3E 3C 00 0C 00 03 0B A8 4E 16"},
      {"10 02 01 49 4C 16", "10 01 02 30 33 16"},
      {"10 7E 01 49 C8 16", "10 01 7E 00 7F 16"},
      {"68 05 05 68 FE 81 6D 3C 3E 66 16", "68 0B 0B 68 81 FE 08 3E 3C 02 05 00 FF 0B A8 BA 16"},
  }};
  BusScan scan{quietBus()};
  scan.start(line.now);
  line.run(scan);
  EXPECT_STREQ("is a slave with the ident number 7531h", describe(8, scan.station(8)).c_str());
  EXPECT_STREQ("is a slave with the ident number 0BA8h, parameterised by master 3",
               describe(9, scan.station(9)).c_str());
  EXPECT_EQ(ScannedStation::Kind::kMaster, scan.station(2).kind);
  EXPECT_EQ(ScannedStation::Kind::kSelf, scan.station(1).kind);
  EXPECT_STREQ("is a slave with the ident number 0BA8h, not addressed yet: set its address to 3 to 125",
               describe(126, scan.station(126)).c_str());
  EXPECT_EQ(ScannedStation::Kind::kSilent, scan.station(0).kind);
  EXPECT_EQ(ScannedStation::Kind::kSilent, scan.station(125).kind);
  for (const auto& [request, answer] : line.answers) EXPECT_EQ(1, line.sent(request)) << request;
  EXPECT_GE(line.sent("10 00 01 49 4A 16"), 2);
  EXPECT_GE(line.sent("10 7D 01 49 C7 16"), 2);
  EXPECT_EQ("10 00 01 49 4A 16", line.requests.front());
  EXPECT_FALSE(scan.refusedBy());
}

// A module that looks for the baud rate answers only when it has heard some telegrams (BU 2700, P181): station 3 was asked
// long before that.
TEST(BusScan, FindsAModuleThatLooksForTheBaudRate) {
  for (const std::size_t telegrams : {12u, 100u}) {
    Line line{{{"10 03 01 49 4D 16", "10 01 03 00 04 16"}}};
    line.deaf = telegrams;
    BusScan scan{quietBus()};
    scan.start(line.now);
    line.run(scan);
    EXPECT_EQ(ScannedStation::Kind::kSlave, scan.station(3).kind) << telegrams;
  }
}

// On a fast line a round is over before such a module has begun to look.
TEST(BusScan, GoesOnForTwoSeconds) {
  Line line{{}};
  BusScan scan{quietBus()};
  const Instant begin = line.now;
  scan.start(line.now);
  line.run(scan);
  EXPECT_GE(line.now - begin, BusScan::kSearch);
  EXPECT_EQ(0u, line.requests.size() % 126u) << "whole rounds";
}

// A slave that does not tell its diagnosis is still there; a station that answers nonsense is named.
TEST(BusScan, NamesWhatIsWrong) {
  Line line{{{kFdlStatus8, kHere8}, {kFdlStatus9, kHere8}}};
  BusScan scan{quietBus()};
  scan.start(line.now);
  line.run(scan);
  EXPECT_STREQ("is a slave that does not tell its diagnosis", describe(8, scan.station(8)).c_str());
  EXPECT_EQ(ScannedStation::Kind::kGarbled, scan.station(9).kind);
}

// With another master on the segment not one telegram is sent.
TEST(BusScan, RefusesBesideAnotherMaster) {
  BusParameters bus = quietBus();
  bus.listen_first = 200ms;
  BusScan scan{bus};
  Line line{{}};
  scan.start(line.now);
  EXPECT_TRUE(scan.pollTransmit(line.now + 100ms).empty());
  scan.handleBytes(fromHex("DC 05 05"), line.now + 100ms);
  EXPECT_FALSE(scan.done()) << "three bytes may be noise";
  scan.handleBytes(fromHex("DC 05 05"), line.now + 120ms);
  EXPECT_TRUE(scan.done());
  EXPECT_EQ(5, scan.refusedBy().value_or(255));
  EXPECT_EQ(0u, scan.counters().telegrams_sent);

  scan.start(line.now);
  EXPECT_EQ(line.now + 200ms, scan.nextDeadline().value_or(Instant{}));
  line.run(scan);
  EXPECT_FALSE(scan.refusedBy());
  EXPECT_GE(line.requests.size(), 2u * 126u);
}

// Who only looks on ends it for another master that comes later, and not for its own telegram that an adapter hands back;
// a driver does not end it.
TEST(BusScan, GivesWayToAnotherMaster) {
  constexpr const char* kOfMaster3 = "10 08 03 49 54 16";
  for (const bool looks_on : {true, false}) {
    BusParameters bus = quietBus();
    bus.listen_first = 200ms;
    bus.gives_way = looks_on;
    BusScan scan{bus};
    Instant now{1h};
    scan.start(now);
    now += 200ms;
    scan.handleTimeout(now);
    now += 10ms;
    const std::string first = toHex(scan.pollTransmit(now));
    EXPECT_EQ("10 00 01 49 4A 16", first);
    now += 5ms;
    scan.handleBytes(fromHex(first), now);
    EXPECT_FALSE(scan.done());
    scan.handleBytes(fromHex(std::string{kOfMaster3} + " 10 01 00 00 01 16"), now);
    EXPECT_EQ(looks_on, scan.done());
    EXPECT_EQ(looks_on ? 3 : 255, scan.refusedBy().value_or(255));
    now += 1s;
    scan.handleTimeout(now);
    EXPECT_EQ(looks_on, scan.done());
    EXPECT_EQ(looks_on, scan.pollTransmit(now).empty());
    EXPECT_EQ(looks_on, !scan.nextDeadline());
  }
}

// A line that never falls silent ends the scan instead of holding it up.
TEST(BusScan, BabblingLine) {
  BusScan scan{quietBus()};
  Instant now{1h};
  scan.start(now);
  const Instant begin = now;
  while (!scan.done() && now < begin + 10s) {
    now += 1ms;
    scan.handleBytes(fromHex("55 55"), now);
    scan.handleTimeout(now);
    ASSERT_TRUE(scan.pollTransmit(now).empty());
  }
  EXPECT_TRUE(scan.done());
  EXPECT_TRUE(scan.lineBusy());
}

}  // namespace
}  // namespace nord_driver::profibus
