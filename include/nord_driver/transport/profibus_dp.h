// PROFIBUS DP as a transport: our own master on a serial line, one slave per drive, process data as PPO 1 to 4.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/link/byte_link.h"
#include "nord_driver/link/serial_port.h"
#include "nord_driver/profibus/dp_master.h"
#include "nord_driver/profile/pkw_channel.h"
#include "nord_driver/transport/parameters_only.h"
#include "nord_driver/transport/profibus_dp_config.h"
#include "nord_driver/transport/profibus_recorder.h"
#include "nord_driver/transport/telegram_trace.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver {

/// Joins the DP master (profibus/), a byte link (link/) and the layout of the process data (profile/). This is where
/// words become bytes: PROFIBUS sends the high byte first (EN 50170-8; BU 2700 6.6).
class ProfibusDpTransport final : public Transport, public ParametersOnly {
 public:
  using LinkFactory = std::function<std::unique_ptr<link::ByteLink>(const link::SerialSettings&)>;

  /// On a serial port.
  ProfibusDpTransport();
  /// On whatever the factory makes: a simulated segment in tests.
  explicit ProfibusDpTransport(LinkFactory make_link);

  void serveParametersOnly() noexcept override { parameters_only_ = true; }
  void configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) override;
  Instant now() const noexcept override;
  void sleepUntil(Instant when) noexcept override;
  void exchange(const std::vector<profile::ProcessOutput>& outputs,
                std::vector<DriveExchange>& inputs) noexcept override;
  bool submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept override;
  std::optional<profile::ParameterResult> pollResult() noexcept override;
  bool connected() const noexcept override;
  BusCounters counters() const noexcept override;
  DriveNote note(DriveIndex drive) const noexcept override;
  std::uint32_t identNumber(DriveIndex drive) const noexcept override;
  Sentence busText() const noexcept override;
  DriveIdentity identity(DriveIndex drive) const override;
  const TelegramTrace* trace() const noexcept override { return trace_ ? &*trace_ : nullptr; }
  void close() noexcept override;

  const ProfibusDpConfig& config() const noexcept { return config_; }

 private:
  struct DriveState {
    explicit DriveState(Duration answer_timeout) : pkw(answer_timeout) {}
    profile::PkwChannel pkw;
    bool module_answers = false;
    bool inverter_answers = false;
  };

  bool linkReady() noexcept;
  void runMaster() noexcept;
  void putOutput(DriveIndex drive, const profile::ProcessOutput& output) noexcept;
  void takeInput(DriveIndex drive, DriveExchange& input) noexcept;

  LinkFactory make_link_;
  bool parameters_only_ = false;
  ProfibusDpConfig config_;
  std::unique_ptr<link::ByteLink> link_;
  std::optional<profibus::DpMaster> master_;
  std::optional<TelegramTrace> trace_;
  std::optional<ProfibusRecorder> recorder_;
  std::vector<DriveState> drives_;
  FixedVector<profile::ParameterResult, 16> refused_;
  Instant next_open_{};
  DriveIndex result_cursor_ = 0;
};

}  // namespace nord_driver
