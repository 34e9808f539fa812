// nord_param behind a driver that was killed with a turning wheel on DeviceNet: the time-out in the module stops it.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "catalogue/shipped.h"
#include "sim/devicenet/simulated_dn_bus.h"
#include "support/can_text.h"
#include "tools/parameter_link.h"
#include "transport/devicenet/devicenet.h"

namespace nord_driver::tools {
namespace {

using std::chrono::milliseconds;

sim::SimConfig oneModule() {
  sim::SimConfig config;
  config.bus = sim::DnBusConfig{};
  sim::DriveConfig drive;
  drive.name = "left";
  drive.address = 5;
  drive.place = 1;
  drive.device.series = sim::Series::kSk2xxe;
  sim::DnDriveConfig module;
  module.kind = sim::DnModuleKind::kGateway;
  drive.bus = module;
  config.drives.push_back(drive);
  return config;
}

/// What MAC id 0 has said to MAC id 5, the last of it just now: 25 Hz, with an expected packet rate of 3 s.
void leaveItTurning(sim::SimulatedDnBus& bus) {
  const auto say = [&bus](const char* candump) {
    bus.inject(frame(candump));
    bus.sleepUntil(bus.now() + milliseconds{100});
  };
  bus.sleepUntil(bus.now() + std::chrono::seconds{3});  // its own check for its MAC id
  say("42E#004B03010300");
  say("42C#0010050209B80B");
  for (int i = 0; i < 10; ++i) say("42D#007E040000");
  for (int i = 0; i < 40; ++i) say("42D#007F040020");
  ASSERT_TRUE(bus.module(0).inDataExchange());
  ASSERT_DOUBLE_EQ(25.0, bus.drive(0).inverter().frequency());
}

// It is patient for as long as that takes, and the connection for process data is not released.
TEST(KilledDriver, OnDevicenetTheTimeOutOfTheModuleStopsItFirst) {
  const ToolConfig config = readToolConfig(
      YAML::Load("{cycle_rate: 100, left_wheel: left_wheel_joint, bus: {interface: can0, expected_packet_rate: 3.0},"
                 " drives: {left: {address: 5, series: sk2xxe, pole_pairs: 2}}}"),
      std::vector<std::string>{"left"});
  sim::SimulatedDnBus* bus = nullptr;
  std::optional<double> frequency;  // when the module was asked for something first
  DeviceNetTransport transport{[&](const link::CanSettings&) {
    auto made = std::make_unique<sim::SimulatedDnBus>(oneModule());
    bus = made.get();
    bus->open();
    leaveItTurning(*bus);
    bus->close();
    bus->setTap([&](const CanFrame& sent, sim::SimulatedDnBus::Sender sender, Instant) {
      const bool asks = sender == sim::SimulatedDnBus::Sender::kMaster && (sent.id == 0x42E || sent.id == 0x42C);
      if (asks && !frequency) frequency = bus->drive(0).inverter().frequency();
    });
    return made;
  }};
  ParameterLink link{config, transport, catalogue::shippedCatalogues()};
  const std::atomic<bool> not_asked{false};
  try {
    link.connect(std::chrono::seconds{5}, not_asked);
  } catch (const Trouble& trouble) {
    ADD_FAILURE() << trouble.what();
  }
  ASSERT_TRUE(frequency);
  EXPECT_DOUBLE_EQ(0.0, *frequency);
  EXPECT_NE(sim::InverterState::kOperationEnabled, bus->drive(0).inverter().state());
}

}  // namespace
}  // namespace nord_driver::tools
