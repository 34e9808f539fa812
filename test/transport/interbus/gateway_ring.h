// The InterBus transport on the simulated gateway, over TCP connections of the loopback.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "sim/interbus/gateway_bus.h"
#include "transport/interbus/interbus.h"
#include "transport/interbus/interbus_settings.h"

namespace nord_driver::test {

/// Inputs at register 0, outputs at 100, running at 200, watchdog at 300, PCP at 500 and 600.
inline sim::SimConfig gatewayRing() {
  sim::IbsBusConfig bus;
  bus.output_address = 100;
  bus.running = sim::IbsRunning{200, 1, 1};
  bus.watchdog = 300;
  bus.pcp = sim::IbsPcp{500, 600, 2, true};
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

class GatewayRing : public ::testing::Test {
 protected:
  explicit GatewayRing(const sim::SimConfig& config = gatewayRing()) : sim(config) {
    settings.bus.set("gateway", sim.where()).set("outputs/address", 100).set("running/address", 200);
    settings.bus.set("watchdog/address", 300).set("watchdog/value", 2000);
  }
  ~GatewayRing() override { transport.close(); }

  void start() {
    transport.configure(settings.bus, settings.drives, 100.0);
    transport.setDriveTimeout(std::chrono::milliseconds{500});  // this machine may be busy
  }
  /// Cycles until it holds; false after 20 s.
  bool runUntil(const std::function<bool()>& condition) {
    const Instant end = transport.now() + std::chrono::seconds{20};
    while (transport.now() < end) {
      const Instant start = transport.now();
      transport.exchange(outputs, inputs);
      if (condition()) return true;
      transport.sleepUntil(start + std::chrono::milliseconds{10});
    }
    return false;
  }
  bool allAnswer() {
    return runUntil([&] { return inputs[0].inverter_answers && inputs[1].inverter_answers; });
  }
  profile::ParameterResult ask(profile::ParameterRequest request, DriveIndex drive = 0) {
    std::optional<profile::ParameterResult> result;
    EXPECT_TRUE(transport.submit(drive, request));
    EXPECT_TRUE(runUntil([&] {
      result = transport.pollResult();
      return result.has_value();
    }));
    return result.value_or(profile::ParameterResult{});
  }
  std::uint64_t writes() {
    return sim.withGateway([](sim::IbsRing&, sim::RegisterGateway& gateway) { return gateway.writes(); });
  }

  sim::GatewayBus sim;
  InterbusSettings settings;
  InterbusTransport transport;
  std::vector<profile::ProcessOutput> outputs{2};
  std::vector<DriveExchange> inputs{2};
};

}  // namespace nord_driver::test
