// The process data of one device: what is sent to it and when, what comes back, and whether it still comes.
#pragma once

#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "core/timer_table.h"
#include "devicenet/identifier.h"
#include "devicenet/io_fragments.h"
#include "devicenet/node_config.h"
#include "devicenet/node_report.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

/// What a device sent last while exchanging; `count` 0: nothing yet since it came to.
struct IoInput {
  IoBytes bytes;  ///< as long as configured
  Instant at{};
  std::uint64_t count = 0;
};

class IoConnection {
 public:
  /// `config` is complete and lives longer than this, like `report`. `cycle`: between two `startCycle()`.
  IoConnection(const NodeConfig& config, Duration cycle, NodeReport& report) noexcept;

  /// Both sides have agreed; `rate` is the expected packet rate the device answered.
  void establish(Duration rate, Instant now) noexcept;
  /// Nothing is sent or taken any more; outputs are forgotten.
  void close() noexcept;
  bool established() const noexcept { return established_; }

  /// The newest outputs, cut or filled with zeros to their size.
  void setOutput(ByteView bytes) noexcept;
  /// Whether what was set last lets the device move, as far as whoever sets it knows; see `mustStop()`.
  void setMoves(bool moves) noexcept { moves_ = moves; }
  /// What was set last is not to wait for the rate of a cyclic connection: the device takes what comes earlier.
  void hurry() noexcept { due_ = established_; }
  const IoInput& input() const noexcept { return input_; }

  /// Makes due what this cycle sends. What the last one left is dropped.
  void startCycle(Instant now) noexcept;
  /// Whether the strobe command of this cycle is for this device too, and its bit in it. With a bit of 1 a NORD module
  /// keeps its last outputs (BU 0280 4.2.1): where they go by a poll it is 0.
  bool takesStrobe() const noexcept { return established_ && config_.io.kind == IoKind::kStrobe; }
  bool strobeBit() const noexcept {
    return !isPolledBesideStrobe(config_.io) && !output_.empty() && (output_[0] & 1u) != 0;
  }
  void noteStrobed(Instant now) noexcept;
  void strobeNotSent() noexcept { takeBack(); }

  /// Whether this connection uses that message of the device.
  bool takes(Group1 message) const noexcept;
  /// Group 1 messages Dh (change of state, cyclic), Eh (strobe) or Fh (poll, or an acknowledge).
  void handle(std::uint8_t message, const CanFrame& frame, Instant now) noexcept;
  /// It was sent outputs that let it move, and none since that stop it.
  bool mustStop() const noexcept { return established_ && !overdue_ && stops_sent_ < kEnoughStops; }
  /// The device fell silent, and may hear us all the same: its outputs go on until some that stop it were sent, but not for
  /// longer than `kLongestEnding`. What it sends is not taken any more.
  void beginEnding(Instant now) noexcept;
  bool ending() const noexcept { return ending_; }
  /// False when the device is lost: `lossText()`; of one that is `ending()`: when that is over.
  bool poll(Instant now) noexcept;
  const Sentence& lossText() const noexcept { return loss_; }

  /// Our acknowledge of its change-of-state or cyclic data.
  bool acknowledgeDue() const noexcept { return acknowledge_due_; }
  bool pollAcknowledge(CanFrame& frame) noexcept;
  void acknowledgeNotSent() noexcept { acknowledge_due_ = true; }
  bool pollOutput(CanFrame& frame, Instant now) noexcept;
  bool hasBegunOutput() const noexcept { return sender_.hasBegun(); }
  /// The link did not take the last frame of `pollOutput()`: the message is dropped, as by `dropOutput()`.
  void outputNotSent() noexcept;
  /// What is not given out yet of this cycle's message is not sent any more. The next cycle sends, changed or not: the
  /// device has not got the value.
  void dropOutput() noexcept;
  std::optional<Instant> nextDeadline() const noexcept { return timers_.nextTimeout(); }

 private:
  enum class Timer : std::uint8_t {
    kInput,        ///< data, or an answer to the oldest command without one
    kAcknowledge,  ///< of the message sent last
    kHeard,        ///< of the oldest message without one; beside a bit strobe: the answer to a poll
    kEnding,       ///< the last outputs to a device that fell silent
    kCount
  };

  /// What stood before the message, or the strobe, that was given out last.
  struct Before {
    TimerTable<Timer> timers;
    std::optional<Instant> sent_at;
    bool polled = false;
    unsigned stops_sent = 0;
    std::uint64_t missed = 0;
  };

  /// One may be lost.
  static constexpr unsigned kEnoughStops = 2;
  /// Of a silent device's outputs: `drive_timeout` decides when they stop it, and a loose wire must not keep it going.
  static constexpr Duration kLongestEnding = std::chrono::seconds{1};

  bool byChange() const noexcept;
  bool outputDue(Instant now) const noexcept;
  bool pollUnanswered() const noexcept;
  void send() noexcept;
  void remember() noexcept;
  void takeBack() noexcept;
  void countSuperseded() noexcept;
  void handleData(const CanFrame& frame, Instant now) noexcept;
  void handleAcknowledge(const CanFrame& frame, Instant now) noexcept;
  void handlePollAnswer(const CanFrame& frame, Instant now) noexcept;
  void takeInput(Instant now) noexcept;

  const NodeConfig& config_;
  Duration cycle_;
  NodeReport& report_;
  bool established_ = false;
  Duration rate_{};
  Duration timeout_{};
  TimerTable<Timer> timers_;
  bool output_ready_ = false;
  IoBytes output_;
  IoBytes sent_;
  std::optional<Instant> sent_at_;
  bool polled_ = false;                 // a poll has gone out since the cycle began
  bool moves_ = false;                  // what was set last
  bool moves_sending_ = false;          // what is sent
  unsigned stops_sent_ = kEnoughStops;  // outputs that stop, since some that let it move
  bool ending_ = false;
  Before before_;
  bool due_ = false;      // whatever the rate: hurried, or the newest message has not gone out as a whole
  bool overdue_ = false;  // nothing was sent for so long that the device has given up
  bool repeated_ = false;
  IoSender sender_;
  IoReceiver receiver_;
  IoInput input_;
  bool acknowledge_due_ = false;
  Sentence loss_;
};

}  // namespace nord_driver::devicenet
