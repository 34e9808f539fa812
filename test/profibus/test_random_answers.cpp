#include <gtest/gtest.h>

#include <random>

#include "profibus/nord_wire.h"
#include "profibus/vectors.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

/// Station 8 as a slave that mostly behaves, and sometimes sends anything; nobody at station 9.
class Babbler {
 public:
  explicit Babbler(std::uint32_t seed) : random_{seed} {}

  std::vector<std::uint8_t> answer(ByteView request, bool behave) {
    std::vector<std::uint8_t> bytes = fromHex(legalAnswer(request));
    if (behave || below(4) != 0) return bytes;
    switch (below(6)) {
      case 0:
        bytes.resize(below(300));
        for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random_());
        break;
      case 1:
        return fromHex(validTelegrams()[below(static_cast<unsigned>(validTelegrams().size()))]);
      case 2:
        return fromHex(invalidTelegrams()[below(static_cast<unsigned>(invalidTelegrams().size()))]);
      case 3:
        return {};
      case 4:
        phase_ = 0;
        return fromHex(kNotActivated);
      default:
        if (!bytes.empty()) {
          const unsigned bit = 1u << below(8);
          std::uint8_t& byte = bytes[below(static_cast<unsigned>(bytes.size()))];
          byte = static_cast<std::uint8_t>(byte ^ bit);
        }
    }
    return bytes;
  }
  unsigned below(unsigned limit) { return static_cast<unsigned>(random_() % limit); }

 private:
  const char* legalAnswer(ByteView request) {
    if (request == ByteView{fromHex(kFdlStatus8)}) return kHere8;
    if (request.size() < 9 || request[0] != 0x68) return "";
    if (request[4] == 0x08) return phase_ == 2 ? kInputs : kNotActivated;
    if (request[4] != 0x88) return "";
    switch (request[7]) {
      case 0x3C:
        return phase_ == 2 ? kReady : kWantsPrm;
      case 0x3D:
        phase_ = 1;
        return kShortAcknowledge;
      case 0x3E:
        phase_ = phase_ == 0 ? 0 : 2;
        return kShortAcknowledge;
      default:
        return "";
    }
  }

  std::mt19937 random_;
  int phase_ = 0;  // 0 wants parameters, 1 wants its configuration, 2 data exchange
};

/// Runs cycles until `end`; the referee sees that every pause is kept and no cycle lasts for ever.
class Segment {
 public:
  explicit Segment(std::uint32_t seed) : babbler_{seed}, bus_{bus(seed)}, master{bus_, {nordModule(8), nordModule(9)}} {
    master.restart(now);
  }

  void cycle(bool behave) {
    const Instant begin = now;
    master.startCycle(now);
    while (!master.cycleDone()) {
      const ByteView sent = master.pollTransmit(now);
      if (!sent.empty()) {
        EXPECT_GE((now - line_free_).count(), bus_.baud.bits(33).count());
        now += bus_.baud.characters(sent.size());
        line_free_ = now;
        transmit(babbler_.answer(sent, behave));
      } else if (const auto deadline = master.nextDeadline()) {
        now = std::max(now, *deadline);
        master.handleTimeout(now);
      }
      ASSERT_LT(now - begin, 5s) << "the cycle does not end";
    }
    if (!behave && babbler_.below(200) == 0) master.restart(now);
    now += std::chrono::milliseconds{babbler_.below(50)};
  }

 private:
  static BusParameters bus(std::uint32_t seed) {
    BusParameters parameters = quietBus();
    if (seed % 2 == 0) parameters.operate_interval = 100ms;
    return parameters;
  }

  void transmit(const std::vector<std::uint8_t>& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t count = 1 + babbler_.below(40);
      now += bus_.baud.bits(11 + babbler_.below(60));
      line_free_ = now;
      master.handleBytes(ByteView{bytes}.sub(at, count), now);
      at += count;
    }
  }

  Babbler babbler_;
  BusParameters bus_;
  Instant line_free_{1h};

 public:
  Instant now{1h};
  DpMaster master;
};

// Whatever the other end sends: no cycle lasts for ever, every pause is kept, every byte and every slot is accounted
// for, and a slave that behaves again is back in data exchange after the longest pause (2 s) and its start-up.
TEST(RandomAnswers, NeverHoldTheMasterUp) {
  std::uint64_t exchanges = 0, losses = 0, retries = 0, refusals = 0;
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Segment segment{seed};
    for (int cycle = 0; cycle < 200; ++cycle) segment.cycle(false);

    const ReceiverCounters& bytes = segment.master.counters().receiver;
    EXPECT_LE(bytes.bytes_in_telegrams + bytes.bytes_discarded, bytes.bytes_received);
    EXPECT_LT(bytes.bytes_received - bytes.bytes_in_telegrams - bytes.bytes_discarded, kMaxTelegramLength);
    const SlaveCounters& slave = segment.master.status(0).counters;
    EXPECT_EQ(slave.requests, slave.answers + slave.timeouts);
    EXPECT_LE(slave.exchanges, slave.answers);
    EXPECT_EQ(0u, segment.master.status(1).counters.answers);
    exchanges += slave.exchanges;
    losses += slave.losses;
    retries += slave.retries;
    refusals += slave.refusals;

    const Instant good = segment.now;
    while (!segment.master.status(0).exchanged_this_cycle && segment.now < good + 10s) segment.cycle(true);
    EXPECT_LT(segment.now - good, 3s);
  }
  // The test means nothing if the slave never got far enough to be disturbed.
  EXPECT_GT(exchanges, 5'000u);
  EXPECT_GT(losses, 500u);
  EXPECT_GT(retries, 500u);
  EXPECT_GT(refusals, 100u);
}

}  // namespace
}  // namespace nord_driver::profibus
