// The single bits a drive that positions is asked by, and says by: reference run, teach-in, reset position, "referenced".
//
// A bit goes to the drive as bus I/O in bit, as bit 8 or 9 of the control word (P480 says what it does), or in the
// POSICON control bits of SK 700E and 750E (BU 0020 7.3.5). Which number of P480 is which of them stands in the
// manuals of the inverters (P420), not at hand: it is a choice of the configuration.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cycle/device_data.h"
#include "cycle/signal_setup.h"
#include "cycle/word_needs.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/profile/process_data.h"
#include "nord_driver/profile/series.h"
#include "profile/position_scale.h"

namespace nord_driver::cycle {

class PositionBits {
 public:
  /// `setup`: none: a drive that follows velocities. `carried`: setpoints and actual values.
  PositionBits(const std::optional<PositionSetup>& setup, profile::Series series, std::size_t carried);

  /// Why a reference run cannot be asked for now, with the parameter and the value to set; empty: it can. `set`: of the
  /// parameters, 1..4.
  Sentence homeRefusal(const char* drive, const DeviceData& device, std::uint8_t set) const noexcept;
  /// The bit that asks for the reference run into what goes to the drive, with its own words.
  void putHome(profile::ProcessOutput& output, const DeviceData& device, std::uint8_t set) const noexcept;
  /// The same of teaching its position.
  Sentence teachRefusal(const char* drive, const DeviceData& device, std::uint8_t set) const noexcept;
  /// The bits that are high while it is taught.
  void putTeach(const drive::TeachBits& bits, profile::ProcessOutput& output, const DeviceData& device,
                std::uint8_t set) const noexcept;
  /// The same of setting its count anew.
  Sentence resetRefusal(const char* drive, const DeviceData& device, std::uint8_t set) const noexcept;
  void putReset(profile::ProcessOutput& output, const DeviceData& device, std::uint8_t set) const noexcept;
  /// Why an element of the array cannot be a target; empty: it can.
  Sentence elementRefusal(const char* drive, std::uint8_t element, const DeviceData& device,
                          std::uint8_t set) const noexcept;
  /// The bits that choose it, of a drive that is told its element. 0: none are high.
  void putElement(std::uint8_t element, profile::ProcessOutput& output, const DeviceData& device,
                  std::uint8_t set) const noexcept;
  /// Of the joint, rad or m, where an element of P613 has `raw`.
  double inJoint(std::int32_t raw) const noexcept;
  /// A position of the joint as P613 has it, 0.001 revolutions; 0 of one that does not position, or beyond all range.
  std::int32_t inArray(double joint) const noexcept;
  /// What the drive says of its reference; none where no bit is configured, it shows something else (P481), or nobody knows
  /// which word carries it.
  std::optional<bool> referenced(const profile::ProcessInput& input, const DeviceData& device,
                                 std::uint8_t set) const noexcept;

 private:
  bool showsReference(const DeviceData& device) const noexcept {
    return referenced_element_ == 0 || device.out_bit_function == referenced_function_;
  }
  /// What a bit is called where it is refused.
  struct Meaning {
    const char* key;
    const char* function_key;
    const char* name;
  };
  /// `bit` can be sent, and does what it is taken for.
  Sentence bitRefusal(const char* drive, const PositionBit& bit, const Meaning& meaning, const DeviceData& device,
                      std::uint8_t set) const noexcept;
  /// The bits of the array that are high for `element`.
  Sentence arrayRefusal(const char* drive, const PositionBit& array, std::uint8_t element, const DeviceData& device,
                        std::uint8_t set) const noexcept;
  /// `value`: from this bit on; `posicon`: in the place of it in the POSICON control bits.
  void put(const PositionBit& bit, unsigned value, unsigned posicon, profile::ProcessOutput& output,
           const DeviceData& device, std::uint8_t set) const noexcept;
  std::optional<std::size_t> placeOf(const WordNeed& need, const DeviceData& device, std::uint8_t set) const noexcept;

  std::optional<PositionBit> home_;
  std::optional<TeachSetup> teach_;
  std::optional<PositionBit> reset_;
  std::optional<PositionBit> array_;  // of one that goes to its elements by bits
  std::uint8_t elements_ = 0;
  profile::PositionScale scale_;
  std::optional<SignalSetup> referenced_;
  std::uint16_t referenced_function_ = 0;
  std::uint8_t referenced_element_ = 0;  // of P481; 0: it is not looked at
  profile::Series series_;
  std::size_t carried_;
};

}  // namespace nord_driver::cycle
