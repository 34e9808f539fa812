// PROFIBUS DP as a transport: our own master on a serial line, process data as PPO 1 to 4, one drive per module or up
// to four.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/event_ring.h"
#include "link/serial/byte_link.h"
#include "link/serial/serial_settings.h"
#include "nord_driver/trace/telegram_trace.h"
#include "nord_driver/transport/transport.h"
#include "profibus/bus_scan.h"
#include "profibus/dp_master.h"
#include "transport/bus_scanner.h"
#include "transport/profibus/inverter_presence.h"
#include "transport/profibus/profibus_dp_config.h"
#include "transport/profibus/profibus_parameters.h"
#include "transport/profibus/profibus_recorder.h"
#include "transport/profibus/profibus_text.h"

namespace nord_driver {

/// Joins the DP master (profibus/), a byte link (link/) and the layout of the process data (profile/). This is where
/// words become bytes: PROFIBUS sends the high byte first (EN 50170-8; BU 2700 6.6).
///
/// It owns the digital outputs of a module with an I/O byte (SK TU4-PBR: DO1, DO2) and holds them at 0: nobody switches
/// anything with them, whatever the drives do.
class ProfibusDpTransport final : public Transport, public BusScanner {
 public:
  using LinkFactory = std::function<std::unique_ptr<link::ByteLink>(const link::SerialSettings&)>;

  /// On a serial port.
  ProfibusDpTransport();
  /// On whatever the factory makes: a simulated segment in tests.
  explicit ProfibusDpTransport(LinkFactory make_link);

  bool serveParametersOnly() noexcept override;
  EndPoint endPoint() const noexcept override { return {"device", "serial device", "/dev/ttyUSB0"}; }
  void configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) override;
  void setDriveTimeout(Duration timeout) noexcept override;
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
  std::vector<std::string> warnings() const override { return config_.warnings; }
  std::optional<BusEvent> pollEvent() noexcept override;
  const TelegramTrace* trace() const noexcept override { return trace_ ? &*trace_ : nullptr; }
  void close() noexcept override;
  ScanReport scan(const Settings& bus, const std::atomic<bool>& end_asked) override;
  std::string quiet(const Settings& bus) const override;

  const ProfibusDpConfig& config() const noexcept { return config_; }

 private:
  struct DriveState {
    bool module_answers = false;
    bool inverter_answers = false;
    std::size_t place = 0;              ///< among the drives of its station
    std::uint64_t departures_told = 0;  ///< of its station
    Sentence note;
  };

  bool linkReady() noexcept;
  template <typename Engine, typename Done>
  void run(Engine& engine, Done done) noexcept;
  void runMaster() noexcept;
  bool scanning() noexcept;
  void watchLine() noexcept;
  /// In data exchange: one that misses a cycle is not lost yet.
  bool isExchanging(std::size_t station) const noexcept;
  Sentence silenceText() const noexcept;
  bool mayBeSynchronised(const std::vector<profile::ProcessOutput>& outputs,
                         const std::vector<DriveExchange>& inputs) const noexcept;
  void putOutputs(std::size_t station, const std::vector<profile::ProcessOutput>& outputs) noexcept;
  void takeInputs(std::size_t station, std::vector<DriveExchange>& inputs) noexcept;
  void takeInverter(DriveIndex drive, ByteView station_inputs, DriveExchange& input,
                    profile::PkwWords& pkw) const noexcept;
  Interruption takeInterruption(DriveIndex drive) noexcept;
  void askModule(std::size_t station) noexcept;
  void explain(DriveIndex drive) noexcept;

  LinkFactory make_link_;
  bool parameters_only_ = false;
  ProfibusDpConfig config_;
  std::unique_ptr<link::ByteLink> link_;
  std::optional<profibus::DpMaster> master_;
  std::optional<profibus::BusScan> scan_;  // until it has ended
  std::optional<ProfibusParameters> parameters_;
  std::optional<ProfibusText> text_;
  std::optional<TelegramTrace> trace_;
  std::optional<ProfibusRecorder> recorder_;
  std::vector<DriveState> drives_;
  std::vector<InverterPresence> presence_;  // of the stations
  // Beside the master's: of a scan that finds all.
  EventRing<BusEvent, profibus::BusScan::kAddresses + 1> own_events_;
  Sentence live_list_;
  Instant next_open_{};
  std::uint64_t foreign_seen_ = 0, busy_seen_ = 0;
  std::optional<Instant> last_foreign_, last_busy_;
};

}  // namespace nord_driver
