// The parameters of one inverter as objects 2000h + P (BU 0060 p. 61).
//
// Sub-index: 0 for a plain parameter, 4 * (n - 1) + set for element n of a set-dependent one. The manual contradicts
// itself on arrays without sets (p. 61 against p. 54): n, or by the table 4 * (n - 1) + 1; `array_sub_by_table`.
#pragma once

#include "sim/canopen/can_object.h"
#include "sim/drive_unit.h"

namespace nord_driver::sim {

class CanParameterObjects : public CanObjects {
 public:
  /// Both must outlive it; `drive` (its power, its link, the experimenter's switches) may be null.
  CanParameterObjects(ParameterStore& parameters, const DriveUnit* drive, bool array_sub_by_table) noexcept
      : parameters_(parameters), drive_(drive), array_sub_by_table_(array_sub_by_table) {}

  static bool has(std::uint16_t index) noexcept { return index >= 0x2000 && index < 0x2000 + 1000; }

  SdoAbort read(ObjectId id, ObjectBytes& bytes) noexcept override;
  SdoAbort write(ObjectId id, ByteView bytes) noexcept override;

 private:
  struct Place {
    SdoAbort refusal = SdoAbort::kNone;
    const ParameterDefinition* definition = nullptr;
    unsigned set = 0;
    unsigned element = 0;
    bool is_count = false;  ///< sub-index 0 of an array
  };
  Place find(ObjectId id) const noexcept;
  SdoAbort absence(unsigned number) const noexcept;

  ParameterStore& parameters_;
  const DriveUnit* drive_;
  bool array_sub_by_table_;
};

}  // namespace nord_driver::sim
