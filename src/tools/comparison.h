// What differs between two dumps, or between a dump and a drive.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/parameter_dump.h"

namespace nord_driver::tools {

/// Raw values; none: that side does not have the parameter.
struct Difference {
  catalogue::ParameterAddress address;
  std::optional<std::int32_t> first, second;
};

struct Differences {
  std::vector<Difference> found;  ///< in the order of the first side, then what only the second one has
  std::size_t compared = 0;       ///< settings that either side has
};

/// Their settings; information changes by itself. By what is `known`, raw values count that mean the same: a word may
/// have come with or without its sign.
Differences differencesOf(const Dump& first, const Dump& second, const catalogue::DriveCatalogue& known);

/// What the drive has of the settings of `dump`. Throws Trouble when the drive stops answering, or `end_asked`.
Dump readAlike(DriveParameters& drive, const Dump& dump, const std::atomic<bool>& end_asked);

/// Throws UsageError when the two are of different series: their numbers mean something else.
void refuseOtherSeries(const std::string& first, profile::Series first_series, const std::string& second,
                       profile::Series second_series);

/// What is known of the drives of a series; of the bus modules in front of them where a transport's name tells which.
catalogue::DriveCatalogue knownOf(const catalogue::Catalogues& catalogues, profile::Series series,
                                  const std::string& transport);

/// "P102 set 1 Acceleration time: 2.00 s in the file, 2.50 s in the drive".
std::string differenceText(const Difference& difference, const catalogue::DriveCatalogue& known,
                           const std::string& first, const std::string& second);

/// "P102 set 1 Acceleration time"; the number alone where nothing is known of it.
std::string parameterTitle(const catalogue::ParameterAddress& address, const catalogue::DriveCatalogue& known);

}  // namespace nord_driver::tools
