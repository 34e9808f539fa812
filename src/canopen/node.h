// One node of the bus: its start-up, error control, PDOs, SDO servers and emergencies put together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "canopen/heartbeat_pace.h"
#include "canopen/node_boot.h"
#include "canopen/node_config.h"
#include "canopen/node_guard.h"
#include "canopen/node_report.h"
#include "canopen/node_timers.h"
#include "canopen/pdo_value.h"
#include "canopen/receive_pdo_slot.h"
#include "canopen/sdo_port.h"
#include "core/can_frame.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

/// Never moves: its parts refer to each other.
class Node {
 public:
  /// `config` is complete, see `completed()`; it and the other references live longer than this.
  Node(std::size_t index, const NodeConfig& config, std::uint8_t own_id, Duration ask_interval, Counters& counters,
       CanopenEvents& events);
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  void restart(Instant now) noexcept;
  void release(Instant now) noexcept;
  bool released() const noexcept { return boot_.released(); }

  void handleErrorControl(const CanFrame& frame, Instant now) noexcept;
  void handleEmergency(const CanFrame& frame, Instant now) noexcept;
  void handleTransmitPdo(std::size_t pdo, const CanFrame& frame, Instant now) noexcept;
  /// It has come before the node was begun with.
  void keepTransmitPdo(std::size_t pdo, const CanFrame& frame, Instant now) noexcept;
  void handleMotion(FoundMotion motion) noexcept { boot_.handleMotion(motion); }
  void handleSdo(std::size_t server, const CanFrame& frame, Instant now) noexcept;
  void handleForeignCommand(NmtCommand command, Instant now) noexcept;
  /// Another master commanded this node by an RPDO, or asked it by SDO.
  void handleForeignPdo(Instant now) noexcept;
  void handleForeignRequest() noexcept {
    boot_.handleForeignRequest();
    pace_.giveUp();
  }
  void poll(Instant now) noexcept;
  std::optional<Instant> nextDeadline() const noexcept;

  std::uint8_t id() const noexcept { return config_.id; }
  void handleCycle() noexcept { boot_.handleCycle(); }
  void handleUntold() noexcept { boot_.handleUntold(); }
  bool operational() const noexcept { return boot_.watch() == NodeBoot::Watch::kWatch; }
  /// Once a cycle while operational: whether it gets its RPDOs in this one. After its start not before the cycle that
  /// follows the first TPDOs, or `NodeConfig::first_answer_timeout`.
  bool takesReceivePdos(Instant now) noexcept;
  std::optional<NmtCommand>& command() noexcept { return boot_.command(); }
  NodeGuard& guard() noexcept { return guard_; }
  std::vector<SdoPort>& ports() noexcept { return ports_; }
  std::vector<ReceivePdoSlot>& receivePdos() noexcept { return receive_pdos_; }
  const PdoValue& transmitPdo(std::size_t pdo) const noexcept { return transmit_pdos_[pdo].value; }
  NodeReport& report() noexcept { return report_; }
  const NodeStatus& status() const noexcept { return report_.status(); }

 private:
  struct TransmitPdo {
    std::size_t length = 0;  // 0: any
    bool enabled = true;
    PdoValue value;
  };

  void handleStateByte(std::uint8_t value, Instant now) noexcept;
  bool acceptGuardAnswer(std::uint8_t value, Instant now) noexcept;
  void settle(Instant now) noexcept;
  void followWatch(Instant now) noexcept;
  void tellLoss(Instant now) noexcept;

  const NodeConfig& config_;
  NodeReport report_;
  std::vector<SdoPort> ports_;
  std::vector<ReceivePdoSlot> receive_pdos_;
  std::vector<TransmitPdo> transmit_pdos_;
  NodeTimers timers_;
  NodeBoot boot_;
  NodeGuard guard_;
  HeartbeatPace pace_;
  NodeBoot::Watch watch_ = NodeBoot::Watch::kOff;
  bool answered_ = false;  // its first TPDOs had come when a cycle began
  bool told_toggle_ = false;
  CanFrame last_answer_;  // of the first SDO server
};

}  // namespace nord_driver::canopen
