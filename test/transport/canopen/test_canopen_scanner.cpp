// Who is on a simulated CANopen bus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <utility>

#include "sim/canopen/can_config.h"
#include "sim/canopen/simulated_can_bus.h"
#include "support/map_settings.h"
#include "transport/can/interrupted_bus.h"
#include "transport/canopen/canopen.h"

namespace nord_driver {
namespace {

using test::InterruptedBus;
using test::Interruption;
using test::MapSettings;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::atomic<bool> kNotAsked{false};

/// Every frame the scan sends and what the nodes are when it has ended.
struct Seen {
  std::vector<std::uint32_t> sent;
};

class ScannedBus final : public sim::SimulatedCanBus {
 public:
  ScannedBus(const sim::SimConfig& config, Seen& seen, const std::vector<CanFrame>& foreign = {})
      : SimulatedCanBus(config), foreign_(foreign) {
    setTap([&seen](const CanFrame& frame, Sender sender, Instant) {
      if (sender == Sender::kMaster) seen.sent.push_back(frame.id);
    });
  }
  bool open() noexcept override {
    const bool opened = SimulatedCanBus::open();
    for (const CanFrame& frame : foreign_) inject(frame);
    return opened;
  }

 private:
  std::vector<CanFrame> foreign_;
};

sim::SimConfig twoNodes(int bit_rate) {
  sim::CanBusConfig bus;
  bus.bit_rate = static_cast<std::uint32_t>(bit_rate);
  sim::SimConfig config;
  config.bus = bus;
  for (const int id : {5, 127}) {
    sim::DriveConfig drive;
    drive.name = "drive" + std::to_string(id);
    drive.address = static_cast<std::uint8_t>(id);
    config.drives.push_back(drive);
  }
  return config;
}

ScanReport scan(Seen& seen, const std::vector<CanFrame>& foreign = {}, const std::atomic<bool>& end_asked = kNotAsked,
                int bit_rate = 250'000) {
  CanopenTransport transport{
      [&](const link::CanSettings&) { return std::make_unique<ScannedBus>(twoNodes(bit_rate), seen, foreign); }};
  return transport.scan(MapSettings{"~bus/", {{"interface", std::string{"can0"}}, {"bit_rate", bit_rate}}}, end_asked);
}

// By SDO alone: no node is led to another state, and none gets process data.
TEST(CanopenScanner, NamesTheNodes) {
  Seen seen;
  const ScanReport report = scan(seen);
  EXPECT_THAT(report.trouble, IsEmpty());
  ASSERT_EQ(2u, report.stations.size());
  EXPECT_EQ(5u, report.stations[0].number);
  EXPECT_EQ(127u, report.stations[1].number);
  for (const FoundStation& station : report.stations) {
    EXPECT_THAT(station.module, HasSubstr("NORD"));
    EXPECT_THAT(station.series, HasSubstr("P742 = 1, P743 = 150"));
    EXPECT_THAT(station.version, HasSubstr("inverter P707 = 20"));
    EXPECT_THAT(station.note, HasSubstr("vendor "));
  }
  for (const std::uint32_t id : seen.sent) EXPECT_TRUE(id > 0x600 && id <= 0x67F) << std::hex << id;
}

// P514: 127 requests take 1.5 s at 10 kbit/s, and each node has 0.3 s from its own on.
TEST(CanopenScanner, NamesTheNodesOfASlowBus) {
  for (const int bit_rate : {10'000, 20'000}) {
    Seen seen;
    const ScanReport report = scan(seen, {}, kNotAsked, bit_rate);
    EXPECT_THAT(report.trouble, IsEmpty());
    ASSERT_EQ(2u, report.stations.size()) << bit_rate;
    EXPECT_THAT(report.stations[1].series, HasSubstr("P742 = 1, P743 = 150"));
  }
}

// An RPDO while it listens.
TEST(CanopenScanner, SendsNothingBesideAnotherMaster) {
  Seen seen;
  const ScanReport report = scan(seen, {dataFrame(0x205, ByteView{})});
  EXPECT_THAT(report.trouble, HasSubstr("the bus is in use: 205h was seen"));
  EXPECT_THAT(seen.sent, IsEmpty());
}

TEST(CanopenScanner, EndsWhenAsked) {
  Seen seen;
  const std::atomic<bool> asked{true};
  EXPECT_EQ("ended before anybody was asked", scan(seen, {}, asked).trouble);
  EXPECT_THAT(seen.sent, IsEmpty());
}

/// What a scan says of an interface that `change` was done to before it is opened, or when the first frame leaves.
std::string troubleWith(const std::function<void(sim::SimulatedCanBus&)>& change, bool at_first_frame) {
  CanopenTransport transport{[&](const link::CanSettings&) {
    auto bus = std::make_unique<sim::SimulatedCanBus>(twoNodes(250'000));
    if (!at_first_frame) {
      change(*bus);
      return bus;
    }
    bus->setTap(
        [&change, seen = false, to = bus.get()](const CanFrame&, sim::SimulatedCanBus::Sender sender, Instant) mutable {
          if (sender == sim::SimulatedCanBus::Sender::kMaster && !std::exchange(seen, true)) change(*to);
        });
    return bus;
  }};
  return transport.scan(MapSettings{"~bus/", {{"interface", std::string{"can0"}}, {"bit_rate", 250'000}}}, kNotAsked)
      .trouble;
}

TEST(CanopenScanner, SaysWhatIsWrongWithTheInterface) {
  for (const bool later : {false, true}) {
    EXPECT_THAT(troubleWith([](auto& bus) { bus.setInterfacePresent(false); }, later), HasSubstr("interface")) << later;
  }
  EXPECT_THAT(troubleWith([](auto& bus) { bus.setInterfaceUp(false); }, false), HasSubstr("the interface is down"));
  EXPECT_THAT(troubleWith([](auto& bus) { bus.setBusOff(); }, false), HasSubstr("bus-off"));
}

// A queue that takes a frame now and then makes a scan longer, not poorer.
TEST(CanopenScanner, WaitsForAQueueThatIsFull) {
  EXPECT_THAT(troubleWith([](auto& bus) { bus.setQueuePace(std::chrono::milliseconds{3}); }, false), IsEmpty());
}

TEST(CanopenScanner, EndsWhenAnotherMasterBegins) {
  const auto begin = [](auto& bus) { bus.inject(dataFrame(0x205, FixedBytes<2>{0x7E, 0x04})); };
  EXPECT_EQ("another master began to work with the bus: 205h was seen; ended", troubleWith(begin, true));
}

bool isAnswerOfANode(const CanFrame& frame, sim::TimedCanBus::Sender) {
  return (frame.id & 0x780u) == 0x580;
}

// Who was not asked, or not heard, looks like one who is not there.
TEST(CanopenScanner, AnInterfaceThatFailedOnTheWayIsNamedWithWhoWasFound) {
  for (const bool bus_off : {false, true}) {
    for (const bool comes_back : {false, true}) {
      CanopenTransport transport{[&](const link::CanSettings&) {
        return std::make_unique<InterruptedBus<sim::SimulatedCanBus>>(
            twoNodes(250'000), Interruption{3, bus_off, comes_back}, isAnswerOfANode);
      }};
      const ScanReport report =
          transport.scan(MapSettings{"~bus/", {{"interface", std::string{"can0"}}, {"bit_rate", 250'000}}}, kNotAsked);
      EXPECT_THAT(report.trouble, HasSubstr(bus_off ? "the controller is bus-off" : "the interface is down"))
          << comes_back;
      ASSERT_EQ(2u, report.stations.size()) << bus_off << comes_back;
      EXPECT_THAT(report.stations[0].module, HasSubstr("device type"));
      EXPECT_THAT(report.stations[1].module, HasSubstr(comes_back ? "NORD" : "does not answer SDO"));
    }
  }
}

// A cable that was pulled: the interface is well, and its queue stays full.
TEST(CanopenScanner, SaysThatQuestionsDidNotLeave) {
  EXPECT_EQ("frames did not leave the interface", troubleWith([](auto& bus) { bus.setQueueFull(true); }, true));
}

/// Gives a place in its queue every 0.2 s, and can be waited for.
class SlowBus final : public sim::SimulatedCanBus {
 public:
  SlowBus() : SimulatedCanBus(twoNodes(250'000)) { setQueuePace(std::chrono::milliseconds{200}); }
  bool waitWritable(Instant until) noexcept override {
    sleepUntil(until);
    return true;
  }
};

// The whole scan has 20 s, and 127 questions take longer here.
TEST(CanopenScanner, SaysThatTheTimeWasNotEnough) {
  CanopenTransport transport{[](const link::CanSettings&) { return std::make_unique<SlowBus>(); }};
  const ScanReport report =
      transport.scan(MapSettings{"~bus/", {{"interface", std::string{"can0"}}, {"bit_rate", 250'000}}}, kNotAsked);
  EXPECT_EQ("ended before every node was asked", report.trouble);
  EXPECT_FALSE(report.stations.empty());
}

}  // namespace
}  // namespace nord_driver
