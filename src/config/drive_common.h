// What a drive's configuration says whatever bus it is on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "nord_driver/config/settings.h"
#include "nord_driver/profile/series.h"
#include "profile/scaling.h"

namespace nord_driver {

struct DriveCommon {
  std::string name;
  std::string joint;  ///< it turns; empty: none
  profile::Series series = profile::Series::kSk5xxe;
  profile::JointScaling scaling;
  /// P105 as the user typed it, from 0.1 to 400 Hz. Counts where the drive does not tell P105, and not before it was
  /// asked: one that is wrong would move it at another speed than commanded.
  std::optional<Hertz> typed_max_frequency;
  std::optional<double> rated_current;  ///< A
  bool allow_minimum_frequency = false;
  std::optional<std::int64_t> address;  ///< on the bus, of its module if it has one; the range is the bus's
  std::uint8_t inverter = 1;            ///< 1..4 behind a bus module that serves several
};

/// `series` and `pole_pairs` must be there; the others have the defaults above. Throws ConfigError naming key, value
/// and what was expected.
DriveCommon readDriveCommon(const DriveSettings& source);

/// The drive's address, which must be there and in the bus's range. Throws ConfigError.
std::int64_t requiredAddress(const DriveSettings& source, std::int64_t min, std::int64_t max);

}  // namespace nord_driver
