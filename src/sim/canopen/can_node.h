// A simulated CANopen node with its inverters: network management, error control, SDO servers, PDOs, emergencies.
//
// Written from BU 0060 and BU 0260 and, where these say nothing, from CiA 301. Fed with frames and time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "nord_driver/core/time.h"
#include "sim/bus_module.h"
#include "sim/can/can_participants.h"
#include "sim/canopen/can_communication_objects.h"
#include "sim/canopen/can_config.h"
#include "sim/canopen/can_gateway_module.h"
#include "sim/canopen/can_parameter_objects.h"
#include "sim/canopen/can_pdo_objects.h"
#include "sim/canopen/can_process_objects.h"
#include "sim/canopen/can_referee.h"
#include "sim/canopen/can_sdo_server.h"
#include "sim/canopen/can_tpdo.h"

namespace nord_driver::sim {

struct CanNodeSettings {
  std::uint8_t node = 32;
  CanDriveConfig can;
  bool swap_words_2_3 = false;  ///< SK 300E/7x0E: SW3 before SW2 (BU 0060 p. 59)
  /// Times of the simulator's choice; BU 0060 p. 50 gives 5-10 ms for a parameter over the older CAN protocol.
  Duration parameter_time = std::chrono::milliseconds{5};
  Duration object_time = std::chrono::milliseconds{1};
  Duration start_time = std::chrono::milliseconds{100};  ///< from power on to the boot-up message
  Duration reset_time = std::chrono::milliseconds{20};
};

/// What an observer wants to know of a node.
struct CanNodeCounters {
  std::uint64_t boot_ups = 0;
  std::uint64_t rpdos = 0;  ///< executed ones
  std::uint64_t tpdos = 0;
  std::uint64_t sdo_requests = 0;
  std::uint64_t emergencies = 0;
  std::uint64_t masters_lost = 0;        ///< life guarding or heartbeat consumer expired
  std::uint64_t zero_control_words = 0;  ///< bit 10 = 0 after valid process data
};

class CanNode final : public BusModule, private CanPdoContext {
 public:
  using Drives = CanProcessObjects::Drives;

  /// The drives and `referee` must outlive the node. One drive at place 0, of a gateway up to four (null = none).
  /// They are to be connected to it.
  CanNode(const CanNodeSettings& settings, const Drives& drives, CanReferee& referee);

  /// A frame of somebody else; `judged`: the referee sees it.
  void receive(const CanFrame& frame, bool judged, CanSink& sink) noexcept;
  void advance(Duration span, CanSink& sink) noexcept;

  /// It was kept from running: for a while its master may look before it commands, as after a start.
  void stoodStill() noexcept;

  enum class Claim : std::uint8_t { kNone, kReceives, kSends };
  /// Whether this node listens to an identifier, or sends with it.
  Claim claim(std::uint32_t id) const noexcept;

  Supply supply() const noexcept override;
  /// Of a gateway. It also goes off when all of its inverters are unplugged.
  void setPowered(bool on) noexcept override;
  bool powered() const noexcept override { return supply_; }
  bool inDataExchange() const noexcept override { return state_ == NmtState::kOperational; }
  ExchangeCounters countersOf(unsigned place) const noexcept override;

  void setIdentity(const CanIdentity& identity) noexcept { identity_ = identity; }
  const CanIdentity& identity() const noexcept { return identity_; }
  /// Of a gateway.
  void setModuleInputs(std::uint8_t inputs) noexcept { process_.setModuleInputs(inputs); }
  std::uint8_t moduleOutputs() const noexcept { return process_.moduleOutputs(); }

  std::uint8_t id() const noexcept { return settings_.node; }
  const CanNodeSettings& settings() const noexcept { return settings_; }
  bool alive() const noexcept { return alive_; }
  NmtState state() const noexcept { return state_; }
  const CanCommunication& communication() const noexcept { return communication_; }
  const CanNodeCounters& counters() const noexcept { return counters_; }
  const CanEmergencyState& emergencies() const noexcept { return emergency_; }
  const Drives& drives() const noexcept { return drives_; }
  /// Of a gateway; null otherwise.
  CanGatewayModule* module() noexcept { return module_ ? &*module_ : nullptr; }
  /// As on the wire, of the inverter at that place.
  Word lastControl(std::size_t inverter) const noexcept { return process_.control(inverter); }

 private:
  /// The dictionary as the SDO server of one inverter sees it.
  class Server : public CanObjects {
   public:
    void bind(CanNode& node, std::size_t inverter) noexcept;
    SdoAbort read(ObjectId id, ObjectBytes& bytes) noexcept override;
    SdoAbort write(ObjectId id, ByteView bytes) noexcept override;

    CanSdoServer protocol;
    std::optional<CanFrame> answer;  ///< on its way
    Duration remaining{0};

   private:
    CanObjects* part(std::uint16_t index) noexcept;

    CanNode* node_ = nullptr;
    std::size_t inverter_ = 0;
    std::optional<CanParameterObjects> parameters_;
  };

  bool mayConfigure() const noexcept override { return state_ == NmtState::kPreOperational; }
  unsigned mappableBits(ObjectId id, bool receive) const noexcept override;
  void mappingOrderBroken() noexcept override;

  bool hasSupply() const noexcept;
  void initialise(Duration time, bool application) noexcept;
  void bootUp(CanSink& sink) noexcept;
  void enter(NmtState state) noexcept;
  void manage(const CanFrame& frame) noexcept;
  void synchronise(CanSink& sink) noexcept;
  void answerSdo(Server& server, const SdoCobIds& ids, const CanFrame& frame, bool judged) noexcept;
  void takePdo(const PdoSettings& pdo, const CanFrame& frame, bool judged) noexcept;
  void apply(const PdoSettings& pdo, ByteView data) noexcept;
  void commit() noexcept;
  void answerGuard(const CanFrame& frame, bool judged, CanSink& sink) noexcept;
  void consumeHeartbeat(const CanFrame& frame) noexcept;
  void watchMaster(Duration span) noexcept;
  void masterLost() noexcept;
  void advanceServers(Duration span, CanSink& sink) noexcept;
  void sendHeartbeat(Duration span, CanSink& sink) noexcept;
  void sendPdos(Duration span, CanSink& sink) noexcept;
  void sendPdo(std::size_t number, CanSink& sink) noexcept;
  void watchFaults(CanSink& sink) noexcept;
  void showStatus() noexcept;
  PdoData valuesOf(const PdoSettings& pdo) noexcept;
  void send(std::uint32_t id, ByteView data, CanSink& sink) noexcept;
  std::uint8_t guardByte() noexcept;

  CanNodeSettings settings_;
  Drives drives_;
  CanReferee& referee_;

  CanIdentity identity_;
  CanCommunication communication_;
  CanEmergencyState emergency_;
  CanCommunicationObjects communication_objects_;
  CanPdoObjects pdo_objects_;
  CanProcessObjects process_;
  std::optional<CanGatewayModule> module_;
  std::array<Server, CanCommunication::kServers> servers_;
  std::array<CanTpdo, CanCommunication::kPdos> tpdos_;
  std::array<std::optional<PdoData>, CanCommunication::kPdos> waiting_for_sync_;

  std::optional<bool> factory_for_cia402_;
  bool supply_ = true;
  bool alive_ = false;
  NmtState state_ = NmtState::kInitialising;
  Duration starting_{0};
  Duration master_may_look_{0};
  bool judged_ = false;  // the request being executed is the master's

  bool toggle_ = false;
  bool guarded_ = false;
  Duration since_guard_{0};
  Duration since_heartbeat_{0};
  struct Consumer {
    bool heard = false;
    Duration since{0};
  };
  std::array<Consumer, CanCommunication::kConsumers> consumers_{};
  Duration since_sample_{0};
  std::array<std::uint16_t, CanProcessObjects::kInverters> told_faults_{};
  std::array<ExchangeCounters, CanProcessObjects::kInverters> exchanged_{};
  CanNodeCounters counters_;
};

}  // namespace nord_driver::sim
