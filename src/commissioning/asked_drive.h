// What the driver's configuration asks of a drive, as far as the drive's own parameters have to fit it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cycle/asked_bits.h"
#include "cycle/cycle_config.h"
#include "cycle/word_needs.h"
#include "nord_driver/profile/series.h"
#include "nord_driver/transport/bus_report.h"

namespace nord_driver::commissioning {

struct AskedDrive {
  std::string name;
  profile::Series series = profile::Series::kSk5xxe;
  std::string transport;   ///< without prefix: "profibus_dp"
  DriveIdentity identity;  ///< how it hangs on the bus, what protects it, how many process values it has
  double period = 0.01;    ///< s, of the bus cycle
  bool of_base = false;
  bool looks_on = false;  ///< the node commands nothing (`read_only`): its words are 0000, and its end changes nothing
  bool follows = false;   ///< another inverter is to lead it
  bool allows_minimum_frequency = false;
  std::optional<double> typed_max_frequency;   ///< Hz
  std::optional<double> rated_current;         ///< A
  cycle::WordNeeds words;                      ///< functions the words beyond the first must have
  std::vector<cycle::AskedBit> position_bits;  ///< of a drive that positions: what P480 and P481 have to say
  /// Revolutions a drive that positions counts for one of its motor: position/gear_ratio by gear_ratio.
  double counted_per_motor_turn = 1.0;
  std::vector<std::uint8_t> may_move_bits;  ///< elements of P480 a signal with `may_move` accepts
  /// Hz at the motor for the fastest that the limits of the base, or of the joint, allow on one axis; 0: no limits.
  double top_frequency = 0.0;
  std::string top_of;  ///< the key of that limit: "linear/x/max_velocity"
};

/// One per drive of `config`. `identities`: of the transport as the driver itself configures it; `transport`: its name,
/// with or without prefix; `looks_on`: AskedDrive::looks_on of all.
std::vector<AskedDrive> askedDrives(const cycle::CycleConfig& config, const std::vector<DriveIdentity>& identities,
                                    const std::string& transport, bool looks_on);

}  // namespace nord_driver::commissioning
