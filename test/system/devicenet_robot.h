// The whole driver below ROS on a simulated DeviceNet, in simulated time.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cycle/cycle_config.h"
#include "sim/devicenet/simulated_dn_bus.h"
#include "support/map_settings.h"
#include "system/beside_can_link.h"
#include "system/driven_robot.h"
#include "transport/devicenet/devicenet.h"

namespace nord_driver::test {

/// Two wheels of 0.1 m, 0.5 m apart, each an SK 2xxE behind an SK CU4-DEV, or more inverters behind one; P105 = 50 Hz,
/// 20:1, two pole pairs: 100 % is 7.854 rad/s or 0.785 m/s.
class DevicenetRobot : public DrivenRobot {
 public:
  struct Options {
    std::map<std::string, MapSettings::Value> node;                    ///< on top of the robot's own settings
    std::map<std::string, MapSettings::Value> bus;                     ///< of the bus
    std::map<std::string, MapSettings::Value> drives;                  ///< of all drives, on top of their own
    std::vector<std::map<std::string, MapSettings::Value>> each = {};  ///< of single drives, on top of these
    int assembly = 100;
    /// Behind one module, which then has these inverters; the first two are the wheels.
    std::size_t gateway_inverters = 0;
    std::size_t modules = 2;  ///< with an inverter each, when there is no such gateway; the first two are the wheels
    bool base = true;         ///< false: no drive is a wheel
    /// Each wheel an SK 5xxE behind its own SK TU3-DEV, which lives by its mains.
    bool on_inverter = false;
    std::function<void(sim::SimConfig&)> simulate;  ///< changes of the simulated side
    /// A second driver on this bus, which outlives it; `bus()`, `unit()` and `module()` are the first one's.
    sim::SimulatedDnBus* beside = nullptr;
    TransportWrap wrap;  ///< stands between the driver and its transport
  };

  DevicenetRobot() : DevicenetRobot(Options{}) {}
  explicit DevicenetRobot(const Options& options) {
    const auto drives = driveSettings(options);
    const MapSettings node{"~", nodeSettings(options)};
    const cycle::CycleConfig config = cycle::readCycleConfig(node, drives);
    auto transport = std::make_unique<DeviceNetTransport>(
        [this, options](const link::CanSettings&) -> std::unique_ptr<link::CanLink> {
          if (options.beside != nullptr) {
            auto beside = std::make_unique<BesideCanLink>(*options.beside);
            beside_ = beside.get();
            return beside;
          }
          auto bus = std::make_unique<sim::SimulatedDnBus>(simConfig(options));
          bus_ = bus.get();
          return bus;
        });
    MapSettings bus{"~bus/", {{"interface", std::string{"can0"}}, {"bit_rate", 500'000}}};
    for (const auto& [key, value] : options.bus) bus.set(key, value);
    transport->configure(bus, drives, config.cycle_rate);
    start(config, std::move(transport), false, options.wrap);
  }

  bool online(DriveIndex drive) { return snapshot().drives[drive].online; }
  std::string text(DriveIndex drive) { return snapshot().drives[drive].text.str(); }
  std::string busText() { return transport().busText().str(); }
  bool standsStill() { return std::abs(unit(0).shaftSpeed()) < 0.1 && std::abs(unit(1).shaftSpeed()) < 0.1; }

  sim::SimulatedDnBus& bus() { return *bus_; }
  /// Of a second driver.
  BesideCanLink& beside() { return *beside_; }
  sim::DriveUnit& unit(std::size_t drive) { return bus_->drive(drive); }
  sim::DnModule& module(std::size_t drive) { return bus_->module(drive); }

 private:
  static std::size_t countOf(const Options& options) {
    return options.gateway_inverters == 0 ? options.modules : options.gateway_inverters;
  }
  static std::string nameOf(std::size_t i) { return i == 0 ? "left" : i == 1 ? "right" : "extra" + std::to_string(i); }
  static std::vector<DriveSettings> driveSettings(const Options& options) {
    std::vector<DriveSettings> drives;
    for (std::size_t i = 0; i < countOf(options); ++i) {
      const std::string name = nameOf(i);
      auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
      settings->set("address", static_cast<int>(5 + i)).set("series", "sk2xxe").set("joint", name + "_wheel_joint");
      settings->set("gear_ratio", 20.0).set("pole_pairs", 2).set("inverted", i == 1).set("assembly", options.assembly);
      if (options.gateway_inverters != 0) settings->set("address", 5).set("inverter", static_cast<int>(i + 1));
      if (options.on_inverter) settings->set("series", "sk5xxe");
      for (const auto& [key, value] : options.drives) settings->set(key, value);
      if (i < options.each.size()) {
        for (const auto& [key, value] : options.each[i]) settings->set(key, value);
      }
      drives.push_back({name, settings});
    }
    return drives;
  }
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
    config.bus = sim::DnBusConfig{};
    for (std::size_t i = 0; i < countOf(options); ++i) {
      const bool gateway = options.gateway_inverters != 0;
      sim::DriveConfig drive;
      drive.name = nameOf(i);
      drive.joint = drive.name + "_wheel_joint";
      drive.address = static_cast<std::uint8_t>(gateway ? 5 : 5 + i);
      if (!options.on_inverter) {
        drive.place = static_cast<unsigned>(gateway ? i + 1 : 1);
        drive.device.series = sim::Series::kSk2xxe;
      }
      drive.gear_ratio = 20.0;
      drive.inverted = i == 1;
      drive.motor.slip = 2.0;
      sim::DnDriveConfig dn;
      dn.kind = options.on_inverter ? sim::DnModuleKind::kOnInverter : sim::DnModuleKind::kGateway;
      dn.assembly = static_cast<unsigned>(options.assembly);
      drive.bus = dn;
      config.drives.push_back(drive);
    }
    if (options.base) config.body = sim::BodyConfig{{0}, {1}, 0.1, 0.5};
    if (options.simulate) options.simulate(config);
    return config;
  }

  sim::SimulatedDnBus* bus_ = nullptr;
  BesideCanLink* beside_ = nullptr;
};

}  // namespace nord_driver::test
