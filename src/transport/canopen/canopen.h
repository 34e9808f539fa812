// CANopen as a transport: our own master on a CAN interface, inverters behind their options, ports and gateways.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "canopen/master.h"
#include "link/can/can_link.h"
#include "link/can/can_settings.h"
#include "nord_driver/trace/telegram_trace.h"
#include "nord_driver/transport/transport.h"
#include "transport/canopen/can_listen_first.h"
#include "transport/canopen/canopen_bus_events.h"
#include "transport/canopen/canopen_config.h"
#include "transport/canopen/canopen_drive.h"

namespace nord_driver {

/// Joins the CANopen master (canopen/), a CAN link (link/) and what the drives' objects mean (canopen_map.h).
///
/// A cycle: every operational node gets its RPDO, then SYNC goes out where it is used, then the answers are taken in
/// for `bus/answer_window` at most, or until each drive has sent a TPDO. An inverter that sends on change only has
/// nothing to send while nothing changes: it is not waited for beyond that window, and its last values count while it
/// is operational, its error control alive, and its event timer not overdue. In the pause between two cycles frames go
/// in and out as well: parameters, error control and start-ups do not wait for the next cycle, nor does it for them.
///
/// Before the first frame it listens: nodes that another master works with are not taken away from it, it is waited
/// for. From then on it holds them, but a drive that somebody else commands as well does not count as answering.
///
/// For parameters only: nothing is reset and nothing watched, and nothing is sent on a bus that somebody else works
/// with, whether it was heard before the first frame or came later.
class CanopenTransport final : public Transport {
 public:
  using LinkFactory = std::function<std::unique_ptr<link::CanLink>(const link::CanSettings&)>;

  /// On an interface of the kernel, or a virtual bus.
  CanopenTransport();
  /// On whatever the factory makes: a simulated bus in tests.
  explicit CanopenTransport(LinkFactory make_link);

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
    return CanopenParameters::capabilities();
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
  /// The nodes are let go first, each in its way, so that the end of guarding is no loss to them: a second at most.
  void close() noexcept override;

  const CanopenConfig& config() const noexcept { return config_; }

 private:
  bool linkReady() noexcept;
  bool busWorks() const noexcept;
  void restart() noexcept;
  bool isSilent() const noexcept { return listen_first_->isSilent(); }
  bool mayTalk(Instant now) noexcept;
  /// `received`: what had come until then was received.
  void run(Instant received, Instant until, bool until_answered) noexcept;
  /// Takes in what has come; the moment before the first look.
  Instant receive() noexcept;
  void send(Instant until) noexcept;
  /// To nodes that fell silent and may hear us all the same.
  void commandUnheardNodes() noexcept;
  void runParameters() noexcept;
  void takeEvents() noexcept;
  void takeLineCounters() noexcept;
  bool allAnswered() const noexcept;
  void release() noexcept;

  LinkFactory make_link_;
  bool parameters_only_ = false;
  CanopenConfig config_;
  Duration period_{};
  std::unique_ptr<link::CanLink> link_;
  std::optional<canopen::Master> master_;
  std::optional<CanListenFirst> listen_first_;  // once configured
  bool opened_ = false;                         // ever
  std::optional<TelegramTrace> trace_;
  std::vector<CanopenDriveState> drives_;
  std::vector<std::uint64_t> answered_;  // TPDOs of each drive when the cycle began
  Instant cycle_start_{};
  Instant next_open_{};
  DriveIndex result_cursor_ = 0;
  CanopenBusEvents events_;
  link::CanCounters line_;  // as the interface told them last
  Instant next_line_counters_{};
};

}  // namespace nord_driver
