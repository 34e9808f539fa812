// One slave as its master sees it: which request is next, and what its answer means.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/growing_pause.h"
#include "core/timer_table.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"
#include "profibus/dp_event.h"
#include "profibus/dp_services.h"
#include "profibus/fdl_request.h"
#include "profibus/frame_count.h"
#include "profibus/record_channel.h"
#include "profibus/slave_config.h"
#include "profibus/slave_status.h"

namespace nord_driver::profibus {

/// The order of EN 50170-8: FDL status, Slave_Diag, Set_Prm, Chk_Cfg, Slave_Diag until ready, data exchange. Everything
/// that goes wrong leads back to the beginning: at once when the slave left, when its silence has lasted, after a
/// growing pause when it refused.
class SlaveHandler {
 public:
  SlaveHandler(std::size_t index, const SlaveConfig& config, const BusParameters& bus);

  /// The line was opened anew: from the beginning.
  void restart(Instant now, DpEvents& events) noexcept;
  /// Another master leads the segment: from the beginning, once that one has gone.
  void giveWay(Instant now, DpEvents& events) noexcept;
  void startCycle() noexcept;

  // What this slave wants of the current cycle; asked once for each, in this order. A request is prepared where one
  // says yes.
  bool wantsExchange() const noexcept;
  bool wantsStartUpStep(Instant now) const noexcept;
  bool wantsDiagnosis() const noexcept;
  bool wantsProbe(Instant now) const noexcept;
  /// Its watchdog runs since it fell silent, and not for long: found again before it runs out, the drive behind does not
  /// trip.
  bool isUrgent(Instant now) const noexcept {
    return status_.phase == SlavePhase::kSilent && timers_.isRunning(Timer::kHaste, now);
  }
  /// Of an acyclic telegram beside data exchange.
  bool wantsAcyclic(Instant now) noexcept;
  void prepareAcyclic(FdlRequest& request, Instant now) noexcept;
  /// Writes the wanted request of all others.
  void prepare(FdlRequest& request, Instant now) noexcept;

  /// Its request goes out: it has heard it by then, if at all.
  void handleSent(Instant heard_by) noexcept { last_request_ = heard_by; }
  /// Its watchdog, which is not ours, is waited for: whatever a slave hears of its master may start it anew.
  bool isLeftToItsWatchdog() const noexcept {
    return status_.phase == SlavePhase::kBackOff && isLeftRunning(status_.diagnosis);
  }
  void handleAnswer(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept;
  /// The request was sent, retries included, and not answered.
  void handleNoAnswer(Mismatch mismatch, Instant now, DpEvents& events) noexcept;

  void setOutputs(ByteView outputs) noexcept;
  void setSilenceLimit(Duration limit) noexcept;
  ByteView inputs() const noexcept { return inputs_; }
  bool isSynchronised() const noexcept { return services_.isSynchronised(config_); }
  const SlaveStatus& status() const noexcept { return status_; }
  /// Get_Cfg beside data exchange; false when the slave is not in it.
  bool requestConfiguration() noexcept;
  Sentence configurationText() const noexcept;
  /// Slave_Diag behind the next exchange, announced or not.
  void requestDiagnosis() noexcept { diagnosis_due_ = status_.phase == SlavePhase::kDataExchange; }
  /// See DpMaster.
  bool submitRecord(const RecordRequest& request) noexcept;
  std::optional<RecordResult> pollRecord() noexcept { return records_.pollResult(); }
  SlaveCounters& counters() noexcept { return status_.counters; }

 private:
  struct Fault {
    DpEventKind kind;
    const char* text;
  };
  enum class Timer : std::uint8_t {
    kNextRequest,  ///< none before: probes, back-off, slow polling
    // From the acknowledgement of Chk_Cfg on:
    kAskOften,          ///< asked once per cycle until then
    kOwnerLimit,        ///< until then it may not have taken us for its master
    kReadyLimit,        ///< until then it may not be ready
    kHaste,             ///< since it fell silent, or the line was opened anew: see isUrgent()
    kWatchdog,          ///< likewise, its watchdog has not run out: it may be in data exchange with us still
    kNoParameters,      ///< gone on with and unanswered: its watchdog may have begun anew, and runs until then
    kUndiagnosedLimit,  ///< in data exchange, set when Slave_Diag was not answered
    kRefusedLimit,      ///< likewise, set when the exchange was refused
    kCount
  };
  enum class Service : std::uint8_t { kFdlStatus, kSlaveDiag, kGetCfg, kSetPrm, kChkCfg, kDataExchange, kRecord };

  Service nextService() noexcept;
  void handleNoOptionalAnswer(Instant now, DpEvents& events) noexcept;
  void handleNoExchange(Mismatch mismatch, Instant now, DpEvents& events) noexcept;
  void handleRefusedExchange(ResponseCode code, Instant now, DpEvents& events) noexcept;
  void onFdlStatus(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept;
  void onDiagnosis(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept;
  void onConfiguration(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept;
  void onAcknowledge(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept;
  void onExchange(const FdlAnswer& answer, Instant now, DpEvents& events) noexcept;

  void judgeFirst(Instant now, DpEvents& events) noexcept;
  void judgeReady(Instant now, DpEvents& events) noexcept;
  void judgeInExchange(Instant now, DpEvents& events) noexcept;
  /// What makes data exchange impossible, as the diagnosis shows it; who it is and whose it is come first.
  std::optional<Fault> strangerIn(const Diagnosis& diagnosis) const noexcept;
  std::optional<Fault> faultIn(const Diagnosis& diagnosis) const noexcept;
  bool isLeftRunning(const Diagnosis& diagnosis) const noexcept;
  void leaveRunning(Instant now, DpEvents& events) noexcept;

  void mayRunUntilWatchdogOf(Instant heard) noexcept;
  void waitForWatchdog() noexcept;
  void fallSilent(Instant due, const char* note) noexcept;
  void startOver(const char* note, bool resumes = false) noexcept;
  void enterDataExchange(DpEvents& events) noexcept;
  void lose(LossCause cause, const char* text, Instant now, DpEvents& events) noexcept;
  void backOff(const Fault& fault, Instant now, DpEvents& events) noexcept;
  void forgetFaults() noexcept;
  DpEvent event(DpEventKind kind, const char* text) const noexcept;

  std::size_t index_;
  SlaveConfig config_;
  DpServices services_;
  std::uint8_t master_;
  Duration probe_interval_;

  SlaveStatus status_;
  FrameCount frame_count_;
  RecordChannel records_;
  std::vector<std::uint8_t> outputs_, inputs_;  // sized once, in the constructor
  Service asked_ = Service::kFdlStatus;
  bool stepped_ = false;        // had its request of this cycle
  bool exchanged_ = false;      // it was in data exchange, and no start-up has begun since
  bool resuming_ = false;       // in kFirstDiagnosis: first of all it is asked whether it is in data exchange still
  bool diagnosis_due_ = false;  // in data exchange: DH was seen
  TimerTable<Timer> timers_;
  Instant last_request_{};    // heard by then, if at all
  Instant last_answer_{};     // of whatever kind: its watchdog runs from there at the earliest
  Duration silence_limit_{};  // of data exchange without an answer
  GrowingPause back_off_;
  bool configuration_wanted_ = false;   // by requestConfiguration()
  bool configuration_doubted_ = false;  // Cfg_Fault was seen
  bool watchdog_unasked_ = false;       // WD_On was seen behind our own Set_Prm, which brings none, and stands
  bool told_configuration_ = false;
  bool told_found_ = false;
  std::optional<DpEventKind> told_fault_;
};

}  // namespace nord_driver::profibus
