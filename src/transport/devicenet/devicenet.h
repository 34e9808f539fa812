// DeviceNet as a transport: our own scanner on a CAN interface, inverters behind their bus modules.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "devicenet/scanner.h"
#include "transport/bus_scanner.h"
#include "transport/can/can_transport.h"
#include "transport/devicenet/devicenet_config.h"
#include "transport/devicenet/devicenet_drive.h"
#include "transport/result_turns.h"

namespace nord_driver {

/// Joins the DeviceNet scanner (devicenet/), a CAN link (link/) and what the bytes of the assemblies mean (assembly.h).
///
/// A cycle: every connected module gets its outputs. Explicit messages, acknowledges and the connecting of devices do not
/// wait for the next cycle, nor does it for them.
///
/// Devices that belong to another scanner are not taken away from it: they refuse to be allocated, and the scanner that
/// has our MAC id already answers the duplicate-MAC check.
///
/// For parameters only: no process data are exchanged, so that no time-out begins, and nothing is sent on a bus on which
/// another scanner was heard.
class DeviceNetTransport final : public CanTransport, public BusScanner {
 public:
  /// On an interface of the kernel, or a virtual bus; or on whatever the factory makes: a simulated bus in tests.
  explicit DeviceNetTransport(LinkFactory make_link = {}) : CanTransport(std::move(make_link)) {}

  void configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) override;
  bool submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept override;
  std::optional<profile::ParameterResult> pollResult() noexcept override { return result_turns_.poll(drives_); }
  profile::ParameterCapabilities parameterCapabilities(DriveIndex /*drive*/) const noexcept override {
    return DevicenetParameters::capabilities();
  }
  bool connected() const noexcept override;
  BusCounters counters() const noexcept override;
  DriveNote note(DriveIndex drive) const noexcept override;
  std::uint32_t identNumber(DriveIndex drive) const noexcept override;
  Sentence busText() const noexcept override;
  DriveIdentity identity(DriveIndex drive) const override;
  std::vector<std::string> warnings() const override;
  ScanReport scan(const Settings& bus, const std::atomic<bool>& end_asked) override;
  std::string quiet(const Settings& bus) const override;

  const DevicenetConfig& config() const noexcept { return config_; }

 private:
  static bool isUrgent(const profile::ProcessOutput& before, const profile::ProcessOutput& now) noexcept;
  void putOutputs(const std::vector<profile::ProcessOutput>& outputs) noexcept override;
  void takeInputs(Instant now, std::vector<DriveExchange>& inputs) noexcept override;
  bool allAnswered() const noexcept override;
  void runRequests(Instant now) noexcept override;
  void takeEvents() noexcept override;
  void restartDrives() noexcept override;
  void handleGone() noexcept override;
  void handleController(bool works) noexcept override;
  bool holdsBack(const DevicenetModule& module) const noexcept;
  void putModuleOutputs(std::size_t module, std::uint8_t bits) noexcept;
  bool busWorks() const noexcept;
  Duration longestPause(std::size_t module) const noexcept;
  Sentence silenceText() const noexcept;

  DevicenetConfig config_;
  std::optional<devicenet::Scanner> scanner_;
  std::vector<DevicenetDriveState> drives_;
  std::vector<devicenet::IoBytes> outputs_;    // of each module
  std::vector<profile::ProcessOutput> given_;  // to each drive, in the cycle before
  std::vector<std::uint64_t> answered_;        // messages of each drive's module when the cycle began
  std::optional<Instant> online_at_;           // the duplicate-MAC check had ended; none: it has not been told
  ResultTurns result_turns_;
};

}  // namespace nord_driver
