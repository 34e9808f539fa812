// A simulated DeviceNet module with its inverters: duplicate-MAC check, allocation, explicit messages, process data,
// time-outs.
//
// Written from BU 0280 4 to 7; where it says nothing, from the predefined master/slave connection set. Fed with frames
// and time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "nord_driver/core/time.h"
#include "sim/bus_module.h"
#include "sim/can/can_participants.h"
#include "sim/devicenet/dn_config.h"
#include "sim/devicenet/dn_connections.h"
#include "sim/devicenet/dn_drive_objects.h"
#include "sim/devicenet/dn_explicit.h"
#include "sim/devicenet/dn_parameter_objects.h"
#include "sim/devicenet/dn_process.h"
#include "sim/devicenet/dn_referee.h"

namespace nord_driver::sim {

/// What an observer wants to know of a module.
struct DnModuleCounters {
  std::uint64_t allocations = 0;
  std::uint64_t explicit_requests = 0;
  std::uint64_t polls = 0;  ///< executed messages of process data
  std::uint64_t strobes = 0;
  std::uint64_t productions = 0;  ///< change of state and cyclic, without those sent again
  std::uint64_t timeouts = 0;     ///< I/O connections that were over
  std::uint64_t zero_control_words = 0;
};

class DnModule final : public BusModule, private DnObjects {
 public:
  enum class Phase : std::uint8_t { kOff, kStarting, kChecking, kOnline, kCommunicationFault };

  /// `referee` must outlive it.
  DnModule(const DnModuleSettings& settings, DnReferee& referee);

  /// A frame of somebody else; `judged`: it is the scanner's.
  void receive(const CanFrame& frame, bool judged, CanSink& sink) noexcept;
  void advance(Duration span, CanSink& sink) noexcept;
  /// It was kept from running: for a while its master may look before it commands, as after a start.
  void stoodStill() noexcept;

  Supply supply() const noexcept override;
  void setPowered(bool on) noexcept override;
  bool powered() const noexcept override { return supply_; }
  bool inDataExchange() const noexcept override { return connections_.anyIoEstablished(); }
  ExchangeCounters countersOf(unsigned place) const noexcept override;

  std::uint8_t mac() const noexcept { return settings_.mac; }
  bool alive() const noexcept { return phase_ != Phase::kOff; }
  Phase phase() const noexcept { return phase_; }
  const DnConnections& connections() const noexcept { return connections_; }
  const DnModuleCounters& counters() const noexcept { return counters_; }
  ParameterStore& parameters() noexcept { return parameters_; }
  DnIdentity& identity() noexcept { return settings_.identity; }
  /// As the connection that runs has it, else as the next one would.
  DnLayout layout() const noexcept;
  bool setInputs(std::uint8_t inputs) noexcept override {
    process_.setInputs(inputs);
    return true;
  }
  /// DO1 and DO2 in bits 0 and 1: by the bus, by P150, 0 in a time-out.
  std::uint8_t outputs() const noexcept override;
  /// Allocations are answered with this error instead of being made; nullopt ends it.
  void refuseAllocation(const std::optional<DnAllocation>& refusal) noexcept { refused_allocation_ = refusal; }
  /// In the time-out: until the cause is gone and every inverter there is acknowledged.
  bool timedOut() const noexcept { return timed_out_; }

 private:
  struct Outgoing {
    CanFrame frame;
    Duration remaining{0};
  };
  /// Process data the module sends by itself.
  struct Production {
    DnProcessBytes last;
    bool sent = false;
    Duration since{0};
    bool waits = false;  ///< for the acknowledge
    Duration waited{0};
    unsigned retries = 0;
  };

  // DnObjects: classes 1, 3, 4, 5 and 43, in dn_module_objects.cpp.
  bool hasClass(std::uint8_t class_id) const noexcept override;
  CipStatus get(const CipAddress& at, CipBytes& value) noexcept override;
  CipStatus set(const CipAddress& at, ByteView value, CipBytes& answer) noexcept override;
  CipStatus getIdentity(std::uint8_t attribute, CipBytes& value) noexcept;
  CipStatus getDeviceNet(std::uint8_t attribute, CipBytes& value) noexcept;
  CipStatus getConnection(DnConnectionKind kind, std::uint8_t attribute, CipBytes& value) noexcept;
  CipStatus setConnection(DnConnectionKind kind, std::uint8_t attribute, ByteView value, CipBytes& answer) noexcept;
  std::uint8_t bitRateCode() const noexcept;

  void connected(unsigned place) noexcept override;
  bool hasSupply() const noexcept;
  bool isGateway() const noexcept { return settings_.kind == DnModuleKind::kGateway; }
  void switchOn() noexcept;
  void switchOff() noexcept;
  void check(Duration span, CanSink& sink) noexcept;
  void duplicateMac(const CanFrame& frame, CanSink& sink) noexcept;
  void communicationFault() noexcept;

  void unconnected(const CanFrame& frame, CanSink& sink) noexcept;
  void explicitFrame(const CanFrame& frame, CanSink& sink) noexcept;
  CipBytes execute(const CipBytes& request) noexcept;
  DnObjects* objectsOf(std::uint8_t class_id) noexcept;
  Duration timeFor(const CipBytes& request) noexcept;
  void advanceExplicit(Duration span, CanSink& sink) noexcept;

  void poll(const CanFrame& frame, bool judged, CanSink& sink) noexcept;
  void strobe(const CanFrame& frame, bool judged, CanSink& sink) noexcept;
  void take(ByteView outputs, bool judged) noexcept;
  void produce(Duration span, CanSink& sink) noexcept;
  void sendInputs(unsigned message, CanSink& sink) noexcept;
  void sendMessage(unsigned message, ByteView data, CanSink& sink) noexcept;
  void send(std::uint32_t id, ByteView data, CanSink& sink) noexcept;

  void watch(Duration span) noexcept;
  void masterLost() noexcept;
  void timeOut(std::int32_t error) noexcept;
  void endTimeOut() noexcept;
  void showStatus() noexcept;
  std::int32_t moduleStatus() const noexcept;

  DnModuleSettings settings_;
  DnReferee& referee_;
  ParameterStore parameters_;
  DnProcess process_;
  DnDriveObjects drive_objects_;
  DnParameterObjects parameter_objects_;
  DnConnections connections_;
  std::optional<DnAllocation> refused_allocation_;
  DnLayout running_layout_;

  bool supply_ = true;
  Phase phase_ = Phase::kOff;
  Duration in_phase_{0};
  unsigned checks_ = 0;
  std::uint8_t bus_off_counter_ = 0;
  std::uint16_t acknowledge_time_ = 16;  // ms, class 43
  std::uint8_t retry_limit_ = 1;

  DnExplicitReceiver explicit_in_;
  DnExplicitSender explicit_out_;
  std::optional<DnRequest> request_;  // being executed
  Duration remaining_{0};
  DnIoReceiver io_in_;
  Production production_;
  FixedVector<Outgoing, 64> outgoing_;

  Duration master_may_look_{0};
  bool valid_data_seen_ = false;  // P151 watches from the first valid control word on
  Duration since_valid_{0};
  bool cause_stands_ = false;
  bool timed_out_ = false;
  std::int32_t error_ = 0;  // what P170[-01] shows
  std::array<bool, kPlaces> seen_{};
  std::array<ExchangeCounters, kPlaces> exchanged_{};
  DnModuleCounters counters_;
};

}  // namespace nord_driver::sim
