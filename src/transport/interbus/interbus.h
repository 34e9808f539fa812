// InterBus as a transport: a ring of technology units behind a gateway that shows it as Modbus/TCP registers.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/register_image.h"
#include "link/modbus/register_link.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/transport/transport.h"
#include "transport/bus_scanner.h"
#include "transport/image_view.h"
#include "transport/interbus/first_look.h"
#include "transport/interbus/input_watch.h"
#include "transport/interbus/interbus_config.h"
#include "transport/interbus/interbus_counters.h"
#include "transport/interbus/interbus_drive.h"
#include "transport/interbus/modbus_trace.h"

namespace nord_driver {

/// Joins a link to a gateway (link/modbus/), the map of its image (interbus/) and what the words mean (profile/).
///
/// The cycle never waits for the network. It hands its outputs over at its beginning, then waits for the inputs that
/// answer them, for `bus/answer_window` at most, and takes the newest there are. While an image given earlier is still
/// unanswered it does not wait at all: a gateway that stalls costs the window once, and no cycle begins later for it.
///
/// `module_answers` says that the newest inputs are younger than the drive's time-out and the ring runs,
/// `inverter_answers` that such inputs came in this cycle and the status word is not zero. Good inputs end with an
/// interruption: kUnasked when the ring stands, kSilent when they are too old. `inverter_missing` is never said.
///
/// Over Modbus/TCP most gateways carry process data only: then there is no parameter channel. Where one offers Compact
/// PCP by registers (`bus/pcp`) there is one, which no real gateway has been tried with.
///
/// Who serves parameters only writes no image and no watchdog: the drives are another's, or nobody's.
class InterbusTransport final : public Transport, public ImageView, public BusScanner {
 public:
  using LinkFactory = std::function<std::unique_ptr<link::RegisterLink>(const link::ModbusSettings&)>;

  /// To a gateway in the network.
  InterbusTransport();
  /// To whatever the factory makes: a gateway in simulated time in tests.
  explicit InterbusTransport(LinkFactory make_link);

  EndPoint endPoint() const noexcept override {
    return {"gateway", "Modbus/TCP gateway", "192.168.0.10:502", "diagnosis"};
  }
  void configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) override;
  void setDriveTimeout(Duration timeout) noexcept override { watch_.setTimeout(timeout); }
  Instant now() const noexcept override { return link_->now(); }
  void sleepUntil(Instant when) noexcept override { link_->sleepUntil(when); }
  void exchange(const std::vector<profile::ProcessOutput>& outputs,
                std::vector<DriveExchange>& inputs) noexcept override;
  bool submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept override;
  std::optional<profile::ParameterResult> pollResult() noexcept override;
  profile::ParameterCapabilities parameterCapabilities(DriveIndex drive) const noexcept override;
  bool serveParametersOnly() noexcept override;
  bool connected() const noexcept override { return watch_.isGood(); }
  BusCounters counters() const noexcept override { return interbusCounters(counts_, report_.counters); }
  DriveNote note(DriveIndex drive) const noexcept override;
  Sentence busText() const noexcept override;
  DriveIdentity identity(DriveIndex drive) const override;
  std::vector<std::string> warnings() const override;
  std::optional<BusEvent> pollEvent() noexcept override { return events_.takeFront(); }
  const TelegramTrace* trace() const noexcept override { return trace_ ? &trace_->trace() : nullptr; }
  void close() noexcept override;

  void showWords(std::size_t count) override;
  std::string imageText() const override;
  std::vector<ImageWord> image() const override;
  /// Says why there is none, and opens nothing.
  ScanReport scan(const Settings& bus, const std::atomic<bool>& end_asked) override;

  const InterbusConfig& config() const noexcept { return config_; }

 private:
  static constexpr std::size_t kRequests = 256;

  bool linkReady() noexcept;
  void giveOutputs(const std::vector<profile::ProcessOutput>& outputs) noexcept;
  void waitForAnswer(Instant until) noexcept;
  void takeInputs(std::vector<DriveExchange>& inputs) noexcept;
  void tellRing(InputWorth before) noexcept;
  void serveParameters() noexcept;
  void takeAnswer() noexcept;
  std::optional<profile::ParameterResult> pollUnserved() noexcept;
  void readOnly();

  LinkFactory make_link_;
  InterbusConfig config_;
  bool read_only_ = false;
  std::size_t shown_words_ = 0;
  bool shows_ = false;
  std::unique_ptr<ModbusTrace> trace_;  // outlives the link
  std::unique_ptr<link::RegisterLink> link_;
  std::vector<InterbusDriveState> drives_;
  RegisterImage image_;   // the outputs
  RegisterImage newest_;  // the inputs, where they are shown
  std::uint64_t given_ = 0;
  InputWatch watch_;
  FirstLook first_look_;  // of a drive with DRIVECOM
  Word running_ = 0;      // the register that says whether the ring runs
  bool ring_stood_ = false;
  link::LinkReport report_;
  Instant next_open_{};
  InterbusCounts counts_;
  std::optional<InterbusParameters> parameters_;
  std::uint64_t order_ = 0;                         // the newest of the parameter channel
  FixedVector<std::uint32_t, kRequests> unserved_;  // ids of parameter requests
  FixedVector<BusEvent, 8> events_;                 // what does not fit is in the counters
};

}  // namespace nord_driver
