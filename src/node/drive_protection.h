// What stops a drive when this computer dies: what the bus does, what the drive's parameters say of it, and whether it
// is soon enough.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cycle/device_data.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/series.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::node {

struct ProtectionReport {
  enum class Level : std::uint8_t {
    kFine,
    kWarning,  ///< it stops, but late or not in every case
    kError,    ///< it would run on
  };
  Level level = Level::kFine;
  std::string text;  ///< what stops it, or what is wrong, in words
};

/// Compares with P513 in the inverter, or with P151 in a module SK CU4/TU4 and what watches the way from there to the
/// inverter: P513 in SK 511E to 535E, P120 in the others (BU 2700 7.1.1, 8.1). What could not be read is a warning;
/// where nothing ever can be read, and the bus watches nothing either, an error. Of a node that looks on (`read_only`)
/// nothing has to stop, and a time-out above 0 is a warning: it trips on the words 0000 (7.1.1).
class DriveProtection {
 public:
  DriveProtection(DriveIdentity identity, profile::Series series, Duration cmd_vel_timeout, Duration period,
                  bool looks_on = false);
  ProtectionReport assess(const cycle::DeviceData& device) const;

 private:
  /// `own`: the time-out that decides, s, called `name`.
  ProtectionReport assessLookingOn(const std::optional<double>& own, const std::string& name) const;
  void assessWayToModule(const cycle::DeviceData& device, ProtectionReport& report) const;

  DriveIdentity identity_;
  profile::Series series_;
  Duration cmd_vel_timeout_;
  Duration period_;
  bool looks_on_;
};

}  // namespace nord_driver::node
