// A bus cycle over a scripted transport: a base of two drives and a lift beside it.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cycle/bus_cycle.h"
#include "cycle/scripted_transport.h"

namespace nord_driver::cycle {

class CycleBench {
 public:
  static constexpr DriveIndex kLeft = 0, kRight = 1, kLift = 2;
  static constexpr Duration kCycle = std::chrono::milliseconds{10};

  /// `acceleration`: the limit of the base in m/s^2, both ways; 0: none.
  explicit CycleBench(std::optional<double> typed_max_frequency = std::nullopt, double acceleration = 0.0,
                      const drive::StopWays& ways = {})
      : CycleBench{config(typed_max_frequency, acceleration, ways)} {}
  explicit CycleBench(const CycleConfig& config, bool auto_enable = false)
      : CycleBench{config, ScriptedTransport{config.drives.size()}, auto_enable} {}
  /// `prepared`: what the cycle is told of the bus when it begins.
  CycleBench(const CycleConfig& config, const ScriptedTransport& prepared, bool auto_enable = false)
      : transport{prepared}, ports{config.drives.size()}, cycle{config, transport, ports, auto_enable} {}

  void step() {
    const Instant start = transport.time;
    cycle.runOnce();
    transport.sleepUntil(start + kCycle);
    while (const auto completion = ports.waitCompletion(Duration::zero())) completions[completion->id] = *completion;
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) step();
  }
  /// Without waiting for its answer; returns its id.
  std::uint32_t submit(Request request) {
    request.id = ++last_id;
    request.patience = std::chrono::seconds{3};
    ports.submit(request);
    return request.id;
  }
  std::uint32_t submit(RequestKind kind, DriveIndex drive) {
    Request request;
    request.kind = kind;
    request.drive = drive;
    return submit(request);
  }
  Completion ask(const Request& request) {
    const std::uint32_t id = submit(request);
    for (int i = 0; i < 400 && completions.count(id) == 0; ++i) step();
    return completions[id];
  }
  Completion ask(RequestKind kind, DriveIndex drive = kAllDrives) {
    Request request;
    request.kind = kind;
    request.drive = drive;
    return ask(request);
  }
  void commandBase(double linear, double angular = 0.0) {
    ports.commandBase({{linear, angular}, transport.time, true});
  }
  void commandLift(double velocity) { ports.commandDrive(kLift, {velocity, transport.time, true}); }
  /// What was told since this was asked last, a line each: "warning: ..." or "info: ...".
  std::vector<std::string> events() {
    std::vector<std::string> lines;
    while (const auto event = ports.pollBusEvent()) {
      lines.push_back((event->warning ? "warning: " : "info: ") + event->text.str());
    }
    return lines;
  }
  const CycleSnapshot& snapshot() { return ports.readSnapshot(); }
  std::int16_t setpoint(DriveIndex drive) const { return transport.outputs[drive].setpoints[0]; }
  Word controlWord(DriveIndex drive) const { return transport.outputs[drive].control_word; }

  // 50 Hz, two pole pairs, no gear: 100 % is 157.08 rad/s at the joint.
  static CycleConfig config(std::optional<double> typed_max_frequency = std::nullopt, double acceleration = 0.0,
                            const drive::StopWays& ways = {}) {
    CycleConfig config;
    config.stop_ways = ways;
    config.cmd_vel_timeout = std::chrono::milliseconds{500};
    config.shutdown_timeout = std::chrono::seconds{2};
    for (const char* name : {"left", "right", "lift"}) {
      DriveSetup setup;
      setup.name = name;
      setup.drive.joint.gear_ratio = 1.0;
      setup.drive.joint.pole_pairs = 2;
      setup.typed_max_frequency = typed_max_frequency;
      config.drives.push_back(setup);
    }
    config.base = BaseConfig{};
    config.base->left = {kLeft};
    config.base->right = {kRight};
    config.base->limits.linear_x.has_acceleration_limits = acceleration > 0.0;
    config.base->limits.linear_x.max_acceleration = acceleration;
    config.base->geometry.wheel_separation = 0.5;
    config.base->geometry.left_wheel_radius = config.base->geometry.right_wheel_radius = 0.1;
    return config;
  }

  ScriptedTransport transport;
  CyclePorts ports;
  BusCycle cycle;
  std::map<std::uint32_t, Completion> completions;
  std::uint32_t last_id = 0;
};

}  // namespace nord_driver::cycle
