// The InterBus transport and its link against the simulated gateway, over a TCP connection of the loopback.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "sim/interbus/gateway_bus.h"
#include "transport/interbus/interbus.h"
#include "transport/interbus/interbus_settings.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

sim::SimConfig ringOfTwo() {
  sim::IbsBusConfig bus;
  bus.output_address = 100;
  bus.running = sim::IbsRunning{200, 1, 1};
  bus.watchdog = 300;
  sim::SimConfig config;
  config.bus = bus;
  for (std::uint8_t place = 1; place <= 2; ++place) {
    sim::DriveConfig drive;
    drive.name = "drive" + std::to_string(place - 1);
    drive.address = place;
    drive.bus = sim::IbsDriveConfig{};
    config.drives.push_back(drive);
  }
  return config;
}

class OnASimulatedGateway : public ::testing::Test {
 protected:
  OnASimulatedGateway() {
    settings.bus.set("gateway", sim.where()).set("outputs/address", 100).set("running/address", 200);
    settings.bus.set("watchdog/address", 300).set("watchdog/value", 2000);
    transport.configure(settings.bus, settings.drives, 100.0);
    transport.setDriveTimeout(milliseconds{500});  // this machine may be busy
  }
  ~OnASimulatedGateway() override { transport.close(); }

  /// Cycles until it holds; false after 20 s.
  bool runUntil(const std::function<bool()>& condition) {
    const Instant end = transport.now() + seconds{20};
    while (transport.now() < end) {
      const Instant start = transport.now();
      transport.exchange(outputs, inputs);
      if (condition()) return true;
      transport.sleepUntil(start + milliseconds{10});
    }
    return false;
  }
  bool shows(std::size_t drive, Word status) const {
    return inputs[drive].inverter_answers && inputs[drive].input.status_word == status;
  }

  sim::GatewayBus sim{ringOfTwo()};
  test::InterbusSettings settings;
  InterbusTransport transport;
  std::vector<profile::ProcessOutput> outputs{2};
  std::vector<DriveExchange> inputs{2};
};

// BU 0070 7.1 and 7.2: 0B70, 047E, 0B31, 047F 2000, then 0F37 but for the relay's bit 10.
TEST_F(OnASimulatedGateway, TheTelegramsOfTheManualDriveAnInverter) {
  ASSERT_TRUE(runUntil([&] { return shows(0, 0x0B70) && shows(1, 0x0B70); })) << transport.busText().c_str();
  outputs[0] = {0x047E, {}};
  ASSERT_TRUE(runUntil([&] { return shows(0, 0x0B31); }));
  EXPECT_TRUE(shows(1, 0x0B70)) << "the other one was told nothing";
  outputs[0] = {0x047F, {0x2000, 0, 0}};
  ASSERT_TRUE(runUntil([&] { return shows(0, 0x0B37) && inputs[0].input.actual_values[0] == 0x2000; }));
  EXPECT_TRUE(transport.connected());
  EXPECT_EQ("", transport.busText().str());
  EXPECT_EQ("no rule broken", sim.refereeReport());
}

TEST_F(OnASimulatedGateway, ARingThatStandsAndAServerThatRefusesAreNamed) {
  ASSERT_TRUE(runUntil([&] { return inputs[0].inverter_answers; })) << transport.busText().c_str();
  sim.withGateway([](sim::IbsRing& ring, sim::RegisterGateway&) { ring.setCut(true); });
  ASSERT_TRUE(runUntil([&] { return inputs[0].interruption == Interruption::kUnasked; }));
  EXPECT_THAT(transport.busText().str(), HasSubstr("its ring does not run (register 200 holds 0000h)"));
  sim.withGateway([](sim::IbsRing& ring, sim::RegisterGateway&) { ring.setCut(false); });
  ASSERT_TRUE(runUntil([&] { return inputs[0].inverter_answers; }));
  sim.withGateway([](sim::IbsRing&, sim::RegisterGateway& gateway) {
    gateway.setSwitches({false, {}, std::uint8_t{6}, 0});
  });
  ASSERT_TRUE(runUntil([&] { return inputs[0].interruption == Interruption::kSilent; }));
  EXPECT_THAT(transport.busText().str(), HasSubstr("exception 6"));
  sim.withGateway([](sim::IbsRing&, sim::RegisterGateway& gateway) { gateway.setSwitches({}); });
  EXPECT_TRUE(runUntil([&] { return inputs[0].inverter_answers; }));
}

TEST_F(OnASimulatedGateway, AServerThatFallsSilentIsLostAndFoundAgain) {
  ASSERT_TRUE(runUntil([&] { return inputs[0].inverter_answers; })) << transport.busText().c_str();
  sim.withGateway([](sim::IbsRing&, sim::RegisterGateway& gateway) { gateway.setSwitches({true, {}, {}, 0}); });
  ASSERT_TRUE(runUntil([&] { return inputs[0].interruption == Interruption::kSilent; }));
  ASSERT_TRUE(runUntil([&] { return transport.counters().value(bus_counter::kTimeouts) > 0; }));
  EXPECT_FALSE(transport.connected());
  sim.withGateway([](sim::IbsRing&, sim::RegisterGateway& gateway) { gateway.setSwitches({}); });
  EXPECT_TRUE(runUntil([&] { return inputs[0].inverter_answers; }));
}

// No answer but the one to the request that was asked.
TEST_F(OnASimulatedGateway, AnswersToOtherRequestsAreNoFreshData) {
  ASSERT_TRUE(runUntil([&] { return inputs[0].inverter_answers; })) << transport.busText().c_str();
  sim.withGateway([](sim::IbsRing&, sim::RegisterGateway& gateway) { gateway.setSwitches({false, {}, {}, 1}); });
  ASSERT_TRUE(runUntil([&] { return inputs[0].interruption == Interruption::kSilent; }));
  EXPECT_GT(transport.counters().value("bad_answers"), 0u);
  sim.withGateway([](sim::IbsRing&, sim::RegisterGateway& gateway) { gateway.setSwitches({}); });
  EXPECT_TRUE(runUntil([&] { return inputs[0].inverter_answers; }));
}

}  // namespace
}  // namespace nord_driver
