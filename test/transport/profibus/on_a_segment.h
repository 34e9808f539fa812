// The PROFIBUS transport on a simulated segment.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/profibus/simulated_segment.h"
#include "support/map_settings.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver {

/// Two drives, each behind a module of its own at 3 and 4: 100 cycles a second, drive_timeout 50 ms, watchdog 200 ms.
class OnASegment : public ::testing::Test {
 protected:
  void open(int ppo_type = 1, bool device_present = true) {
    std::vector<DriveSettings> drives;
    sim::SimConfig config;
    for (const int address : {3, 4}) {
      const std::string name = address == 3 ? "left" : "right";
      auto settings = std::make_shared<test::MapSettings>("~drives/" + name + "/");
      settings->set("address", address).set("series", "sk5xxe").set("pole_pairs", 2).set("ppo_type", ppo_type);
      drives.push_back({name, settings});
      sim::DriveConfig drive;
      drive.name = name;
      drive.address = static_cast<std::uint8_t>(address);
      drive.bus.as<sim::DpDriveConfig>().ppo_type = ppo_type;
      config.drives.push_back(drive);
    }
    if (change_) change_(config);
    transport_ = std::make_unique<ProfibusDpTransport>([&](const link::SerialSettings& serial) {
      EXPECT_EQ("/dev/ttyUSB0", serial.device);
      auto segment = make_segment_(config);
      segment->setDevicePresent(device_present);
      segment_ = segment.get();
      return segment;
    });
    if (parameters_only_) transport_->serveParametersOnly();
    const test::MapSettings bus{
        "~bus/", {{"device", std::string{"/dev/ttyUSB0"}}, {"slot_time", 0.0005}, {"listen_first", listen_first_}}};
    transport_->configure(bus, drives, 100.0);
    transport_->setDriveTimeout(std::chrono::milliseconds{50});
  }
  void step() {
    const Instant start = transport_->now();
    transport_->exchange(outputs_, inputs_);
    for (const std::size_t i : {0u, 1u}) {
      if (inputs_[i].interruption == Interruption::kUnasked) ++unasked_[i];
    }
    transport_->sleepUntil(start + std::chrono::milliseconds{10});
  }
  void run(Duration span) {
    const Instant end = transport_->now() + span;
    while (transport_->now() < end) step();
  }
  template <typename Condition>
  bool runUntil(Condition done, Duration limit) {
    const Instant end = transport_->now() + limit;
    while (!done() && transport_->now() < end) step();
    return done();
  }
  bool bothAnswer() const { return inputs_[0].inverter_answers && inputs_[1].inverter_answers; }
  void bringUp(int ppo_type = 1) {
    open(ppo_type);
    ASSERT_TRUE(runUntil([this] { return bothAnswer(); }, std::chrono::seconds{2}));
    for (auto& output : outputs_) output.control_word = 0x047E;
    run(std::chrono::milliseconds{500});  // the inverters' charging relays engage
  }
  std::optional<profile::ParameterResult> ask(DriveIndex drive, std::uint16_t number) {
    profile::ParameterRequest request;
    request.id = 77;
    request.number = number;
    request.shape = profile::ParameterShape::kPerSet;
    if (!transport_->submit(drive, request)) return std::nullopt;
    for (int i = 0; i < 300; ++i) {
      if (const auto result = transport_->pollResult()) return result;
      step();
    }
    return std::nullopt;
  }

  std::function<void(sim::SimConfig&)> change_;  // of what is there, before it is built
  std::function<std::unique_ptr<sim::SimulatedSegment>(const sim::SimConfig&)> make_segment_ =
      [](const sim::SimConfig& config) { return std::make_unique<sim::SimulatedSegment>(config); };
  double listen_first_ = 0.0;     // s
  bool parameters_only_ = false;  // what the transport is told before it is configured
  sim::SimulatedSegment* segment_ = nullptr;
  std::unique_ptr<ProfibusDpTransport> transport_;
  std::vector<profile::ProcessOutput> outputs_{2};
  std::vector<DriveExchange> inputs_{2};
  std::array<int, 2> unasked_{};  // how often each drive was told to have left
};

}  // namespace nord_driver
