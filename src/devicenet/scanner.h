// A DeviceNet scanner for one bus. Sans-IO: frames and the time go in, frames, events and the next deadline come out. No
// thread, no clock, no socket, no memory taken after construction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/can_engine.h"
#include "core/can_frame.h"
#include "devicenet/bus_watch.h"
#include "devicenet/counters.h"
#include "devicenet/devicenet_event.h"
#include "devicenet/duplicate_mac.h"
#include "devicenet/explicit_message.h"
#include "devicenet/identifier.h"
#include "devicenet/io_connection.h"
#include "devicenet/node_handler.h"
#include "devicenet/node_status.h"
#include "devicenet/scanner_config.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

/// The answer to a `Scanner::submit()`.
struct NodeAnswer {
  std::size_t node = 0;
  ExplicitAnswer answer;
};

enum class BusState : std::uint8_t {
  kOff,                 ///< before the first `restart()`
  kCheckingMac,         ///< two seconds at least, in which nothing but the duplicate-MAC check is sent
  kOnline,              ///< devices are connected and exchange
  kCommunicationFault,  ///< another device has our MAC id: nothing is sent, then it is checked again
  kLost                 ///< `handleBusLost()`: nothing is sent until `restart()`
};

/// Devices are named by their index in the configuration, from 0.
///
/// Calling order: see `CanEngine`; `restart()` also when the controller came back from bus-off.
///
/// `pollTransmit()` gives out the duplicate-MAC check first, then acknowledges of process data, the bit strobe command
/// and process data, then explicit messages. Frames of one fragmented message come in one piece.
///
/// A device that fell silent while it was moving (`setMoves()`) is sent outputs until they stop it. None is released before
/// its own time-out has run out: it may hear us without being heard, and released it would go on with the last words it has
/// heard, and nobody to watch it.
class Scanner final : public CanEngine {
 public:
  /// Throws std::invalid_argument with a sentence: see `checkConfig()`.
  explicit Scanner(const ScannerConfig& config);

  /// The duplicate-MAC check, then every device from the beginning. Outputs are forgotten.
  void restart(Instant now) noexcept override;
  /// The controller is bus-off, or the interface is gone or down; `why` in words. Every device is lost, and nothing is
  /// sent until `restart()`: who has been off the bus checks its MAC id again.
  void handleBusLost(const Sentence& why, Instant now) noexcept;
  void releaseAll(Instant now) noexcept override;
  bool released() const noexcept override;

  void startCycle(Instant now) noexcept override;
  void handleFrame(const CanFrame& frame, Instant now) noexcept override;
  void poll(Instant now) noexcept override;
  bool pollTransmit(CanFrame& frame) noexcept override;
  void notSent() noexcept override;
  std::optional<Instant> nextDeadline() const noexcept override { return deadline_; }

  /// Kept, and sent in every cycle in which the device exchanges; before the first call, and after a loss, nothing is
  /// sent. Cut or filled with zeros to its size. Bit strobe without outputs: the lowest bit of the first byte is its bit.
  void setOutput(std::size_t node, ByteView bytes) noexcept { nodes_[node]->io().setOutput(bytes); }
  /// Of setOutput(): whether what was set lets the device move; false until said. One that falls silent while the newest that
  /// was sent does is told to be lost, and yet sent outputs until some that do not have gone out twice, for a second at most:
  /// it may hear us without being heard.
  void setMoves(std::size_t node, bool moves) noexcept { nodes_[node]->io().setMoves(moves); }
  /// Of setOutput(): what was set goes out in the next cycle, whatever the packet rate.
  void hurry(std::size_t node) noexcept { nodes_[node]->io().hurry(); }
  /// What it sent last while exchanging; `count` 0: nothing yet since it came to.
  const IoInput& input(std::size_t node) const noexcept { return nodes_[node]->io().input(); }

  /// An explicit request, behind those that wait. False when kRequestQueueLength are under way or not fetched; otherwise
  /// exactly one answer follows, at once when the device is not connected.
  bool submit(std::size_t node, const ExplicitRequest& request) noexcept;
  std::optional<NodeAnswer> pollAnswer() noexcept;

  BusState busState() const noexcept { return bus_state_; }
  /// Why nothing is sent, in a communication fault or without a bus; empty otherwise.
  const Sentence& busReason() const noexcept { return bus_reason_; }
  std::size_t nodeCount() const noexcept { return nodes_.size(); }
  const NodeStatus& status(std::size_t node) const noexcept { return nodes_[node]->status(); }
  /// Nothing is sent to it for now: its own time-out is awaited.
  bool isLeftAlone(std::size_t node) const noexcept { return nodes_[node]->isLeftAlone(); }
  std::optional<DevicenetEvent> pollEvent() noexcept { return events_.pop(); }
  const Counters& counters() const noexcept { return counters_; }
  /// The identifiers that should reach `handleFrame()`, for the filters of the interface: sorted, at most kMostIds. Those
  /// that only tell of others are left out first.
  std::vector<std::uint32_t> receivedIds() const;

  /// What a CAN_RAW socket can filter.
  static constexpr std::size_t kMostIds = 512;

 private:
  /// What `pollTransmit()` gave out last, for `notSent()`.
  struct Given {
    enum class Kind : std::uint8_t { kNothing, kDuplicateMac, kAcknowledge, kStrobe, kOutput, kExplicit };
    Kind kind = Kind::kNothing;
    std::size_t node = 0;
    bool continues = false;  // of an output: a part of the same message was given before
    CanFrame frame;
  };

  NodeHandler* nodeOf(std::uint8_t mac) noexcept;
  void handleGroup2(const Identifier& id, const CanFrame& frame, Instant now) noexcept;
  void handleDuplicateMac(std::uint8_t mac, const CanFrame& frame, Instant now) noexcept;
  void enterBusState(BusState state, const Sentence& reason) noexcept;
  /// The duplicate-MAC check may have ended, well or not.
  void followCheck(Instant now) noexcept;
  void stopNodes(const Sentence& why, Instant now) noexcept;
  /// A device was worked on: it may have something to send, and an earlier deadline.
  void touched(const NodeHandler& node) noexcept;
  bool give(Given::Kind kind, std::size_t node) noexcept;
  bool pollDuplicateMac() noexcept;
  bool pollAcknowledge() noexcept;
  bool pollStrobe() noexcept;
  bool pollOutput() noexcept;
  bool pollExplicit() noexcept;
  void dropStrobe() noexcept;

  ScannerConfig config_;
  Counters counters_;
  DevicenetEvents events_;
  BusWatch watch_;
  DuplicateMacCheck check_;
  std::vector<std::unique_ptr<NodeHandler>> nodes_;
  std::array<std::size_t, kMacIds> node_of_mac_;
  BusState bus_state_ = BusState::kOff;
  Sentence bus_reason_;
  Given given_;
  Instant now_{};
  std::optional<Instant> deadline_;  // not later than the earliest of all
  std::size_t next_output_ = 0;
  std::optional<std::size_t> first_output_;  // whose message is the first of this cycle
  std::size_t next_explicit_ = 0;
  std::size_t next_answer_ = 0;
  bool strobe_due_ = false;
  bool output_refused_ = false;  // by the link, in this cycle
  // False: nobody has anything of that kind to send. True: somebody may.
  bool acknowledge_maybe_ = false;
  bool output_maybe_ = false;
  bool explicit_maybe_ = false;
};

}  // namespace nord_driver::devicenet
