#include <gtest/gtest.h>

#include <cstdlib>
#include <deque>
#include <random>

#include "canopen/scripted_sdo_server.h"
#include "canopen/sdo_abort.h"
#include "canopen/sdo_client.h"

namespace nord_driver::canopen {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// What the bus does to a frame, in percent.
struct Bus {
  unsigned lost = 0, repeated = 0, flipped = 0;
};

/// A client, a server and a bus that loses, repeats and changes frames.
class BadBus {
 public:
  BadBus(std::uint32_t seed, const Bus& bus) : random_{seed}, bus_(bus) {}

  /// The answer, or nothing when the transfer did not end within a sane time.
  std::optional<SdoAnswer> ask(const SdoRequest& request, const Bytes& data) {
    EXPECT_TRUE(client.start(request, data, now_));
    for (int step = 0; step < 5000; ++step) {
      CanFrame frame;
      while (client.pollTransmit(frame)) toServer(frame);
      if (const auto answer = client.takeAnswer()) return answer;
      if (!to_client_.empty()) {
        client.handle(dataFrame(0x5B2, to_client_.front()), now_);
        to_client_.pop_front();
      } else {
        now_ = *client.nextDeadline();
        client.poll(now_);
      }
    }
    return std::nullopt;
  }
  unsigned below(unsigned limit) { return static_cast<unsigned>(random_() % limit); }
  Bytes bytes(std::size_t size) {
    Bytes made(size);
    for (auto& byte : made) byte = static_cast<std::uint8_t>(random_());
    return made;
  }

  SdoClient client{defaultSdoChannel(0x32), std::chrono::milliseconds{50}};
  ScriptedSdoServer server;
  bool flip_segments_only = false;

 private:
  bool strikes(unsigned percent) { return below(100) < percent; }

  void toServer(const CanFrame& frame) {
    if (strikes(bus_.lost)) return;
    const int times = strikes(bus_.repeated) ? 2 : 1;
    for (int i = 0; i < times; ++i) {
      for (const auto& answer : server.handle(frame.data)) toClient(answer);
    }
  }
  void toClient(SdoBytes frame) {
    if (strikes(bus_.lost)) return;
    // An initiation says what comes, and nothing checks it; a block's segments and its end are under the check sum.
    const bool segment = frame[0] < 0x80 + 33 || (frame[0] & 0xE1) == 0xC1;
    if (strikes(bus_.flipped) && (!flip_segments_only || (in_block_ && segment))) {
      const unsigned bit = 1u << below(8);
      std::uint8_t& byte = frame[below(8)];
      byte = static_cast<std::uint8_t>(byte ^ bit);
    }
    in_block_ = in_block_ || (frame[0] & 0xE1) == 0xC0;
    to_client_.push_back(frame);
    if (strikes(bus_.repeated)) to_client_.push_back(frame);
  }

 public:
  bool in_block_ = false;

 private:
  std::mt19937 random_;
  Bus bus_;
  Instant now_{std::chrono::hours{1}};
  std::deque<SdoBytes> to_client_;
};

SdoRequest readOf(std::uint16_t index, bool block) {
  SdoRequest request = sdoRead(1, index, 0);
  request.block = block;
  return request;
}

SdoRequest writeOf(std::uint16_t index, bool block) {
  SdoRequest request = readOf(index, block);
  request.write = true;
  return request;
}

constexpr std::size_t kSizes[] = {1, 2, 4, 5, 7, 8, 14, 20, 28, 29, 100, 223, 224, 225, 700, 1021, 1022};

// On a good bus every size gets there and back, in plain and in blocks, whatever the server can do.
TEST(SdoRandom, EverySizeOnAGoodBus) {
  BadBus bus{1, {}};
  for (const std::size_t size : kSizes) {
    for (unsigned kind = 0; kind < 16; ++kind) {
      bus.server.blocks = (kind & 1) != 0;
      bus.server.checks = (kind & 2) != 0;
      bus.server.tells_size = (kind & 4) != 0;
      const bool block = (kind & 8) != 0;
      const Bytes data = bus.bytes(size);
      const auto written = bus.ask(writeOf(0x2000, block), data);
      ASSERT_TRUE(written && written->ok()) << size << ' ' << kind;
      ASSERT_EQ(data, bus.server.objects[0x200000]) << size << ' ' << kind;
      const auto read = bus.ask(readOf(0x2000, block), {});
      ASSERT_TRUE(read && read->ok()) << size << ' ' << kind << ' ' << (read ? abortText(read->abort_code) : "");
      ASSERT_TRUE(ByteView{data} == read->data) << size << ' ' << kind;
    }
  }
  EXPECT_EQ(0u, bus.client.counters().stale);
}

// Losses and repetitions: a transfer ends, and what is said to be good is good. Two objects in turns, since a late
// answer to the same access to the same object cannot be told from a new one.
TEST(SdoRandom, LossAndRepetitionNeverGiveAWrongValue) {
  unsigned good = 0, bad = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    BadBus bus{seed, {seed % 4, seed % 5 * 2, 0}};
    for (unsigned i = 0; i < 40; ++i) {
      const auto index = static_cast<std::uint16_t>(0x2000 + i % 2);
      const Bytes data = bus.bytes(kSizes[bus.below(std::size(kSizes))]);
      const bool block = bus.below(2) == 0;
      if (bus.below(2) == 0) {
        bus.server.objects[static_cast<std::uint32_t>(index) << 8] = data;
        const auto read = bus.ask(readOf(index, block), {});
        ASSERT_TRUE(read) << "hangs, seed " << seed;
        if (read->ok()) {
          ASSERT_TRUE(ByteView{data} == read->data) << "seed " << seed;
        }
        ++(read->ok() ? good : bad);
      } else {
        const auto written = bus.ask(writeOf(index, block), data);
        ASSERT_TRUE(written) << "hangs, seed " << seed;
        if (written->ok()) {
          ASSERT_EQ(data, bus.server.objects[static_cast<std::uint32_t>(index) << 8]) << "seed " << seed;
        }
        ++(written->ok() ? good : bad);
      }
    }
  }
  EXPECT_GT(good, 1200u);
  EXPECT_GT(bad, 50u);
}

// Changed bits in the segments of a block: the check sum finds them all. (CAN has a check sum of its own; this is what
// SDO adds. Outside of blocks nothing in the protocol can tell a changed value.)
TEST(SdoRandom, ChangedBitsInABlockAreFound) {
  unsigned good = 0, bad = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    BadBus bus{seed, {0, 0, 1 + seed % 3}};
    bus.flip_segments_only = true;
    for (unsigned i = 0; i < 20; ++i) {
      const Bytes data = bus.bytes(29 + bus.below(900));
      bus.server.objects[0x200000 | (i % 2) << 8] = data;
      bus.in_block_ = false;
      const auto read = bus.ask(readOf(static_cast<std::uint16_t>(0x2000 + i % 2), true), {});
      ASSERT_TRUE(read) << "hangs, seed " << seed;
      if (read->ok()) {
        ASSERT_TRUE(ByteView{data} == read->data) << "seed " << seed;
      }
      ++(read->ok() ? good : bad);
    }
  }
  EXPECT_GT(good, 100u);
  EXPECT_GT(bad, 100u);
}

// Anything at all in every frame: every transfer ends, and never with more than fits.
TEST(SdoRandom, ChangedBitsAnywhereNeverHang) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    BadBus bus{seed, {seed % 3, seed % 3, 20}};
    for (unsigned i = 0; i < 40; ++i) {
      const Bytes data = bus.bytes(1 + bus.below(300));
      bus.server.objects[0x200000] = data;
      const bool block = bus.below(2) == 0;
      const auto answer =
          bus.below(2) == 0 ? bus.ask(readOf(0x2000, block), {}) : bus.ask(writeOf(0x2000, block), data);
      ASSERT_TRUE(answer) << "hangs, seed " << seed;
      ASSERT_LE(answer->data.size(), kSdoCapacity);
    }
  }
}

}  // namespace
}  // namespace nord_driver::canopen
