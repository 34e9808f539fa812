// PROFIBUS as a way to parameters and nothing else: connections of class 2 (DP-V1, MS2) to the bus modules, on a serial
// line of our own. No station is parameterised, none exchanges data, no inverter gets a word.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "link/serial/byte_link.h"
#include "link/serial/serial_settings.h"
#include "nord_driver/trace/telegram_trace.h"
#include "nord_driver/transport/transport.h"
#include "profibus/class2_master.h"
#include "transport/bus_scanner.h"
#include "transport/profibus/profibus_dp_config.h"
#include "transport/profibus/profibus_parameters.h"
#include "transport/profibus/profibus_recorder.h"

namespace nord_driver {

/// For nord_param: for a station that is not in data exchange, and shall not be, or cannot be: its configuration does
/// not fit, its P509 selects another bus, its address is still 126. Only modules SK CU4/TU4-PBR have an acyclic
/// channel.
///
/// The status word, which says whether a drive runs and which parameter set is in force, is read as a parameter: P741
/// [-01] of the inverter (BU 0220 5.1, BU 2700 6.6). A drive that does not tell it stays silent to the layers above:
/// nobody writes to one that may be running. Whether every firmware shows it outside data exchange no manual says.
///
/// The same keys of the configuration as ProfibusDpTransport. Nothing is sent unless the program said that it serves
/// parameters only, or while another master is heard.
class ProfibusMs2Transport final : public Transport, public BusScanner {
 public:
  using LinkFactory = std::function<std::unique_ptr<link::ByteLink>(const link::SerialSettings&)>;

  /// On a serial port.
  ProfibusMs2Transport();
  /// On whatever the factory makes: a simulated segment in tests.
  explicit ProfibusMs2Transport(LinkFactory make_link);

  bool serveParametersOnly() noexcept override;
  EndPoint endPoint() const noexcept override { return {"device", "serial device", "/dev/ttyUSB0"}; }
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
  Sentence busText() const noexcept override;
  DriveIdentity identity(DriveIndex drive) const override;
  std::vector<std::string> warnings() const override;
  const TelegramTrace* trace() const noexcept override { return trace_ ? &*trace_ : nullptr; }
  void close() noexcept override;
  ScanReport scan(const Settings& bus, const std::atomic<bool>& end_asked) override;
  std::string quiet(const Settings& bus) const override;

 private:
  struct DriveState {
    Instant next_status{};
    Word status = 0;  ///< 0: not known
    Sentence why;     ///< ... because of this
    Sentence note;
  };

  bool linkReady() noexcept;
  void talk(Instant until) noexcept;
  void handleClosedLink() noexcept;
  void askStatus(DriveIndex drive) noexcept;
  void takeStatus(DriveIndex drive, DriveExchange& input) noexcept;
  void explain(DriveIndex drive) noexcept;

  LinkFactory make_link_;
  bool parameters_only_ = false;
  Duration period_{};
  ProfibusDpConfig config_;
  std::unique_ptr<link::ByteLink> link_;
  std::optional<profibus::Class2Master> master_;
  std::optional<ProfibusParameters> parameters_;
  std::optional<TelegramTrace> trace_;
  std::optional<ProfibusRecorder> recorder_;
  std::vector<DriveState> drives_;
  Instant next_open_{};
};

}  // namespace nord_driver
