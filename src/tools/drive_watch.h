// Looks at some drives over a connected link, as a guest: reads, and moves nothing.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tools/parameter_link.h"
#include "tools/watch_list.h"
#include "tools/watch_table.h"

namespace nord_driver::tools {

class DriveWatch {
 public:
  /// `parameters`: read of every drive at each look, as users name them. Throws UsageError when one of the drives
  /// cannot have such a parameter. `link` must outlive the object.
  DriveWatch(ParameterLink& link, const std::vector<std::string>& parameters);

  /// As all drives are now. What has to be read of a drive takes some cycles of the bus.
  std::vector<WatchedDrive> look();
  /// As a table names the parameters: "P719 Current".
  const std::vector<std::string>& labels() const noexcept { return list_.labels(); }

 private:
  WatchedDrive look(DriveIndex drive);
  /// What of one parameter set has been read.
  struct Scale {
    std::optional<double> max_frequency;  // Hz, P105
    std::optional<bool> is_frequency;     // actual value 1 by P543, of a drive that positions
  };

  /// Hz, 100 % of actual value 1; nothing: not known, or it is no frequency.
  std::optional<double> maxFrequency(DriveIndex drive, std::uint8_t set);
  bool isFrequency(DriveIndex drive, std::uint8_t set);
  std::string faultOf(DriveIndex drive);

  ParameterLink& link_;
  WatchList list_;
  std::vector<std::array<Scale, 5>> scales_;  // by drive and parameter set
};

}  // namespace nord_driver::tools
