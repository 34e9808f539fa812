// A DeviceNet transport on a bus with fake modules, cycle by cycle.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "transport/devicenet/devicenet.h"
#include "transport/devicenet/devicenet_settings.h"
#include "transport/devicenet/fake_devicenet_bus.h"

namespace nord_driver::test {

/// A hundred cycles a second; one fake module for each configured one.
class DevicenetRig {
 public:
  explicit DevicenetRig(const DevicenetSettings& settings = DevicenetSettings{1}, bool guest = false) {
    if (guest) transport.serveParametersOnly();
    transport.configure(settings.bus, settings.drives, 100.0);
    for (const devicenet::NodeConfig& node : transport.config().scanner.nodes) {
      bus->devices.push_back(std::make_unique<devicenet::FakeDevice>(node.mac));
      devicenet::FakeDevice& device = *bus->devices.back();
      device.produced = node.io.input_bytes;
      device.consumed = node.io.output_bytes;
      device.input = {0x00, 0x31, 0x0B, 0x00, 0x00};
      device.attributes[{101, 1, 5}] = {0xF4, 0x01};  // P105 = 50.0 Hz
      device.attributes[{41, 1, 6}] = {3};
    }
    outputs.resize(settings.drives.size());
    inputs.resize(settings.drives.size());
    outputs.assign(outputs.size(), {0x047E, {}});
  }
  void cycle() {
    const Instant start = transport.now();
    transport.exchange(outputs, inputs);
    for (const DriveExchange& input : inputs) {
      if (input.interruption == Interruption::kUnasked) ++unasked;
      if (input.interruption == Interruption::kSilent) ++silences;
    }
    while (const auto event = transport.pollEvent()) told.push_back(event->text.str());
    while (const auto result = transport.pollResult()) results.push_back(*result);
    transport.sleepUntil(start + std::chrono::milliseconds{10});
  }
  void run(Duration span) {
    for (const Instant end = transport.now() + span; transport.now() < end;) cycle();
  }
  /// How long until `done`; `limit` when never.
  template <typename Done>
  Duration until(Done done, Duration limit = std::chrono::seconds{5}) {
    const Instant begun = transport.now();
    while (!done() && transport.now() - begun < limit) cycle();
    return transport.now() - begun;
  }
  bool allAnswer() const {
    for (const DriveExchange& input : inputs) {
      if (!input.inverter_answers) return false;
    }
    return true;
  }
  bool starts() {
    return until([this] { return allAnswer(); }) < std::chrono::seconds{5};
  }
  devicenet::FakeDevice& device(std::size_t i = 0) { return *bus->devices[i]; }
  profile::ParameterResult ask(const profile::ParameterRequest& request, DriveIndex drive = 0) {
    results.clear();
    EXPECT_TRUE(transport.submit(drive, request));
    until([this] { return !results.empty(); });
    return results.empty() ? profile::ParameterResult{} : results.front();
  }
  std::vector<std::string> violations() const {
    std::vector<std::string> all;
    for (const auto& device : bus->devices) {
      all.insert(all.end(), device->violations.begin(), device->violations.end());
    }
    return all;
  }

  FakeDevicenetBus* bus = nullptr;
  DeviceNetTransport transport{[this](const link::CanSettings&) {
    auto made = std::make_unique<FakeDevicenetBus>();
    bus = made.get();
    return made;
  }};
  std::vector<profile::ProcessOutput> outputs;
  std::vector<DriveExchange> inputs;
  std::vector<std::string> told;
  std::vector<profile::ParameterResult> results;
  int unasked = 0, silences = 0;
};

inline profile::ParameterRequest readOf(std::uint16_t number,
                                        profile::ParameterShape shape = profile::ParameterShape::kPlain) {
  profile::ParameterRequest request;
  request.id = 7;
  request.number = number;
  request.shape = shape;
  return request;
}

}  // namespace nord_driver::test
