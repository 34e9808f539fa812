// A scanner and devices on one bus with one clock; a minute of bus time takes milliseconds.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "devicenet/fake_device.h"
#include "devicenet/scanner.h"
#include "support/can_text.h"

namespace nord_driver::devicenet {

/// A module with assembly 100/110 (BU 0280 4.2.2): five bytes each way.
inline NodeConfig nodeConfig(std::uint8_t mac, IoKind kind = IoKind::kPoll, std::size_t in = 5, std::size_t out = 5) {
  NodeConfig config;
  config.mac = mac;
  config.io.kind = kind;
  config.io.input_bytes = in;
  config.io.output_bytes = out;
  return config;
}

inline ScannerConfig busConfig(std::size_t nodes, std::uint8_t first_mac = 5) {
  ScannerConfig config;
  config.mac = 0;
  config.own = {0x1234, 0x11223344};
  for (std::size_t i = 0; i < nodes; ++i) config.nodes.push_back(nodeConfig(static_cast<std::uint8_t>(first_mac + i)));
  return config;
}

class ScannerRun {
 public:
  static constexpr Duration kStep = std::chrono::milliseconds{1};

  explicit ScannerRun(const ScannerConfig& config)
      : scanner{config}, steps_per_cycle_(static_cast<int>(config.cycle_time / kStep)) {
    for (const NodeConfig& node : config.nodes) {
      devices.push_back(std::make_unique<FakeDevice>(node.mac));
      devices.back()->produced = node.io.input_bytes;
      devices.back()->consumed = node.io.output_bytes;
    }
  }

  void begin() { scanner.restart(now); }
  void deliver(const CanFrame& frame) {
    seen.push_back("< " + text(frame));
    if (loses && loses(frame)) return;
    scanner.handleFrame(frame, now);
    if (doubles && doubles(frame)) scanner.handleFrame(frame, now);
  }
  void pump() {
    CanFrame frame;
    while (!link_full && scanner.pollTransmit(frame)) {
      if (on_sent) on_sent(frame);
      seen.push_back("> " + text(frame));
      if (loses && loses(frame)) continue;
      for (auto& device : devices) device->receive(frame, now);
    }
    if (link_full && scanner.pollTransmit(frame)) scanner.notSent();
  }
  void step() {
    now += kStep;
    for (auto& device : devices) {
      device->tick(now);
      CanFrame frame;
      while (device->next(frame)) deliver(frame);
    }
    if (steps_++ % steps_per_cycle_ == 0) {
      if (before_cycle) before_cycle();
      for (std::size_t i = 0; sets_outputs && i < scanner.nodeCount(); ++i) scanner.setOutput(i, ByteView{output});
      scanner.startCycle(now);
    }
    scanner.poll(now);
    pump();
    while (const auto event = scanner.pollEvent()) events.push_back(*event);
  }
  void run(Duration span) {
    for (const Instant end = now + span; now < end;) step();
  }
  /// Until `done`; false after `limit`.
  bool runUntil(const std::function<bool()>& done, Duration limit) {
    for (const Instant end = now + limit; now < end && !done();) step();
    return done();
  }
  bool allExchanging() const {
    for (std::size_t i = 0; i < scanner.nodeCount(); ++i) {
      if (scanner.status(i).state != NodeState::kExchanging) return false;
    }
    return true;
  }
  bool reaches(NodeState state, Duration limit, std::size_t node = 0) {
    return runUntil([&] { return scanner.status(node).state == state; }, limit);
  }
  /// On-line, all exchanging and heard.
  bool starts() {
    begin();
    return runUntil(
        [&] {
          bool all = allExchanging();
          for (std::size_t i = 0; i < scanner.nodeCount(); ++i) {
            all = all && (no_inputs || scanner.input(i).count > 0);
          }
          return all;
        },
        std::chrono::seconds{4});
  }
  void say(const std::string& candump) { scanner.handleFrame(frame(candump), now); }

  std::size_t count(DevicenetEventKind kind) const {
    std::size_t found = 0;
    for (const DevicenetEvent& event : events) found += event.kind == kind ? 1 : 0;
    return found;
  }
  std::string eventText(DevicenetEventKind kind) const {
    for (const DevicenetEvent& event : events) {
      if (event.kind == kind) return event.text.str();
    }
    return "";
  }
  std::vector<std::string> violations() const {
    std::vector<std::string> all;
    for (const auto& device : devices) all.insert(all.end(), device->violations.begin(), device->violations.end());
    return all;
  }
  std::size_t sentTo(const std::string& id) const {
    std::size_t found = 0;
    for (const std::string& line : seen) found += line.rfind("> " + id + "#", 0) == 0 ? 1 : 0;
    return found;
  }

  Scanner scanner;
  std::vector<std::unique_ptr<FakeDevice>> devices;
  Instant now{std::chrono::hours{1}};
  std::vector<DevicenetEvent> events;
  std::vector<std::string> seen;  ///< "> 406#..." sent, "< 403#..." received
  std::vector<std::uint8_t> output{0x00, 0x7E, 0x04, 0x00, 0x00};
  bool sets_outputs = true;
  bool link_full = false;
  bool no_inputs = false;
  std::function<bool(const CanFrame&)> loses, doubles;
  std::function<void(const CanFrame&)> on_sent;
  std::function<void()> before_cycle;

 private:
  int steps_per_cycle_;
  int steps_ = 0;
};

}  // namespace nord_driver::devicenet
