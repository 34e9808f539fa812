// The whole driver below ROS on a simulated InterBus ring behind a gateway, in simulated time.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cycle/cycle_config.h"
#include "sim/interbus/simulated_gateway.h"
#include "support/map_settings.h"
#include "system/driven_robot.h"
#include "system/shared_link.h"
#include "transport/interbus/interbus.h"

namespace nord_driver::test {

/// Two wheels of 0.1 m, 0.5 m apart, each behind an SK TU3-IBS; P105 = 50 Hz, 20:1, two pole pairs: 100 % is 7.854
/// rad/s or 0.785 m/s. Inputs from register 0 on, outputs from 100 on; register 200 says that the ring runs, 300 is the
/// watchdog, 200 ms; P513 is 0.2 s. No parameter channel, unless asked for.
class InterbusRobot : public DrivenRobot {
 public:
  struct Options {
    std::map<std::string, MapSettings::Value> node;               ///< on top of the robot's own settings
    std::map<std::string, MapSettings::Value> bus;                ///< of the bus, on top of its own
    std::map<std::string, MapSettings::Value> drives;             ///< of all drives, on top of their own
    std::vector<std::map<std::string, MapSettings::Value>> each;  ///< of single drives, on top of these
    std::size_t modules = 2;                                      ///< the first two are the wheels
    bool base = true;                                             ///< false: no drive is a wheel
    std::string series = "sk5xxe";
    int ppo_type = 1;
    bool drivecom = false;  ///< P551 on
    bool swapped = false;   ///< the bytes of each word
    bool pcp_word = false;
    bool pcp = false;                               ///< parameters by Compact PCP, its blocks at registers 500 and 600
    std::optional<double> max_frequency = 50.0;     ///< as typed in, Hz
    bool running = true;                            ///< register 200 is configured
    bool watchdog = true;                           ///< register 300 is configured
    int telegram_timeout = 2;                       ///< P513 in 0.1 s
    double slip = 2.0;                              ///< Hz at rated torque
    std::function<void(sim::SimConfig&)> simulate;  ///< changes of the simulated side
    /// A second driver at this gateway, which outlives it, and which the first one has closed.
    sim::SimulatedGateway* beside = nullptr;
    TransportWrap wrap;  ///< stands between the driver and its transport
  };
  static constexpr int kOutputs = 100, kRunning = 200, kWatchdog = 300, kInvoke = 500, kResult = 600;

  InterbusRobot() : InterbusRobot(Options{}) {}
  explicit InterbusRobot(const Options& options) {
    const auto drives = driveSettings(options);
    const MapSettings node{"~", nodeSettings(options)};
    const cycle::CycleConfig config = cycle::readCycleConfig(node, drives);
    auto transport = std::make_unique<InterbusTransport>(
        [this, options](const link::ModbusSettings& settings) -> std::unique_ptr<link::RegisterLink> {
          if (options.beside != nullptr) {
            link_ = options.beside;
            return std::make_unique<SharedRegisterLink<sim::SimulatedGateway>>(*options.beside);
          }
          auto link = std::make_unique<sim::SimulatedGateway>(simConfig(options), settings);
          link_ = link.get();
          return link;
        });
    transport->configure(busSettings(options), drives, config.cycle_rate);
    start(config, std::move(transport), false, options.wrap);
  }

  bool online(DriveIndex drive) { return snapshot().drives[drive].online; }
  std::string text(DriveIndex drive) { return snapshot().drives[drive].text.str(); }
  std::string busText() { return transport().busText().str(); }
  bool standsStill() { return std::abs(unit(0).shaftSpeed()) < 0.1 && std::abs(unit(1).shaftSpeed()) < 0.1; }
  std::string referee() { return link_->ring().report(); }

  /// The far end: network, gateway, ring.
  sim::SimulatedGateway& gateway() { return *link_; }
  sim::IbsRing& ring() { return link_->ring(); }
  sim::IbsModule& module(std::size_t drive) { return link_->ring().module(drive); }
  sim::DriveUnit& unit(std::size_t drive) { return link_->drive(drive); }

 private:
  static std::string nameOf(std::size_t i) { return i == 0 ? "left" : i == 1 ? "right" : "extra" + std::to_string(i); }
  static std::vector<DriveSettings> driveSettings(const Options& options) {
    std::vector<DriveSettings> drives;
    for (std::size_t i = 0; i < options.modules; ++i) {
      const std::string name = nameOf(i);
      auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
      settings->set("address", static_cast<int>(1 + i)).set("series", options.series);
      if (options.max_frequency) settings->set("max_frequency", *options.max_frequency);
      settings->set("joint", name + "_wheel_joint").set("gear_ratio", 20.0).set("pole_pairs", 2);
      settings->set("inverted", i == 1).set("ppo_type", options.ppo_type);
      if (options.drivecom) settings->set("profile", "drivecom");
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
  static MapSettings busSettings(const Options& options) {
    MapSettings bus{"~bus/", {{"gateway", std::string{"192.168.0.10:502"}}, {"outputs/address", kOutputs}}};
    if (options.running) bus.set("running/address", kRunning);
    if (options.watchdog) bus.set("watchdog/address", kWatchdog).set("watchdog/value", 200);
    if (options.swapped) bus.set("word_order", "swapped");
    if (options.pcp_word) bus.set("pcp_word", true);
    if (options.pcp) bus.set("pcp/invoke/address", kInvoke).set("pcp/result/address", kResult);
    for (const auto& [key, value] : options.bus) bus.set(key, value);
    return bus;
  }
  static sim::SimConfig simConfig(const Options& options) {
    sim::SimConfig config;
    sim::IbsBusConfig bus;
    bus.output_address = kOutputs;
    bus.running = sim::IbsRunning{kRunning, 1, 1};
    bus.watchdog = kWatchdog;
    bus.swapped = options.swapped;
    bus.pcp_word = options.pcp_word;
    if (options.pcp) bus.pcp = sim::IbsPcp{kInvoke, kResult, 2, true};
    config.bus = bus;
    for (std::size_t i = 0; i < options.modules; ++i) {
      sim::DriveConfig drive;
      drive.name = nameOf(i);
      drive.joint = drive.name + "_wheel_joint";
      drive.address = static_cast<std::uint8_t>(1 + i);
      drive.device.series = options.series == "sk700e" ? sim::Series::kSk700e : sim::Series::kSk5xxe;
      drive.gear_ratio = 20.0;
      drive.inverted = i == 1;
      drive.motor.slip = options.slip;
      drive.parameters = {{513, 0, 0, options.telegram_timeout}};
      sim::IbsDriveConfig place;
      place.drivecom = options.drivecom;
      place.ppo_type = static_cast<unsigned>(options.ppo_type);
      drive.bus = place;
      config.drives.push_back(drive);
    }
    if (options.base) config.body = sim::BodyConfig{{0}, {1}, 0.1, 0.5};
    if (options.simulate) options.simulate(config);
    return config;
  }

  sim::SimulatedGateway* link_ = nullptr;
};

}  // namespace nord_driver::test
