// What lies where in the process data of a module: BU 0280 4.2.2 and 4.2.5.
//
// The byte of the module, then inverters 1 to 4; what is not there closes up.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/inverter/parameter_store.h"

namespace nord_driver::sim {

/// P162 to P165, element 3.
enum class DnProfile : std::uint8_t { kAcDrive = 0, kAcDriveExtended = 1, kNord = 2 };

struct DnArea {
  std::uint8_t status_length = 0;   ///< bytes, 0-8
  std::uint8_t control_length = 0;  ///< bytes, 0-8
  DnProfile profile = DnProfile::kNord;
};

struct DnLayout {
  static constexpr std::size_t kInverters = 4;

  unsigned instance = 100;  ///< of the outputs
  bool input_byte = false;
  bool output_byte = false;
  std::array<DnArea, kInverters> areas{};

  std::size_t inputs() const noexcept;   ///< bytes to the master
  std::size_t outputs() const noexcept;  ///< bytes from the master

  /// 20, 21, 100, 101, 102; 120 by P161 to P165 of `module`. Of any other number: no data.
  static DnLayout ofInstance(unsigned instance, const ParameterStore& module) noexcept;
};

/// P160: the instance of the outputs.
unsigned dnInstanceOfSelection(std::int32_t p160) noexcept;
/// The other way round; -1 for none.
int dnSelectionOfInstance(unsigned instance) noexcept;
/// 70, 71, 110, 111, 112, 130.
unsigned dnInputInstanceOf(unsigned output_instance) noexcept;

}  // namespace nord_driver::sim
