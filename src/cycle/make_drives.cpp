#include "cycle/make_drives.h"

#include <algorithm>

namespace nord_driver::cycle {

namespace {

// A cycle in which one station is silent takes as long as all its retries: behind a slow adapter longer than several
// others. Two such cycles are no loss, unless somebody said so.
Duration driveTimeout(const CycleConfig& config, const DriveSetup& setup, const DriveIdentity& identity) {
  if (config.drive_timeout_given) return setup.drive.drive_timeout;
  return std::max(setup.drive.drive_timeout, config.period() + 2 * seconds(identity.worst_cycle));
}

}  // namespace

std::vector<drive::Drive> makeDrives(const CycleConfig& config, Transport& transport, bool onlooker) {
  std::vector<drive::Drive> drives;
  Duration shortest = Duration::max();
  for (const DriveSetup& setup : config.drives) {
    drive::DriveConfig drive = setup.drive;
    const DriveIdentity identity = transport.identity(drives.size());
    drive.drive_timeout = driveTimeout(config, setup, identity);
    drive.setup_timeout = config.setupTimeout(setup);
    drive.parameter_sets = identity.parameter_sets;
    drive.has_quick_stop = identity.has_quick_stop;
    drive.reverses = identity.reverses;
    drive.onlooker = onlooker;
    drive.led = setup.leader.has_value();
    shortest = std::min(shortest, drive.drive_timeout);
    drives.emplace_back(drive);
  }
  transport.setDriveTimeout(shortest);
  transport.setShutdownTimeout(config.shutdown_timeout);
  return drives;
}

}  // namespace nord_driver::cycle
