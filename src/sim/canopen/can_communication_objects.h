// The objects 1000h-1203h of a simulated node.
#pragma once

#include "sim/canopen/can_communication.h"
#include "sim/canopen/can_emergency.h"

namespace nord_driver::sim {

class CanCommunicationObjects : public CanObjects {
 public:
  /// All must outlive it. `stores`: 1010h and 1011h are there (BU 0260 p. 50).
  CanCommunicationObjects(CanCommunication& communication, CanEmergencyState& emergency, CanIdentity& identity,
                          CanConnection connection) noexcept
      : communication_(communication), emergency_(emergency), identity_(identity), connection_(connection) {}

  void setDeviceType(std::uint32_t type) noexcept { device_type_ = type; }
  void setPreOperational(bool yes) noexcept { pre_operational_ = yes; }

  /// What was saved by 1010h, and what counts from the next reset on.
  void useFactorySettings(const CanCommunication& factory) noexcept { factory_ = saved_ = factory; }
  const CanCommunication& saved() const noexcept { return saved_; }

  SdoAbort read(ObjectId id, ObjectBytes& bytes) noexcept override;
  SdoAbort write(ObjectId id, ByteView bytes) noexcept override;

 private:
  bool stores() const noexcept { return connection_ == CanConnection::kGateway; }
  SdoAbort readNumber(ObjectId id, std::uint32_t& value, std::size_t& length) const noexcept;
  SdoAbort writeServer(ObjectId id, std::uint32_t value) noexcept;
  SdoAbort writeConsumer(ObjectId id, std::uint32_t value) noexcept;

  CanCommunication& communication_;
  CanEmergencyState& emergency_;
  CanIdentity& identity_;
  CanConnection connection_;
  CanCommunication factory_;
  CanCommunication saved_;
  std::uint32_t device_type_ = 0;
  bool pre_operational_ = true;
};

}  // namespace nord_driver::sim
