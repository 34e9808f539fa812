// Who is on a simulated CANopen bus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "sim/canopen/can_config.h"
#include "sim/canopen/simulated_can_bus.h"
#include "support/map_settings.h"
#include "transport/canopen/canopen.h"

namespace nord_driver {
namespace {

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

}  // namespace
}  // namespace nord_driver
