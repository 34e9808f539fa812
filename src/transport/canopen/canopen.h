// CANopen as a transport: our own master on a CAN interface, inverters behind their options, ports and gateways.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "canopen/master.h"
#include "transport/bus_scanner.h"
#include "transport/can/can_transport.h"
#include "transport/canopen/canopen_config.h"
#include "transport/canopen/canopen_drive.h"
#include "transport/result_turns.h"

namespace nord_driver {

/// Joins the CANopen master (canopen/), a CAN link (link/) and what the drives' objects mean (canopen_map.h).
///
/// A cycle: every operational node gets its RPDO, then SYNC goes out where it is used. An inverter that sends on change
/// only has nothing to send while nothing changes: it is not waited for beyond `bus/answer_window`, and its last values
/// count while it is operational, its error control alive, and its event timer not overdue.
///
/// Before the first frame it listens: nodes that another master works with are not taken away from it, it is waited
/// for. From then on it holds them, but a drive that somebody else commands as well does not count as answering.
///
/// A drive that it has heard as enabled by then is stopped before its node is reset or set up.
///
/// For parameters only: nothing is reset and nothing watched, and nothing is sent on a bus that somebody else works
/// with, whether it was heard before the first frame or came later.
class CanopenTransport final : public CanTransport, public BusScanner {
 public:
  /// On an interface of the kernel, or a virtual bus; or on whatever the factory makes: a simulated bus in tests.
  explicit CanopenTransport(LinkFactory make_link = {}) : CanTransport(std::move(make_link)) {}

  void configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) override;
  void setShutdownTimeout(Duration timeout) noexcept override;
  bool submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept override;
  std::optional<profile::ParameterResult> pollResult() noexcept override { return result_turns_.poll(drives_); }
  profile::ParameterCapabilities parameterCapabilities(DriveIndex /*drive*/) const noexcept override {
    return CanopenParameters::capabilities();
  }
  bool connected() const noexcept override;
  BusCounters counters() const noexcept override;
  DriveNote note(DriveIndex drive) const noexcept override;
  std::uint32_t identNumber(DriveIndex drive) const noexcept override;
  Sentence busText() const noexcept override;
  DriveIdentity identity(DriveIndex drive) const override;
  std::vector<std::string> warnings() const override;
  ScanReport scan(const Settings& bus, const std::atomic<bool>& end_asked) override;

  const CanopenConfig& config() const noexcept { return config_; }

 private:
  void lookForMotion(std::size_t node) noexcept;
  void putOutputs(const std::vector<profile::ProcessOutput>& outputs) noexcept override;
  void takeInputs(Instant now, std::vector<DriveExchange>& inputs) noexcept override;
  bool allAnswered() const noexcept override;
  void runRequests(Instant now) noexcept override;
  void takeEvents() noexcept override;
  void restartDrives() noexcept override;
  void handleGone() noexcept override { restart(); }
  void handleWhileListening(const CanFrame& frame, Instant at) noexcept override;
  void handleListened() noexcept override;

  CanopenConfig config_;
  std::optional<canopen::Master> master_;
  std::vector<CanopenDriveState> drives_;
  std::vector<std::uint64_t> answered_;  // TPDOs of each drive when the cycle began
  /// In which order they may ask next: who was served last stands last.
  std::vector<DriveIndex> turns_;
  ResultTurns result_turns_;
};

}  // namespace nord_driver
