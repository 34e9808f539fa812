// Control and status words, setpoints and actual values as objects: 3000h-3003h, with P551 on 6040h-6044h.
//
// BU 0060 p. 57, 58 and 65; with a gateway sub-index n is inverter n, and the setpoints of inverter n begin at
// 3 * (n - 1) + 1 (BU 0260 p. 42).
#pragma once

#include <array>

#include "sim/canopen/can_communication.h"
#include "sim/drive_unit.h"

namespace nord_driver::sim {

class CanProcessObjects : public CanObjects {
 public:
  static constexpr std::size_t kInverters = 4;
  using Drives = std::array<DriveUnit*, kInverters>;

  /// The drives must outlive it; those that are not there are null. Of all but a gateway there is one.
  CanProcessObjects(const Drives& drives, CanConnection connection) noexcept;

  /// P551 as it is when the module starts.
  void setCia402(bool on) noexcept { cia402_ = on; }
  bool cia402() const noexcept { return cia402_; }

  bool has(std::uint16_t index) const noexcept;
  unsigned mappableBits(ObjectId id, bool receive) const noexcept;

  /// What is written counts from the next `commit()` on.
  SdoAbort read(ObjectId id, ObjectBytes& bytes) noexcept override;
  SdoAbort write(ObjectId id, ByteView bytes) noexcept override;
  struct Commit {
    bool zero = false;   ///< a control word without bit 10 followed one with it
    bool valid = false;  ///< a control word with bit 10 = 1 was among them
  };
  /// Hands what was written to the inverters.
  Commit commit() noexcept;
  /// Forgets what was written.
  void clear() noexcept;
  /// The node becomes operational: its master may look before it commands.
  void beginExchange() noexcept;

  /// A gateway's own digital inputs (3004h:1) and outputs (3005h:1).
  void setModuleInputs(std::uint8_t inputs) noexcept { module_inputs_ = inputs; }
  std::uint8_t moduleOutputs() const noexcept { return module_outputs_; }

  /// The control word written last, as on the wire.
  Word control(std::size_t inverter) const noexcept { return outputs_[inverter].control; }

 private:
  enum class Kind : std::uint8_t {
    kNone,
    kCount,
    kControl,
    kStatus,
    kSetpoint,
    kActual,
    kWideSetpoint,
    kWideActual,
    kInputs,
    kOutputs,
    kRpmSetpoint,
    kRpmBehindRamp,
    kRpmActual,
    kErrorCode,
    kRpmLimit,
    kRamp,
  };
  struct Field {
    Kind kind = Kind::kNone;
    std::size_t inverter = 0;
    unsigned n = 0;
    unsigned bits = 0;
    bool writable = false;
    bool mappable = true;
    SdoAbort refusal = SdoAbort::kNoObject;
  };
  struct Outputs {
    Word control = 0;
    std::array<Word, 3> setpoints{};
    bool written = false;
    bool valid_seen = false;
  };

  Field find(ObjectId id) const noexcept;
  Field findNord(ObjectId id) const noexcept;
  Field findCia402(ObjectId id) const noexcept;
  std::uint32_t value(const Field& field) const noexcept;
  SdoAbort writeRamp(const Field& field, std::uint32_t value) noexcept;
  std::uint32_t rampValue(const Field& field) const noexcept;

  Drives drives_;
  CanConnection connection_;
  bool cia402_ = false;
  std::array<Outputs, kInverters> outputs_{};
  std::uint8_t module_outputs_ = 0;
  std::uint8_t module_inputs_ = 0;
};

}  // namespace nord_driver::sim
