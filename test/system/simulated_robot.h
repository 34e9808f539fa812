// The whole driver below ROS on a simulated segment, in simulated time: a minute of driving takes milliseconds.
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
#include "sim/profibus/simulated_segment.h"
#include "support/map_settings.h"
#include "system/driven_robot.h"
#include "system/recording_link.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver::test {

/// Two wheels of 0.1 m, 0.5 m apart, or as many a side as asked for (drives 0, 2 ... left, 1, 3 ... right); P105 = 50
/// Hz, 20:1, two pole pairs: 100 % is 7.854 rad/s or 0.785 m/s.
class SimulatedRobot : public DrivenRobot {
 public:
  struct Options {
    double slip = 2.0;  ///< Hz at rated torque
    bool auto_enable = false;
    std::map<std::string, MapSettings::Value> node;    ///< on top of the robot's own settings
    std::map<std::string, MapSettings::Value> bus;     ///< before the robot's own ones
    std::map<std::string, MapSettings::Value> drives;  ///< of both drives, on top of their own
    std::vector<sim::ParameterPreset> parameters;      ///< of both inverters
    std::vector<sim::ParameterPreset> left_parameters;
    std::map<std::string, std::map<std::string, MapSettings::Value>> of_drive;  ///< of the drive of that name, likewise
    std::map<std::string, std::vector<sim::ParameterPreset>> parameters_of;     ///< of its inverter
    std::vector<sim::ModuleConfig> modules;  ///< what there is more to say of, by address
    int ppo_type = 1;                        ///< as set at the inverters
    /// Four wheels, two on each side, all behind one module SK CU4 at address 3 with its I/O byte in slot 1.
    bool one_module = false;
    int wheels_a_side = 1;  ///< 1 or 2, each with a module of its own
    sim::PkwSettings pkw;   ///< of all inverters
    /// False: no drive is a wheel, and with `singles` there are no others, up to four of them behind the one module.
    bool base = true;
    std::size_t singles = 0;                             ///< drives that belong to no base, behind the wheels
    std::function<void(sim::SimConfig&)> simulate = {};  ///< changes of the simulated side
    TransportWrap wrap;                                  ///< stands between the driver and its transport
  };

  SimulatedRobot() : SimulatedRobot(Options{}) {}
  explicit SimulatedRobot(const Options& options) {
    const auto drives = driveSettings(options);
    const MapSettings node{"~", nodeSettings(options)};
    const cycle::CycleConfig config = cycle::readCycleConfig(node, drives);
    auto transport = std::make_unique<ProfibusDpTransport>([this, options](const link::SerialSettings&) {
      auto segment = std::make_unique<sim::SimulatedSegment>(simConfig(options));
      segment_ = segment.get();
      auto link = std::make_unique<RecordingLink>(std::move(segment));
      link_ = link.get();
      return link;
    });
    std::map<std::string, MapSettings::Value> bus = options.bus;
    bus.insert({{"device", std::string{"simulated"}}, {"baud_rate", 500'000}, {"slot_time", 0.0005}});
    transport->configure(MapSettings{"~bus/", bus}, drives, config.cycle_rate);
    start(config, std::move(transport), options.auto_enable, options.wrap);
  }

  bool standsStill() {
    for (std::size_t i = 0; i < config().drives.size(); ++i) {
      if (std::abs(unit(i).shaftSpeed()) >= 0.1) return false;
    }
    return true;
  }
  std::size_t driveCount() const { return config().drives.size(); }

  sim::SimulatedSegment& segment() { return *segment_; }
  sim::DriveUnit& unit(std::size_t drive) { return segment_->drive(drive); }
  RecordingLink& link() { return *link_; }

  /// left, right and, with two wheels a side, rear_left, rear_right.
  static std::vector<DriveSettings> driveSettings(const Options& options) {
    std::vector<DriveSettings> drives;
    for (const std::string& name : names(options)) {
      const int number = static_cast<int>(drives.size());
      auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
      const bool shares = sharesModule(options, drives.size());
      settings->set("address", shares ? 3 : 3 + number).set("ppo_type", 1);
      settings->set("series", shares ? "sk2xxe" : "sk5xxe").set("joint", name + "_wheel_joint");
      settings->set("gear_ratio", 20.0).set("pole_pairs", 2).set("inverted", isRight(name));
      if (shares) settings->set("inverter", number + 1).set("io_byte", true);
      for (const auto& [key, value] : options.drives) settings->set(key, value);
      const auto own = options.of_drive.find(name);
      if (own != options.of_drive.end()) {
        for (const auto& [key, value] : own->second) settings->set(key, value);
      }
      drives.push_back({name, settings});
    }
    return drives;
  }

 private:
  static std::vector<std::string> names(const Options& options) {
    std::vector<std::string> names;
    if (options.base || options.singles == 0) names = {"left", "right"};
    if (options.base && (options.one_module || options.wheels_a_side == 2)) {
      names.insert(names.end(), {"rear_left", "rear_right"});
    }
    for (std::size_t i = 0; i < options.singles; ++i) names.push_back("single" + std::to_string(i));
    return names;
  }
  static bool isWheel(const std::string& name) { return name.find("single") == std::string::npos; }
  static bool sharesModule(const Options& options, std::size_t drive) {
    return options.one_module && drive < sim::BusModule::kPlaces;
  }
  static bool isRight(const std::string& name) { return name.find("right") != std::string::npos; }
  static std::map<std::string, MapSettings::Value> nodeSettings(const Options& options) {
    std::map<std::string, MapSettings::Value> values = options.node;
    values.insert({"cycle_rate", 100.0});
    if (!options.base) return values;
    std::vector<std::string> left, right;
    for (const std::string& name : names(options)) {
      if (isWheel(name)) (isRight(name) ? right : left).push_back(name + "_wheel_joint");
    }
    values.insert({{"left_wheel", left}, {"right_wheel", right}, {"wheel_separation", 0.5}, {"wheel_radius", 0.1}});
    return values;
  }
  static sim::SimConfig simConfig(const Options& options) {
    sim::SimConfig config;
    config.bus.as<sim::DpBusConfig>().baud_rate = 500'000;
    if (options.base) config.body = sim::BodyConfig{{}, {}, 0.1, 0.5};
    config.bus.as<sim::DpBusConfig>().modules = options.modules;
    for (const std::string& name : names(options)) {
      const std::size_t number = config.drives.size();
      sim::DriveConfig drive;
      drive.name = name;
      drive.joint = name + "_wheel_joint";
      const bool shares = sharesModule(options, number);
      drive.address = static_cast<std::uint8_t>(shares ? 3 : 3 + number);
      drive.gear_ratio = 20.0;
      drive.inverted = isRight(name);
      drive.motor.slip = options.slip;
      drive.bus.as<sim::DpDriveConfig>().ppo_type = options.ppo_type;
      drive.parameters = options.parameters;
      drive.pkw = options.pkw;
      if (shares) {
        drive.place = static_cast<unsigned>(number + 1);
        drive.device.series = sim::Series::kSk2xxe;
      }
      if (number == 0) {
        drive.parameters.insert(drive.parameters.end(), options.left_parameters.begin(), options.left_parameters.end());
      }
      const auto own = options.parameters_of.find(name);
      if (own != options.parameters_of.end()) {
        drive.parameters.insert(drive.parameters.end(), own->second.begin(), own->second.end());
      }
      if (options.base && isWheel(name)) (isRight(name) ? config.body->right : config.body->left).push_back(number);
      config.drives.push_back(drive);
    }
    if (options.simulate) options.simulate(config);
    return config;
  }

  sim::SimulatedSegment* segment_ = nullptr;
  RecordingLink* link_ = nullptr;
};

}  // namespace nord_driver::test
