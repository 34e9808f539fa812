// The link of nord_param to a simulated segment in simulated time.
#pragma once

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "catalogue/shipped.h"
#include "sim/profibus/simulated_segment.h"
#include "tools/parameter_link.h"
#include "tools/write_value.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver::tools {

/// Two SK 5xxE on one bus; the link is to drive left, station 3.
class LinkedDrive {
 public:
  static YAML::Node file(int ppo_type = 1) {
    const std::string ppo = ", ppo_type: " + std::to_string(ppo_type);
    return YAML::Load(
        "{cycle_rate: 100, left_wheel: left_wheel_joint,"
        " bus: {device: simulated, baud_rate: 500000, slot_time: 0.0005},"
        " drives: {left: {address: 3, series: sk5xxe, pole_pairs: 2" +
        ppo + "}, right: {address: 4, series: sk5xxe, pole_pairs: 2" + ppo + "}}}");
  }

  explicit LinkedDrive(const std::vector<sim::ParameterPreset>& parameters = {}, bool ram_orders = true,
                       int ppo_type = 1)
      : LinkedDrive(file(ppo_type), parameters, ram_orders, ppo_type) {}
  explicit LinkedDrive(const YAML::Node& file, const std::vector<sim::ParameterPreset>& parameters = {},
                       bool ram_orders = true, int ppo_type = 1)
      : config_(readToolConfig(file, "left")),
        transport_([=](const link::SerialSettings&) {
          auto made = std::make_unique<sim::SimulatedSegment>(simulated(parameters, ram_orders, ppo_type));
          segment_ = made.get();
          return made;
        }),
        link_(std::make_unique<ParameterLink>(config_, transport_, catalogue::shippedCatalogues())) {}

  ParameterLink& link() { return *link_; }
  sim::SimulatedSegment& segment() { return *segment_; }
  sim::DriveUnit& left() { return segment_->drive(0); }
  sim::DriveUnit& right() { return segment_->drive(1); }
  ProfibusDpTransport& transport() { return transport_; }
  const std::atomic<bool>& notAsked() const { return not_asked_; }

  void connect() { link_->connect(std::chrono::seconds{5}, not_asked_); }
  /// "" when it connects.
  std::string trouble() {
    try {
      connect();
    } catch (const Trouble& error) {
      return error.what();
    }
    return "";
  }

 private:
  static sim::SimConfig simulated(const std::vector<sim::ParameterPreset>& parameters, bool ram_orders, int ppo_type) {
    sim::SimConfig config;
    for (const int address : {3, 4}) {
      sim::DriveConfig drive;
      drive.name = address == 3 ? "left" : "right";
      drive.address = static_cast<std::uint8_t>(address);
      drive.bus.as<sim::DpDriveConfig>().ppo_type = ppo_type;
      drive.pkw.ram_orders = ram_orders;
      drive.parameters = parameters;
      config.drives.push_back(drive);
    }
    return config;
  }

  ToolConfig config_;
  sim::SimulatedSegment* segment_ = nullptr;  // of the transport
  ProfibusDpTransport transport_;
  std::unique_ptr<ParameterLink> link_;
  std::atomic<bool> not_asked_{false};
};

}  // namespace nord_driver::tools
