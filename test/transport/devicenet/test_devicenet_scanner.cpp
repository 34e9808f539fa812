// Who is on a simulated DeviceNet bus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "devicenet/identifier.h"
#include "sim/devicenet/dn_config.h"
#include "sim/devicenet/simulated_dn_bus.h"
#include "support/map_settings.h"
#include "transport/can/interrupted_bus.h"
#include "transport/devicenet/devicenet.h"

namespace nord_driver {
namespace {

using devicenet::Group2;
using test::InterruptedBus;
using test::Interruption;
using test::MapSettings;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::atomic<bool> kNotAsked{false};

class ScannedBus final : public sim::SimulatedDnBus {
 public:
  ScannedBus(const sim::SimConfig& config, std::vector<CanFrame>& sent, const std::vector<CanFrame>& foreign)
      : SimulatedDnBus(config), foreign_(foreign) {
    setTap([&sent](const CanFrame& frame, Sender sender, Instant) {
      if (sender == Sender::kMaster) sent.push_back(frame);
    });
  }
  bool open() noexcept override {
    const bool opened = SimulatedDnBus::open();
    for (const CanFrame& frame : foreign_) inject(frame);
    return opened;
  }

 private:
  std::vector<CanFrame> foreign_;
};

sim::SimConfig twoModules() {
  sim::SimConfig config;
  config.bus = sim::DnBusConfig{};
  for (const int mac : {5, 63}) {
    sim::DriveConfig drive;
    drive.name = "drive" + std::to_string(mac);
    drive.address = static_cast<std::uint8_t>(mac);
    config.drives.push_back(drive);
  }
  return config;
}

ScanReport scan(std::vector<CanFrame>& sent, const std::vector<CanFrame>& foreign = {}) {
  DeviceNetTransport transport{
      [&](const link::CanSettings&) { return std::make_unique<ScannedBus>(twoModules(), sent, foreign); }};
  return transport.scan(MapSettings{"~bus/", {{"interface", std::string{"can0"}}}}, kNotAsked);
}

// The explicit connection alone is allocated, and released: no words reach an inverter.
TEST(DevicenetScanner, NamesTheModules) {
  std::vector<CanFrame> sent;
  const ScanReport report = scan(sent);
  EXPECT_THAT(report.trouble, IsEmpty());
  ASSERT_EQ(2u, report.stations.size());
  EXPECT_EQ(5u, report.stations[0].number);
  EXPECT_EQ(63u, report.stations[1].number);
  for (const FoundStation& station : report.stations) {
    EXPECT_EQ("vendor 1000, product 1", station.module);
    EXPECT_THAT(station.version, HasSubstr("device V1.2"));
    EXPECT_THAT(station.version, HasSubstr("inverter P707 = 20"));
    EXPECT_EQ("P742 = 1, P743 = 150", station.series);
  }
  std::map<unsigned, unsigned> last_service;  // by MAC id, of the unconnected messages
  for (const CanFrame& frame : sent) {
    const auto id = devicenet::readIdentifier(frame.id);
    ASSERT_TRUE(id && id->group == 2) << std::hex << frame.id;
    const auto message = static_cast<Group2>(id->message);
    EXPECT_TRUE(message == Group2::kDuplicateMac || message == Group2::kMasterExplicit ||
                message == Group2::kUnconnected)
        << std::hex << frame.id;
    if (message == Group2::kUnconnected && frame.size > 1) last_service[id->mac] = frame.data[1];
  }
  EXPECT_EQ(0x4Cu, last_service[5]) << "released";
  EXPECT_EQ(0x4Cu, last_service[63]) << "released";
}

// A poll command while it listens.
TEST(DevicenetScanner, SendsNothingBesideAnotherScanner) {
  std::vector<CanFrame> sent;
  const ScanReport report = scan(sent, {dataFrame(identifier(Group2::kMasterIo, 5), ByteView{})});
  EXPECT_THAT(report.trouble, HasSubstr("the bus is in use: 42Dh was seen"));
  EXPECT_THAT(sent, IsEmpty());
}

// What a driver that was killed has left turning stops by its own time-out before it is asked for anything.
TEST(DevicenetScanner, LeavesTheModulesToTheirOwnTimeOutFirst) {
  std::optional<Instant> first, asked;
  DeviceNetTransport transport{[&](const link::CanSettings&) {
    auto bus = std::make_unique<sim::SimulatedDnBus>(twoModules());
    bus->setTap([&](const CanFrame& frame, sim::SimulatedDnBus::Sender sender, Instant at) {
      const auto id = devicenet::readIdentifier(frame.id);
      if (sender != sim::SimulatedDnBus::Sender::kMaster || !id || id->group != 2) return;
      if (!first) first = at;
      if (!asked && static_cast<Group2>(id->message) == Group2::kUnconnected) asked = at;
    });
    return bus;
  }};
  const MapSettings bus{"~bus/", {{"interface", std::string{"can0"}}, {"expected_packet_rate", 1.5}}};
  const ScanReport report = transport.scan(bus, kNotAsked);
  EXPECT_EQ(2u, report.stations.size());
  ASSERT_TRUE(first && asked);
  EXPECT_GE(*asked - *first, std::chrono::milliseconds{6490});
}

// Before it is opened, and when the first answer of a module has come.
TEST(DevicenetScanner, SaysThatTheInterfaceIsGone) {
  for (const bool later : {false, true}) {
    DeviceNetTransport transport{[later](const link::CanSettings&) {
      auto bus = std::make_unique<sim::SimulatedDnBus>(twoModules());
      if (!later) bus->setInterfacePresent(false);
      bus->setTap([later, to = bus.get()](const CanFrame& frame, sim::SimulatedDnBus::Sender sender, Instant) {
        const auto id = devicenet::readIdentifier(frame.id);
        const bool answer = sender == sim::SimulatedDnBus::Sender::kNode && id && id->group == 2 &&
                            static_cast<Group2>(id->message) == Group2::kSlaveExplicit;
        if (later && answer) to->setInterfacePresent(false);
      });
      return bus;
    }};
    const ScanReport report = transport.scan(MapSettings{"~bus/", {{"interface", std::string{"can0"}}}}, kNotAsked);
    EXPECT_THAT(report.trouble, HasSubstr("interface")) << later;
  }
}

/// Over its explicit connection.
bool isAnswerOfAModule(const CanFrame& frame, sim::TimedCanBus::Sender sender) {
  const auto id = devicenet::readIdentifier(frame.id);
  return sender == sim::TimedCanBus::Sender::kNode && id && id->group == 2 &&
         static_cast<Group2>(id->message) == Group2::kSlaveExplicit;
}

// Who was not asked, or not heard, looks like one who is not there; and of a module that was found parameters are missing.
TEST(DevicenetScanner, AnInterfaceThatFailedOnTheWayIsNamedWithWhoWasFound) {
  for (const unsigned last : {6u, 20u}) {
    for (const bool bus_off : {false, true}) {
      for (const bool comes_back : {false, true}) {
        DeviceNetTransport transport{[&](const link::CanSettings&) {
          return std::make_unique<InterruptedBus<sim::SimulatedDnBus>>(
              twoModules(), Interruption{last, bus_off, comes_back}, isAnswerOfAModule);
        }};
        const ScanReport report = transport.scan(MapSettings{"~bus/", {{"interface", std::string{"can0"}}}}, kNotAsked);
        EXPECT_THAT(report.trouble, HasSubstr(bus_off ? "the controller is bus-off" : "the interface is down"))
            << last << comes_back;
        EXPECT_FALSE(report.stations.empty()) << last << bus_off << comes_back;
      }
    }
  }
}

// So long nothing is said on the bus, and nobody could tell why.
TEST(DevicenetScanner, TellsThatItAsksNobodyForLong) {
  const DeviceNetTransport transport{};
  const auto quiet = [&](double rate) {
    return transport.quiet(MapSettings{"~bus/", {{"interface", std::string{"can0"}}, {"expected_packet_rate", rate}}});
  };
  EXPECT_EQ(
      "no device is asked for 8.5 s: by expected_packet_rate its own time-out must have run out, whoever had it before "
      "may have left its motor turning",
      quiet(2.0));
  EXPECT_EQ("", quiet(0.5));
  EXPECT_EQ("", transport.quiet(MapSettings{"~bus/", {{"interface", std::string{"can0"}}}}));
}

}  // namespace
}  // namespace nord_driver
