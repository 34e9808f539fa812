// A simulated drive on whatever bus, and one run of nord_param after the other at its parameters, in simulated time.
#pragma once

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "catalogue/shipped.h"
#include "sim/canopen/simulated_can_bus.h"
#include "sim/devicenet/simulated_dn_bus.h"
#include "sim/interbus/simulated_gateway.h"
#include "sim/profibus/simulated_segment.h"
#include "support/temporary_folder.h"
#include "system/shared_link.h"
#include "tools/parameter_link.h"
#include "transport/canopen/canopen.h"
#include "transport/devicenet/devicenet.h"
#include "transport/interbus/interbus.h"
#include "transport/profibus/profibus_dp.h"
#include "transport/profibus/profibus_ms2.h"

namespace nord_driver::test {

/// `bus` is the transport, `drive` what a file says of the drive "left" and the simulator understands as well.
class RestoredDrive {
 public:
  RestoredDrive(const std::string& bus, const std::string& drive, bool ram_orders = true) : transport_name_(bus) {
    const bool profibus = bus == "profibus_dp" || bus == "profibus_ms2";
    std::string where = profibus ? "device: simulated, baud_rate: 500000, slot_time: 0.0005" : "interface: can0";
    if (bus == "interbus") {
      where =
          "gateway: \"127.0.0.1:1502\", outputs: {address: 100}, pcp: {invoke: {address: 500}, result: {address: "
          "600}}";
    }
    const std::string drives = "drives: {left: {pole_pairs: 2, gear_ratio: 20.0, joint: l, " + drive + "}}";
    const std::string speed = bus == "devicenet" ? ", bit_rate: 500000" : "";
    file_ = YAML::Load("{transport: " + bus + ", cycle_rate: 100, eeprom_budget: 100000, eeprom_state_file: \"" +
                       folder_.path("eeprom.yaml") + "\", bus: {" + where + speed + "}, " + drives + "}");
    simulated_ = sim::readSimConfig(
        YAML::Load("{bus: {" + (profibus ? "" : "transport: " + bus + ", ") + where + speed + "}, " + drives + "}"));
    simulated_.drives.front().pkw.ram_orders = ram_orders;
    if (profibus) segment_.emplace(simulated_);
    if (bus == "canopen") can_bus_.emplace(simulated_);
    if (bus == "devicenet") dn_bus_.emplace(simulated_);
    run(std::chrono::seconds{1});
  }
  ~RestoredDrive() { end(); }
  RestoredDrive(const RestoredDrive&) = delete;
  RestoredDrive& operator=(const RestoredDrive&) = delete;

  /// A run begins: connected when it returns. Throws Trouble.
  tools::ParameterLink& begin() {
    end();
    config_ = tools::readToolConfig(file_, "left");
    transport_ = makeTransport();
    link_ = std::make_unique<tools::ParameterLink>(config_, *transport_, catalogue::shippedCatalogues());
    link_->connect(std::chrono::seconds{5}, not_asked_);
    return *link_;
  }
  /// Of the run that has begun.
  tools::ParameterLink& link() { return *link_; }
  /// It is gone, whatever it was at.
  void end() {
    link_.reset();
    transport_.reset();
  }
  /// As a run ends that has come to its end.
  void finish() {
    EXPECT_EQ(0u, link_->finish().size());
    end();
  }

  /// The adapter is pulled out at so many telegrams from now on.
  CutAfter& cut() noexcept { return cut_; }
  void plugAdapterIn() {
    cut_.set(CutAfter::kNever);
    if (segment_) segment_->setDevicePresent(true);
    if (can_bus_) can_bus_->setInterfacePresent(true);
    if (dn_bus_) dn_bus_->setInterfacePresent(true);
  }
  void run(Duration span) {
    if (segment_) segment_->run(span);
    if (can_bus_) can_bus_->run(span);
    if (dn_bus_) dn_bus_->run(span);
    if (gateway_) gateway_->run(span);
  }
  void switchOffAndOn() {
    unit().setPlugged(false);
    unit().parameters().restoreFromEeprom();
    run(std::chrono::seconds{1});
    unit().setPlugged(true);
    run(std::chrono::seconds{2});
  }

  /// On InterBus once a run has begun: the gateway is made with what the driver says of it.
  sim::DriveUnit& unit() {
    if (gateway_) return gateway_->drive(0);
    return segment_ ? segment_->drive(0) : can_bus_ ? can_bus_->drive(0) : dn_bus_->drive(0);
  }
  const std::atomic<bool>& notAsked() const noexcept { return not_asked_; }
  const TemporaryFolder& folder() const noexcept { return folder_; }

 private:
  std::unique_ptr<Transport> makeTransport() {
    const auto serial = [this](const link::SerialSettings&) -> std::unique_ptr<link::ByteLink> {
      return std::make_unique<SharedByteLink<sim::SimulatedSegment>>(*segment_, cut_);
    };
    if (transport_name_ == "profibus_dp") return std::make_unique<ProfibusDpTransport>(serial);
    if (transport_name_ == "profibus_ms2") return std::make_unique<ProfibusMs2Transport>(serial);
    if (transport_name_ == "interbus") {
      return std::make_unique<InterbusTransport>(
          [this](const link::ModbusSettings& settings) -> std::unique_ptr<link::RegisterLink> {
            if (!gateway_) gateway_.emplace(simulated_, settings);
            return std::make_unique<SharedRegisterLink<sim::SimulatedGateway>>(*gateway_);
          });
    }
    if (transport_name_ == "canopen") {
      return std::make_unique<CanopenTransport>([this](const link::CanSettings&) -> std::unique_ptr<link::CanLink> {
        return std::make_unique<SharedCanLink<sim::SimulatedCanBus>>(*can_bus_, cut_);
      });
    }
    return std::make_unique<DeviceNetTransport>([this](const link::CanSettings&) -> std::unique_ptr<link::CanLink> {
      return std::make_unique<SharedCanLink<sim::SimulatedDnBus>>(*dn_bus_, cut_);
    });
  }

  TemporaryFolder folder_;
  std::string transport_name_;
  YAML::Node file_;
  CutAfter cut_;
  std::optional<sim::SimulatedSegment> segment_;
  std::optional<sim::SimulatedCanBus> can_bus_;
  std::optional<sim::SimulatedDnBus> dn_bus_;
  sim::SimConfig simulated_;
  std::optional<sim::SimulatedGateway> gateway_;
  std::atomic<bool> not_asked_{false};
  tools::ToolConfig config_;
  std::unique_ptr<Transport> transport_;
  std::unique_ptr<tools::ParameterLink> link_;
};

}  // namespace nord_driver::test
