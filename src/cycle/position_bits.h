// The single bits a drive that positions is asked by, and says by: reference run, and "referenced".
//
// A bit goes to the drive as bus I/O in bit, as bit 8 or 9 of the control word (P480 says what it does), or in the
// POSICON control bits of SK 700E and 750E (BU 0020 7.3.5). Which number of P480 is the reference run stands in the
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
  /// What the drive says of its reference; none where no bit is configured, or nobody knows which word carries it.
  std::optional<bool> referenced(const profile::ProcessInput& input, const DeviceData& device,
                                 std::uint8_t set) const noexcept;

 private:
  std::optional<std::size_t> placeOf(const WordNeed& need, const DeviceData& device, std::uint8_t set) const noexcept;

  std::optional<HomeBit> home_;
  std::optional<SignalSetup> referenced_;
  profile::Series series_;
  std::size_t carried_;
};

}  // namespace nord_driver::cycle
