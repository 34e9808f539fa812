// The whole driver below ROS on a simulated CAN bus, in simulated time.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cycle/cycle_config.h"
#include "sim/canopen/simulated_can_bus.h"
#include "support/map_settings.h"
#include "system/beside_can_link.h"
#include "system/deaf_can_link.h"
#include "system/driven_robot.h"
#include "transport/canopen/canopen.h"

namespace nord_driver::test {

/// Two wheels of 0.1 m, 0.5 m apart, each behind an SK TU3-CAO; P105 = 50 Hz, 20:1, two pole pairs: 100 % is
/// 7.854 rad/s or 0.785 m/s.
class CanRobot : public DrivenRobot {
 public:
  struct Options {
    std::map<std::string, MapSettings::Value> node;               ///< on top of the robot's own settings
    std::map<std::string, MapSettings::Value> bus;                ///< of the bus
    std::map<std::string, MapSettings::Value> drives;             ///< of all drives, on top of their own
    std::vector<std::map<std::string, MapSettings::Value>> each;  ///< of single drives, on top of these
    /// Behind one SK CU4-CAO, which then has these inverters; the first two are the wheels.
    std::size_t gateway_inverters = 0;
    std::size_t nodes = 2;                          ///< without a gateway; the first two are the wheels
    bool base = true;                               ///< false: no drive is a wheel
    std::function<void(sim::SimConfig&)> simulate;  ///< changes of the simulated side
    /// A second driver on this bus, which outlives it; `bus()`, `link()`, `unit()` and `node()` are the first one's.
    sim::SimulatedCanBus* beside = nullptr;
    TransportWrap wrap;  ///< stands between the driver and its transport
  };

  CanRobot() : CanRobot(Options{}) {}
  explicit CanRobot(const Options& options) {
    const auto drives = driveSettings(options);
    const MapSettings node{"~", nodeSettings(options)};
    const cycle::CycleConfig config = cycle::readCycleConfig(node, drives);
    auto transport = std::make_unique<CanopenTransport>(
        [this, options](const link::CanSettings& settings) -> std::unique_ptr<link::CanLink> {
          ids_ = settings.ids;
          if (options.beside != nullptr) {
            auto beside = std::make_unique<BesideCanLink>(*options.beside);
            beside_ = beside.get();
            return beside;
          }
          auto bus = std::make_unique<sim::SimulatedCanBus>(simConfig(options));
          bus_ = bus.get();
          auto link = std::make_unique<DeafCanLink>(std::move(bus));
          link_ = link.get();
          return link;
        });
    MapSettings bus{"~bus/", {{"interface", std::string{"can0"}}}};
    for (const auto& [key, value] : options.bus) bus.set(key, value);
    transport->configure(bus, drives, config.cycle_rate);
    start(config, std::move(transport), false, options.wrap);
  }

  bool online(DriveIndex drive) { return snapshot().drives[drive].online; }
  std::string text(DriveIndex drive) { return snapshot().drives[drive].text.str(); }
  std::string busText() { return transport().busText().str(); }
  bool standsStill() { return std::abs(unit(0).shaftSpeed()) < 0.1 && std::abs(unit(1).shaftSpeed()) < 0.1; }

  sim::SimulatedCanBus& bus() { return *bus_; }
  DeafCanLink& link() { return *link_; }
  /// Of a second driver.
  BesideCanLink& beside() { return *beside_; }
  sim::DriveUnit& unit(std::size_t drive) { return bus_->drive(drive); }
  sim::CanNode& node(std::size_t drive) { return bus_->node(drive); }
  const std::vector<std::uint32_t>& filteredIds() const { return ids_; }

 private:
  static std::vector<DriveSettings> driveSettings(const Options& options) {
    std::vector<DriveSettings> drives;
    const std::size_t count = options.gateway_inverters == 0 ? options.nodes : options.gateway_inverters;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string name = nameOf(i);
      auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
      settings->set("address", static_cast<int>(3 + i)).set("series", "sk5xxe").set("joint", name + "_wheel_joint");
      settings->set("gear_ratio", 20.0).set("pole_pairs", 2).set("inverted", i == 1);
      if (options.gateway_inverters != 0) {
        settings->set("address", 10).set("connection", "gateway");
        settings->set("inverter", static_cast<int>(i + 1));
      }
      for (const auto& [key, value] : options.drives) settings->set(key, value);
      if (i < options.each.size()) {
        for (const auto& [key, value] : options.each[i]) settings->set(key, value);
      }
      drives.push_back({name, settings});
    }
    return drives;
  }
  static std::string nameOf(std::size_t i) { return i == 0 ? "left" : i == 1 ? "right" : "extra" + std::to_string(i); }
  static std::map<std::string, MapSettings::Value> nodeSettings(const Options& options) {
    std::map<std::string, MapSettings::Value> values = options.node;
    values.insert({"cycle_rate", 100.0});
    if (!options.base) return values;
    values.insert({{"left_wheel", std::string{"left_wheel_joint"}},
                   {"right_wheel", std::string{"right_wheel_joint"}},
                   {"wheel_separation", 0.5},
                   {"wheel_radius", 0.1}});
    return values;
  }
  static sim::SimConfig simConfig(const Options& options) {
    sim::SimConfig config;
    config.bus = sim::CanBusConfig{};
    const bool gateway = options.gateway_inverters != 0;
    for (std::size_t i = 0; i < (gateway ? options.gateway_inverters : options.nodes); ++i) {
      sim::DriveConfig drive;
      drive.name = nameOf(i);
      drive.joint = drive.name + "_wheel_joint";
      drive.address = static_cast<std::uint8_t>(gateway ? 10 : 3 + i);
      drive.gear_ratio = 20.0;
      drive.inverted = i == 1;
      drive.motor.slip = 2.0;
      drive.bus = sim::CanDriveConfig{};
      if (gateway) {
        drive.bus.as<sim::CanDriveConfig>().connection = sim::CanConnection::kGateway;
        drive.place = static_cast<unsigned>(i + 1);
      }
      config.drives.push_back(drive);
    }
    if (options.base) config.body = sim::BodyConfig{{0}, {1}, 0.1, 0.5};
    if (options.simulate) options.simulate(config);
    return config;
  }

  sim::SimulatedCanBus* bus_ = nullptr;
  DeafCanLink* link_ = nullptr;
  BesideCanLink* beside_ = nullptr;
  std::vector<std::uint32_t> ids_;
};

/// Enabled, forward at half speed, and disabled to rest, without a rule broken on the bus.
inline void expectDrives(CanRobot& robot) {
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{4});
  EXPECT_NEAR(kHalfSpeed, robot.snapshot().base.velocity.linear_x, 2e-3);
  EXPECT_NEAR(25.0, robot.unit(0).inverter().frequency(), 0.1);
  EXPECT_NEAR(-25.0, robot.unit(1).inverter().frequency(), 0.1);
  robot.run(std::chrono::milliseconds{600});
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  EXPECT_TRUE(robot.runUntil([&] { return robot.standsStill(); }));
  EXPECT_EQ("no rule broken", robot.bus().referee().report());
}

}  // namespace nord_driver::test
