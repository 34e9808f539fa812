// How a device is brought to exchange, kept there and let go: allocate its explicit connection, read and compare its
// identity, allocate its I/O connection, read and compare its sizes, write its expected packet rate and use what it
// answers; keep the explicit connection alive; release what was allocated after a loss, and begin again.
//
// Process data of before that run yet, as a killed driver leaves them, are released after their own time-out only: it may be
// all that stops a motor, and whether words of ours would follow is not known before everything has been compared.
//
// Inputs and outputs may go by two connection objects, allocated together: a bit strobe with a poll beside it, and change
// of state or cyclic where the device answers so (makers print both layouts, see mayTakeBySecond()). The sizes of both are
// compared, then the rates of both are written, that of the outputs last. Between the two the control supervisors are asked
// for their state, where the configuration wants that: no time-out runs yet, and nothing of ours acts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/timer_table.h"
#include "devicenet/connect_requests.h"
#include "devicenet/explicit_channel.h"
#include "devicenet/node_config.h"
#include "devicenet/node_report.h"
#include "devicenet/scanner_config.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

class NodeConnect {
 public:
  /// The references live longer than this.
  NodeConnect(const NodeConfig& config, const ScannerConfig& bus, NodeReport& report,
              ExplicitChannel& channel) noexcept;

  /// We are on-line: from the beginning, but not before the own time-out of a device that `stop()` left running.
  void start(Instant now) noexcept;
  /// Nothing may be sent any more, until `start()`; without process data of our own not before the time-out has run out
  /// that a driver may have left it with.
  void stop(const Sentence& why, Instant now) noexcept;
  /// Lets go what is allocated, but nothing of a device whose own time-out is awaited; then nothing, until `start()`.
  void release(Instant now) noexcept;
  bool released() const noexcept { return phase_ == Phase::kReleased || phase_ == Phase::kOff; }

  /// How the exchange failed.
  enum class Loss : std::uint8_t {
    kTold,         ///< the device said so: it is let go at once
    kSilent,       ///< it may hear us without being heard: its own time-out is waited for, then it is let go
    kSilentMoving  ///< the same, and its outputs go on before that, until `endOutputs()`
  };
  /// The exchange failed: what was allocated is released, and everything begins again.
  void handleLoss(const Sentence& why, Instant now, Loss loss = Loss::kTold) noexcept;
  /// The outputs of a device that fell silent while it was moving have ended: its own time-out begins.
  void endOutputs(Instant now) noexcept;
  /// Another master was heard to ask this device.
  void handleForeignMaster(std::uint8_t mac, Instant now) noexcept;
  /// Another master was heard to send it process data: for some time nothing of it is released, unless it says that it is
  /// ours.
  void handleForeignIo(Instant now) noexcept;
  /// It was heard to let another master allocate it: nothing of it is ours.
  void handleForeignGrant(Instant now) noexcept;
  /// The device gave a sign of life beside its connections: it is tried soon, but not before its own time-out after it
  /// fell silent.
  void handleSign(Instant now) noexcept;
  /// Something speaks for the connection being gone: the device is asked now.
  void checkSoon(Instant now) noexcept;
  /// Goes on with what came and what is due.
  void poll(Instant now) noexcept;
  std::optional<Instant> nextDeadline() const noexcept { return timers_.nextTimeout(); }

  /// Process data are exchanged; with explicit messaging alone: requests are taken.
  bool exchanging() const noexcept {
    return phase_ == Phase::kRunning || phase_ == Phase::kKeepAlive || phase_ == Phase::kReopen;
  }
  /// Outputs are sent: it exchanges, or it fell silent while it was moving.
  bool sendsOutputs() const noexcept { return exchanging() || phase_ == Phase::kLastOutputs; }
  /// Its own time-out is awaited: nothing is sent to it, or nothing but whether that has run out.
  bool awaitsOwnTimeOut() const noexcept {
    return phase_ == Phase::kAwaitOwnTimeOut || (asksForIoOfBefore() && !report_.status().reason.empty());
  }
  /// Of the process data, as the device answered.
  Duration rate() const noexcept { return rate_; }

 private:
  /// A connection for process data of before, while its time-out is awaited.
  struct OfBefore {
    int writings = 0;             // of its rate
    bool written = false;         // answered, be it refused
    std::optional<Instant> over;  // later than this its time-out is not to come
  };
  enum class Phase : std::uint8_t {
    kOff,
    kPause,            ///< before the next try
    kLastOutputs,      ///< it fell silent, and is sent yet what stops it
    kAwaitOwnTimeOut,  ///< it fell silent and may still act on our last words: nothing shortens this pause
    kAllocateExplicit,
    kAskOwner,           ///< whose it is, on the unconnected port
    kAskOwnerConnected,  ///< the same on the explicit connection, which may be ours from before
    kIoState,            ///< whether process data of before run yet
    kIoRate,             ///< and whether they have a time-out
    kShortenIoRate,      ///< which is brought forward
    kAwaitIoOfBefore,    ///< until it has run out
    kReleaseStale,       ///< what is ours from before
    kVendorId,
    kDeviceType,
    kProductCode,
    kRevision,
    kExplicitRate,
    kAllocateIo,
    kReleaseStaleIo,
    kProducedSize,
    kSecondState,  ///< whether there is a second connection object, which takes the outputs
    kConsumedSize,
    kSupervisor,  ///< its state, before anything of ours can change it
    kWriteRate,
    kReadRate,  ///< when it did not answer the write with its value
    kRunning,
    kKeepAlive,  ///< running, and asked for the state of its connection
    kReopen,     ///< running, and its explicit connection is allocated again
    kReleaseIo,  ///< refused; the explicit connection stays
    kRefusedPause,
    kReleaseAll,  ///< before the next try
    kReleasing,   ///< for good
    kReleased
  };
  enum class Timer : std::uint8_t { kRetry, kKeepAlive, kCount };

  void enter(Phase phase, Instant now) noexcept;
  void beginTry(Instant now) noexcept;
  std::optional<ConnectRequest> requestOf(Phase phase) const noexcept;
  void handleAnswer(const ExplicitAnswer& answer, Instant now) noexcept;
  void handleAllocated(const ExplicitAnswer& answer, Instant now) noexcept;
  void handleOwner(const ExplicitAnswer& answer, Instant now) noexcept;
  void askIoState(std::uint8_t instance, Instant now) noexcept;
  void handleIoState(const ExplicitAnswer& answer, Instant now) noexcept;
  void handleIoRate(const ExplicitAnswer& answer, Instant now) noexcept;
  void awaitIoOfBefore(Duration rate, Instant now) noexcept;
  OfBefore& ofBefore() noexcept { return of_before_[instance_ - kFirstIoInstance]; }
  void handleNoIoState(const ExplicitAnswer& answer, Instant now) noexcept;
  bool asksForIoOfBefore() const noexcept {
    return phase_ == Phase::kIoState || phase_ == Phase::kIoRate || phase_ == Phase::kShortenIoRate ||
           phase_ == Phase::kAwaitIoOfBefore;
  }
  void handleIdentity(const ExplicitAnswer& answer, Instant now) noexcept;
  void compareIdentity(Instant now) noexcept;
  void handleExplicitRate(const ExplicitAnswer& answer, Instant now) noexcept;
  void handleIoAllocated(const ExplicitAnswer& answer, Instant now) noexcept;
  void handleSize(const ExplicitAnswer& answer, Instant now) noexcept;
  void handleSecondState(const ExplicitAnswer& answer, Instant now) noexcept;
  void compareSizes(std::uint16_t consumed, Instant now) noexcept;
  void askSupervisor(std::uint8_t first, Instant now) noexcept;
  void handleSupervisor(const ExplicitAnswer& answer, Instant now) noexcept;
  void handleRate(const ExplicitAnswer& answer, Instant now) noexcept;
  void useRate(Duration rate, Instant now) noexcept;
  void handleState(const ExplicitAnswer& answer, Instant now) noexcept;
  void handleLetGo(const ExplicitAnswer& answer, Instant now) noexcept;
  void handleReopened(const ExplicitAnswer& answer, Instant now) noexcept;
  void run(Instant now) noexcept;
  void armKeepAlive(Instant now) noexcept;
  void pollKeepAlive(Instant now) noexcept;
  void pause(Duration span, Instant now, Phase phase = Phase::kPause) noexcept;
  Duration retryPause() const noexcept;
  /// The explicit connection was allocated in this try.
  bool explicitHeld() const noexcept { return phase_ >= Phase::kVendorId; }
  /// The connecting failed: it fell silent.
  void fail(const Sentence& why, Instant now) noexcept;
  void tellRefused(const Sentence& why, Instant now) noexcept;
  /// Refused and let go.
  void refuse(const Sentence& why, Instant now) noexcept;
  /// Refused, but parameters stay in reach: the reason may be one of them.
  void refuseIo(const Sentence& why, Instant now) noexcept;
  void letGo(Instant now) noexcept;
  bool isPolledByAnother(Instant now) const noexcept;
  /// Another one's connections would be released: what is under way is not sent again.
  void stopReleasing(Instant now) noexcept;
  /// As it is, and begins again.
  void leave(Instant now) noexcept;
  Duration pauseAfterRelease() const noexcept;
  /// Nothing is sent from now on that keeps it running: how long it may do so.
  void awaitOwnTimeOut(Instant now) noexcept;
  void awaitOwnTimeOutOfBefore(Instant now) noexcept;

  const NodeConfig& config_;
  const ScannerConfig& bus_;
  NodeReport& report_;
  ExplicitChannel& channel_;
  std::uint8_t io_choice_;
  std::uint8_t inputs_instance_;   // the connection object by which the inputs come
  std::uint8_t outputs_instance_;  // the one that carries the outputs: whose time-out stops the device
  std::uint8_t instance_;          // the one that is set up or asked for
  std::uint16_t produced_ = 0;     // its size
  std::uint8_t supervisor_ = 1;    // the instance that is asked for
  bool let_go_first_ = false;      // a try that begins with a release
  Phase phase_ = Phase::kOff;
  TimerTable<Timer> timers_;
  std::uint8_t held_ = 0;   // what the device may have allocated to us
  std::uint8_t stale_ = 0;  // what is to be released of before
  std::array<OfBefore, kLastIoInstance - kFirstIoInstance + 1> of_before_{};
  unsigned failures_ = 0;       // tries without success, since it last ran
  unsigned conflicts_ = 0;      // of this try
  unsigned lost_explicit_ = 0;  // tries that ended so, since it last ran
  Duration rate_{};
  Instant own_time_out_{};  // until then it may run on the last words it heard of us
  std::optional<std::uint8_t> foreign_mac_;
  Instant foreign_at_{};
  std::optional<Instant> polled_at_;  // by another master
};

}  // namespace nord_driver::devicenet
