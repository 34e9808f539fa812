// A CANopen master for one bus. Sans-IO: frames and the time go in, frames, events and the next deadline come out. No
// thread, no clock, no socket, no memory taken after construction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "canopen/bus_watch.h"
#include "canopen/canopen_event.h"
#include "canopen/cob_id_table.h"
#include "canopen/counters.h"
#include "canopen/master_config.h"
#include "canopen/node.h"
#include "canopen/node_status.h"
#include "canopen/pdo_value.h"
#include "canopen/process_queue.h"
#include "canopen/sdo_request.h"
#include "core/can_engine.h"
#include "core/can_frame.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

/// The answer to a `Master::submitSdo()`. `answer.data` is valid until the next call that is not const.
struct NodeSdoAnswer {
  std::size_t node = 0;
  std::size_t server = 0;
  SdoAnswer answer;
};

/// Nodes, PDOs and SDO servers are named by their index in the configuration, from 0.
///
/// Calling order: see `CanEngine`.
///
/// `startCycle()` makes due the newest value of every enabled RPDO of every operational node, and behind them SYNC,
/// when it is used and a node is operational: an RPDO of type 0..240 acts with the SYNC of the same cycle, where all found
/// a place, one of type 254 or 255 at once. `pollTransmit()` gives out NMT first, then RPDOs and SYNC, error control, SDO.
///
/// What the link did not take: NMT, error control and SDO frames are given out again, RPDOs and SYNC dropped. Where these
/// found no place nothing else is given out until the next cycle, which begins with what was the first of them to be
/// dropped, be it SYNC: error control alone would keep a node running that hears no process data, and without SYNC no
/// RPDO that waits for it would ever act.
class Master final : public CanEngine {
 public:
  /// Throws std::invalid_argument with a sentence: see `checkConfig()`.
  explicit Master(const MasterConfig& config);

  /// Every node from the beginning. RPDO values are forgotten; SDO accesses end without answer.
  void restart(Instant now) noexcept override;
  /// NodeConfig::only_asked of all nodes. Before the first frame.
  void setOnlyAsked(Duration span) noexcept {
    for (NodeConfig& node : config_.nodes) node.only_asked = span;
  }
  /// A node that may be reset (`NodeConfig::reset`) gets "reset communication"; another one is first told by
  /// SDO not to watch us any more, then "enter pre-operational". Until `released()`, in a second at most, everything
  /// else goes on as usual: polling, frames, error control.
  void releaseAll(Instant now) noexcept override;
  bool released() const noexcept override;

  /// While nothing may be sent yet, in place of `handleFrame()`: whether only a master that works with our nodes sends
  /// such a frame (NMT, guarding, RPDOs, SDO requests, our SYNC), or a node answers to one. Counted and told.
  bool noteOtherMaster(const CanFrame& frame, Instant now) noexcept;
  /// What was heard while nothing may be sent, see there, and from the TPDOs of a node that `stops_first`: one that is
  /// driven gets, after `restart()`, nothing but the RPDOs of `tellUnheard()` (and SYNC) until it rests.
  void setMotion(std::size_t node, FoundMotion motion) noexcept { nodes_[node]->handleMotion(motion); }
  void startCycle(Instant now) noexcept override;
  void handleFrame(const CanFrame& frame, Instant now) noexcept override;
  void poll(Instant now) noexcept override;
  bool pollTransmit(CanFrame& frame) noexcept override;
  void notSent() noexcept override;
  std::optional<Instant> nextDeadline() const noexcept override;

  /// Kept, and sent in every cycle in which the node is operational; before the first call, and after a loss, nothing
  /// is sent. Cut or filled with zeros to the mapped length (when the mapping is configured).
  void setReceivePdo(std::size_t node, std::size_t pdo, ByteView bytes) noexcept;
  /// Its value stops a drive: in the next cycle it is sent even if the node has fallen silent, as it may hear it, in turn with what the
  /// others are sent. Until the link has taken it for some cycles the node is neither asked nor reset.
  void tellUnheard(std::size_t node, std::size_t pdo) noexcept { nodes_[node]->receivePdos()[pdo].tellUnheard(); }
  /// What it sent last while operational; `count` 0: nothing yet since it became so. Before it was begun with: what was
  /// heard of it.
  const PdoValue& transmitPdo(std::size_t node, std::size_t pdo) const noexcept;

  /// An access beside the start-up, in whatever state the node is. False when this server has one under way or an
  /// answer not fetched; otherwise one answer follows, unless `restart()` comes first.
  bool submitSdo(std::size_t node, std::size_t server, const SdoRequest& request) noexcept;
  std::optional<NodeSdoAnswer> pollSdo() noexcept;

  std::size_t nodeCount() const noexcept { return nodes_.size(); }
  const NodeStatus& status(std::size_t node) const noexcept { return nodes_[node]->status(); }
  std::optional<CanopenEvent> pollEvent() noexcept { return events_.pop(); }
  const Counters& counters() const noexcept { return counters_; }
  /// The identifiers that must reach `handleFrame()`: those of our nodes, boot-up and heartbeat of every other node,
  /// and those only a master sends. For the filters of the interface; sorted.
  std::vector<std::uint32_t> receivedIds() const { return receivedIdsOf(uses_); }
  /// The same of remote frames: another master's guarding of our nodes. The link does not give our own questions
  /// back.
  std::vector<std::uint32_t> receivedRemoteIds() const { return receivedRemoteIdsOf(uses_); }

 private:
  /// What `pollTransmit()` gave out last, for `notSent()`.
  struct Given {
    enum class Kind : std::uint8_t { kNothing, kNmt, kReceivePdo, kSync, kOwnHeartbeat, kGuard, kSdo };
    Kind kind = Kind::kNothing;
    std::size_t node = 0;
    std::size_t item = 0;
    bool unheard = false;  // of an RPDO: for a node that fell silent
    CanFrame frame;
  };

  void dispatch(const CobIdUse& use, const CanFrame& frame, Instant now) noexcept;
  void handleNmt(const CanFrame& frame, Instant now) noexcept;
  bool isOfOtherMaster(const CobIdUse& use, const CanFrame& frame) const noexcept;
  void handleRemote(const CobIdUse& use, const CanFrame& frame, Instant now) noexcept;
  /// A node was worked on: it may have something to send, and an earlier deadline.
  void touched(const Node& node) noexcept;
  void expect(std::optional<Instant> deadline) noexcept;
  bool pollNmt() noexcept;
  bool pollProcessData() noexcept;
  bool giveSync() noexcept;
  bool giveReceivePdo(ProcessFrame pdo) noexcept;
  bool pollErrorControl() noexcept;
  bool pollSdoFrame() noexcept;
  void give(Given::Kind kind, std::size_t node, std::size_t item, const CanFrame& frame) noexcept;
  void addLastWords() noexcept;
  void dropProcessData() noexcept;
  void drop(ProcessFrame frame) noexcept;

  MasterConfig config_;
  Counters counters_;
  CanopenEvents events_;
  std::vector<CobIdUse> uses_;
  std::vector<std::unique_ptr<Node>> nodes_;
  BusWatch watch_;
  ProcessQueue process_;
  std::vector<std::pair<std::size_t, std::size_t>> servers_;  // node, server: for the turns of SDO
  std::size_t next_server_ = 0;
  Given given_;
  Instant now_{};
  std::optional<Instant> deadline_;  // not later than the earliest of all
  std::optional<Instant> next_heartbeat_;
  bool stuck_ = false;                 // process data of this cycle found no place
  std::optional<ProcessFrame> waits_;  // the first of them
  bool boot_up_due_ = false;           // ours
  bool heartbeat_due_ = false;
  // False: nobody has anything of that kind to send. True: somebody may.
  bool nmt_maybe_ = false;
  bool error_control_maybe_ = false;
  bool sdo_maybe_ = false;
};

}  // namespace nord_driver::canopen
