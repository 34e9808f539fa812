#include <gtest/gtest.h>

#include <random>

#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint32_t kSequences = 1500;
/// The duplicate-MAC check, and a second of silence before it when it was in a communication fault.
constexpr Duration kCheck = seconds{3};
constexpr Duration kBack = seconds{2};
/// A fragmented request that lost its acknowledge is asked for a second time after one second. Before that it may have to
/// wait for a transaction id that is owed a late answer.
constexpr Duration kLongestLateness = seconds{5};
constexpr Duration kPatience = seconds{3} + kLongestLateness;

ScannerConfig mixed(std::uint32_t seed) {
  ScannerConfig config = busConfig(0);
  constexpr std::array<IoKind, 4> kKinds{IoKind::kPoll, IoKind::kStrobe, IoKind::kChangeOfState, IoKind::kCyclic};
  const IoKind kind = kKinds[seed % 4];
  // A bit strobe brings eight bytes at most; what goes out beside it may be nothing, or take fragments.
  constexpr std::array<std::size_t, 3> kBesideStrobe{0, 8, 33};
  const std::size_t in = kind == IoKind::kStrobe ? 8 : 33;
  const std::size_t out = kind == IoKind::kStrobe ? kBesideStrobe[seed / 4 % 3] : 33;
  config.nodes = {nodeConfig(5), nodeConfig(6, kind, in, out)};
  config.nodes[1].io.acknowledge = seed % 8 < 4;
  return config;
}

/// A bus on which everything goes wrong for a while.
class Chaos {
 public:
  explicit Chaos(std::uint32_t seed) : random_{seed}, run_{mixed(seed)} {
    run_.loses = [this](const CanFrame& frame) { return loses(frame); };
    run_.on_sent = [this](const CanFrame& frame) {
      EXPECT_TRUE(frame.id == 0x407 || run_.scanner.busState() == BusState::kOnline) << text(frame);
    };
    run_.doubles = [this](const CanFrame&) { return !calm_ && chance(15); };
    for (auto& device : run_.devices) {
      device->attributes[{4, 100, 3}] = std::vector<std::uint8_t>(33, 1);
      device->strict_about_sizes = true;
    }
  }

  void play() {
    run_.output.assign(33, 0x11);
    run_.begin();
    for (int i = 0; i < 6000; ++i) {
      disturb();
      step();
    }
    calm();
    const Instant since = run_.now;
    const bool in_check = run_.scanner.busState() != BusState::kOnline;
    EXPECT_TRUE(run_.runUntil([this] { return serves(); }, kBack + (in_check ? kCheck : Duration{})))
        << run_.scanner.status(0).reason.c_str() << " / " << run_.scanner.status(1).reason.c_str() << " after "
        << toSeconds(run_.now - since);
    run_.runUntil(
        [this] {
          drain();
          return answered_ >= asked_;
        },
        kPatience);
    EXPECT_EQ(asked_, answered_) << "one answer for each request";
    judge();
  }

 private:
  bool chance(unsigned one_in) { return random_() % one_in == 0; }

  bool loses(const CanFrame& frame) {
    check(frame);
    if (calm_) return false;
    // Late: another frame comes before it.
    if (chance(20) && late_.size() < 8) {
      late_.push_back(frame);
      return true;
    }
    return chance(15);
  }
  /// No process data to a device that does not exchange.
  void check(const CanFrame& frame) {
    if (frame.id != 0x42D && frame.id != 0x435) return;
    EXPECT_EQ(NodeState::kExchanging, run_.scanner.status(frame.id == 0x42D ? 0 : 1).state);
  }
  void disturb() {
    FakeDevice& device = *run_.devices[random_() % 2];
    if (chance(800)) device.powerOff();
    if (!device.powered && chance(300)) device.powerOn();
    if (chance(400)) device.deaf_to_explicit = !device.deaf_to_explicit;
    if (chance(600)) device.deaf_to_io = !device.deaf_to_io;
    if (chance(300)) device.mute_acknowledges = !device.mute_acknowledges;
    if (chance(200)) run_.link_full = !run_.link_full;
    if (chance(50)) ask();
    if (chance(6)) run_.scanner.handleFrame(noise(), run_.now);
    if (chance(4000)) run_.scanner.handleBusLost("gone", run_.now);
    if (run_.scanner.busState() == BusState::kLost && chance(50)) run_.scanner.restart(run_.now);
    if (!late_.empty() && chance(10)) {
      run_.scanner.handleFrame(late_.back(), run_.now);
      late_.pop_back();
    }
    drain();
  }
  void ask() {
    const std::size_t node = random_() % 2;
    ExplicitRequest request = getAttribute(1, 4, 100, 3);
    if (chance(2)) request = setAttribute(1, 4, 100, 3, ByteView{std::vector<std::uint8_t>(33, 2)});
    if (run_.scanner.submit(node, request)) ++asked_;
  }
  void drain() {
    while (run_.scanner.pollAnswer()) ++answered_;
  }
  CanFrame noise() {
    static const std::array<std::uint32_t, 20> kIds{0x345, 0x346, 0x385, 0x386, 0x3C5, 0x3C6, 0x400,
                                                    0x401, 0x42A, 0x42B, 0x42C, 0x42D, 0x42E, 0x42F,
                                                    0x433, 0x434, 0x435, 0x436, 0x437, 0x4FB};
    CanFrame frame;
    frame.id = chance(8) ? static_cast<std::uint32_t>(random_() % 0x800) : kIds[random_() % kIds.size()];
    // A device with our MAC id, rarely: it stops everything for three seconds.
    if (frame.id == 0x407 && !chance(4)) frame.id = 0x409;
    if (chance(2500)) frame.id = 0x407;
    frame.size = static_cast<std::uint8_t>(random_() % 9);
    frame.remote = chance(20);
    frame.extended = chance(20);
    for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(chance(3) ? random_() : random_() % 6);
    static const std::array<std::uint8_t, 8> kServices{0xCB, 0xCC, 0x8E, 0x90, 0x94, 0xCD, 0xCE, 0x00};
    if (chance(2)) frame.data[1] = kServices[random_() % kServices.size()];
    return frame;
  }
  /// Losses are counted by what can be seen from outside.
  void step() {
    run_.step();
    for (const DevicenetEvent& event : run_.events) {
      if (event.node == kNoNode) continue;
      if (event.kind == DevicenetEventKind::kNodeExchanging) ++connections_[event.node];
      if (event.kind == DevicenetEventKind::kNodeLost) ++losses_[event.node];
    }
    run_.events.clear();
    run_.seen.clear();
  }
  void calm() {
    calm_ = true;
    run_.link_full = false;
    for (auto& device : run_.devices) {
      device->deaf_to_explicit = device->deaf_to_io = device->mute_acknowledges = false;
      if (!device->powered) device->powerOn();
    }
    if (run_.scanner.busState() == BusState::kLost) run_.scanner.restart(run_.now);
    for (std::size_t i = 0; i < 2; ++i) inputs_[i] = run_.scanner.input(i).count;
  }
  /// Process data go both ways now, and did for some time.
  bool serves() {
    bool all = run_.allExchanging();
    for (std::size_t i = 0; i < 2; ++i) {
      all = all && run_.devices[i]->established && run_.now - run_.scanner.input(i).at < milliseconds{100};
    }
    good_ = all ? good_ + 1 : 0;
    return good_ >= 100;
  }
  void judge() {
    for (const DevicenetEvent& event : run_.events) {
      if (event.node == kNoNode) continue;
      if (event.kind == DevicenetEventKind::kNodeExchanging) ++connections_[event.node];
      if (event.kind == DevicenetEventKind::kNodeLost) ++losses_[event.node];
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const NodeCounters& counters = run_.scanner.status(i).counters;
      EXPECT_EQ(connections_[i], counters.connections);
      EXPECT_EQ(losses_[i], counters.losses);
      EXPECT_EQ(counters.connections, counters.losses + 1) << "every loss is counted, and it runs now";
    }
  }

  std::mt19937 random_;
  ScannerRun run_;
  bool calm_ = false;
  int good_ = 0;
  std::vector<CanFrame> late_;
  std::size_t asked_ = 0, answered_ = 0;
  std::array<std::uint64_t, 2> connections_{}, losses_{}, inputs_{};
};

// Frames lost, doubled, late and foreign, devices off and deaf, a link without room, a bus that goes away, in many
// mixtures: no process data to a device that does not exchange, one answer for each request, every loss counted, no
// connection stuck: back within 2 s, and the duplicate-MAC check when it was under way.
TEST(RandomFrames, NothingIsStuck) {
  for (std::uint32_t seed = 1; seed <= kSequences && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chaos{seed}.play();
  }
}

}  // namespace
}  // namespace nord_driver::devicenet
