// DeviceNet as a transport: our own scanner on a CAN interface, inverters behind their bus modules.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "devicenet/scanner.h"
#include "link/can/can_link.h"
#include "link/can/can_settings.h"
#include "nord_driver/trace/telegram_trace.h"
#include "nord_driver/transport/transport.h"
#include "transport/devicenet/devicenet_bus_events.h"
#include "transport/devicenet/devicenet_config.h"
#include "transport/devicenet/devicenet_drive.h"
#include "transport/devicenet/devicenet_listen_first.h"

namespace nord_driver {

/// Joins the DeviceNet scanner (devicenet/), a CAN link (link/) and what the bytes of the assemblies mean (assembly.h).
///
/// A cycle: every connected module gets its outputs, then the answers are taken in for `bus/answer_window` at most, or
/// until each has answered. In the pause between two cycles frames go in and out as well: explicit messages,
/// acknowledges and the connecting of devices do not wait for the next cycle, nor does it for them.
///
/// Devices that belong to another scanner are not taken away from it: they refuse to be allocated, and the scanner that
/// has our MAC id already answers the duplicate-MAC check.
///
/// For parameters only: no process data are exchanged, so that no time-out begins, and nothing is sent on a bus on which
/// another scanner was heard.
class DeviceNetTransport final : public Transport {
 public:
  using LinkFactory = std::function<std::unique_ptr<link::CanLink>(const link::CanSettings&)>;

  /// On an interface of the kernel, or a virtual bus.
  DeviceNetTransport();
  /// On whatever the factory makes: a simulated bus in tests.
  explicit DeviceNetTransport(LinkFactory make_link);

  bool serveParametersOnly() noexcept override;
  EndPoint endPoint() const noexcept override { return {"interface", "CAN interface", "can0"}; }
  void configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) override;
  Instant now() const noexcept override;
  void sleepUntil(Instant when) noexcept override;
  void exchange(const std::vector<profile::ProcessOutput>& outputs,
                std::vector<DriveExchange>& inputs) noexcept override;
  bool submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept override;
  std::optional<profile::ParameterResult> pollResult() noexcept override;
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
  std::optional<BusEvent> pollEvent() noexcept override { return events_.poll(); }
  const TelegramTrace* trace() const noexcept override { return trace_ ? &*trace_ : nullptr; }
  /// The devices are released first: half a second at most.
  void close() noexcept override;

  const DevicenetConfig& config() const noexcept { return config_; }

 private:
  bool linkReady() noexcept;
  bool busWorks() const noexcept;
  void restart() noexcept;
  void watchController() noexcept;
  bool isSilent() const noexcept { return listen_first_ && listen_first_->isSilent(); }
  bool mayTalk(Instant now) noexcept;
  void setOutputs(const std::vector<profile::ProcessOutput>& outputs) noexcept;
  /// `received`: what had come until then was received.
  void run(Instant received, Instant until, bool until_answered) noexcept;
  /// Takes in what has come; the moment before the first look.
  Instant receive() noexcept;
  void send(Instant until) noexcept;
  void runRequests(Instant now) noexcept;
  void takeEvents() noexcept;
  void takeLineCounters() noexcept;
  bool allAnswered() const noexcept;
  void release() noexcept;
  Sentence silenceText() const noexcept;

  LinkFactory make_link_;
  bool parameters_only_ = false;
  DevicenetConfig config_;
  Duration period_{};
  std::unique_ptr<link::CanLink> link_;
  std::optional<devicenet::Scanner> scanner_;
  std::optional<DevicenetListenFirst> listen_first_;  // for parameters only
  bool controller_up_ = true;                         // as it was looked at last
  std::optional<TelegramTrace> trace_;
  std::vector<DevicenetDriveState> drives_;
  std::vector<devicenet::IoBytes> outputs_;  // of each module
  std::vector<std::uint64_t> answered_;      // messages of each drive's module when the cycle began
  Instant cycle_start_{};
  Instant next_open_{};
  DriveIndex result_cursor_ = 0;
  DevicenetBusEvents events_;
  link::CanCounters line_;  // as the interface told them last
  Instant next_line_counters_{};
};

}  // namespace nord_driver
