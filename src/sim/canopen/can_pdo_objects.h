// The objects 1400h-1A04h of a simulated node, with the rules by which PDOs may be changed.
//
// Changes only in pre-operational (BU 0060 p. 63), a mapping only while its PDO is switched off and its count is 0
// (CiA 301 7.5.2.36, 7.5.2.38).
#pragma once

#include "sim/canopen/can_communication.h"

namespace nord_driver::sim {

/// What the PDO objects must know of their node.
class CanPdoContext {
 public:
  virtual ~CanPdoContext() = default;
  virtual bool mayConfigure() const noexcept = 0;  ///< pre-operational
  /// Bits of an object that can be mapped; 0 when it cannot.
  virtual unsigned mappableBits(ObjectId id, bool receive) const noexcept = 0;
  /// A write broke the order switch off, count 0, entries, count, switch on.
  virtual void mappingOrderBroken() noexcept = 0;
};

class CanPdoObjects : public CanObjects {
 public:
  /// Both must outlive it. `fixed_mapping`: 1600h.. and 1A00h.. are read-only. `refusal`: what a write in the wrong
  /// state gets.
  CanPdoObjects(CanCommunication& communication, CanPdoContext& context, bool fixed_mapping, SdoAbort refusal) noexcept
      : communication_(communication), context_(context), fixed_mapping_(fixed_mapping), refusal_(refusal) {}

  /// 1400h-15FFh, 1600h-17FFh, 1800h-19FFh, 1A00h-1BFFh.
  static bool has(std::uint16_t index) noexcept { return index >= 0x1400 && index < 0x1C00; }

  SdoAbort read(ObjectId id, ObjectBytes& bytes) noexcept override;
  SdoAbort write(ObjectId id, ByteView bytes) noexcept override;

 private:
  PdoSettings* find(std::uint16_t index) noexcept;
  SdoAbort writeCommunication(PdoSettings& pdo, ObjectId id, std::uint32_t value) noexcept;
  SdoAbort writeCobId(PdoSettings& pdo, bool receive, std::uint32_t value) noexcept;
  SdoAbort writeMapping(PdoSettings& pdo, ObjectId id, std::uint32_t value) noexcept;
  SdoAbort outOfOrder() noexcept;

  CanCommunication& communication_;
  CanPdoContext& context_;
  bool fixed_mapping_;
  SdoAbort refusal_;
};

}  // namespace nord_driver::sim
