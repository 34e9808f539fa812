// What every simulated robot of these tests does, whatever bus it is on: cycles, commands, requests, answers.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "cycle/bus_cycle.h"
#include "cycle/cycle_config.h"
#include "cycle/cycle_ports.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::test {

/// m/s of the robots of these tests: 25 Hz, half of P105.
inline constexpr double kHalfSpeed = 0.39269908169872414;

/// Puts another transport between the driver and its own, configured one.
using TransportWrap = std::function<std::unique_ptr<Transport>(std::unique_ptr<Transport>)>;

/// The driver below ROS on a transport in simulated time. A robot derives from it and calls `start()` once.
class DrivenRobot {
 public:
  /// One bus cycle and the pause after it.
  void step() {
    const Instant start = transport_->now();
    cycle_->runOnce();
    exchange_time_ = transport_->now() - start;
    transport_->sleepUntil(start + cycle_->period());
    while (const auto completion = ports_->waitCompletion(Duration::zero())) completions_.push_back(*completion);
  }
  void run(Duration span) {
    const Instant end = transport_->now() + span;
    while (transport_->now() < end) step();
  }
  /// Steps until `done` or `limit`; true when done.
  template <typename Condition>
  bool runUntil(Condition done, Duration limit = std::chrono::seconds{20}) {
    const Instant end = transport_->now() + limit;
    while (!done()) {
      if (transport_->now() >= end) return false;
      step();
    }
    return true;
  }

  void command(double linear, double angular = 0.0) {
    ports_->commandBase({{linear, angular}, transport_->now(), true});
  }
  /// Drives on with the same command, renewed every cycle.
  void drive(double linear, double angular, Duration span) {
    const Instant end = transport_->now() + span;
    while (transport_->now() < end) {
      command(linear, angular);
      step();
    }
  }

  /// Asks and runs until the answer has come.
  cycle::Completion ask(cycle::RequestKind kind, DriveIndex drive = cycle::kAllDrives) {
    cycle::Request request;
    request.kind = kind;
    request.drive = drive;
    return ask(request);
  }
  cycle::Completion ask(cycle::Request request) {
    request.id = next_id_++;
    request.patience = std::chrono::seconds{3};
    ports_->submit(request);
    cycle::Completion answer;
    answer.message = "no answer";
    std::size_t seen = completions_.size();
    runUntil([&] {
      for (; seen < completions_.size(); ++seen) {
        if (completions_[seen].id == request.id) answer = completions_[seen];
      }
      return answer.id == request.id;
    });
    return answer;
  }
  /// From power-on to drives that could be enabled.
  bool bringUp() {
    return runUntil([this] {
      for (const cycle::DriveSnapshot& drive : snapshot().drives) {
        if (!drive.device.complete) return false;
      }
      return true;
    });
  }
  bool bringUpAndEnable() { return bringUp() && ask(cycle::RequestKind::kEnable).success; }

  /// The driver ends at once, without a word to anybody, and begins anew over the same bus: it knows nothing.
  void restartDriver() {
    ports_ = std::make_unique<cycle::CyclePorts>(config_.drives.size());
    cycle_ = std::make_unique<cycle::BusCycle>(config_, *transport_, *ports_, false);
  }

  /// Every answer so far, or since they were forgotten.
  const std::vector<cycle::Completion>& completions() const { return completions_; }
  void forgetCompletions() { completions_.clear(); }
  const cycle::CycleSnapshot& snapshot() { return ports_->readSnapshot(); }
  /// What left for a drive in the last cycle, and what came back.
  Word controlWord(DriveIndex drive) { return snapshot().drives[drive].output.control_word; }
  std::int16_t setpoint(DriveIndex drive) { return snapshot().drives[drive].output.setpoints[0]; }
  Word statusWord(DriveIndex drive) { return snapshot().drives[drive].input.status_word; }
  /// Of the last cycle, without its pause.
  Duration exchangeTime() const { return exchange_time_; }

  cycle::CyclePorts& ports() { return *ports_; }
  Transport& transport() { return *transport_; }
  const cycle::CycleConfig& config() const { return config_; }

 protected:
  DrivenRobot() = default;
  ~DrivenRobot() = default;

  /// `transport` has been configured for these drives.
  void start(const cycle::CycleConfig& config, std::unique_ptr<Transport> transport, bool auto_enable,
             const TransportWrap& wrap = {}) {
    config_ = config;
    transport_ = wrap ? wrap(std::move(transport)) : std::move(transport);
    ports_ = std::make_unique<cycle::CyclePorts>(config_.drives.size());
    cycle_ = std::make_unique<cycle::BusCycle>(config_, *transport_, *ports_, auto_enable);
  }

 private:
  cycle::CycleConfig config_;
  std::unique_ptr<Transport> transport_;
  std::unique_ptr<cycle::CyclePorts> ports_;
  std::unique_ptr<cycle::BusCycle> cycle_;
  std::vector<cycle::Completion> completions_;
  std::uint32_t next_id_ = 1;
  Duration exchange_time_{};
};

}  // namespace nord_driver::test
