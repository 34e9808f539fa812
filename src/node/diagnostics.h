// /diagnostics: one task for the bus, one for the base, one per drive (REP-107).
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <mutex>
#include <string>
#include <vector>

#include "catalogue/drive_catalogue.h"
#include "cycle/snapshot.h"
#include "node/commissioning_warnings.h"
#include "node/drive_protection.h"
#include "node/drive_values.h"
#include "node/ignored_commands.h"
#include "node/node_config.h"
#include "node/ramp_check.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::node {

/// Reports the snapshot it was given last. `update` runs the tasks each PublishConfig::diagnostic_period.
class Diagnostics {
 public:
  /// `known`, `values`: of each drive. `where`: what the transport opens, as configured. `ignored` must outlive it.
  Diagnostics(const NodeConfig& config, const std::vector<DriveIdentity>& identities,
              const std::vector<catalogue::DriveCatalogue>& known, std::vector<DriveValues> values,
              const std::string& where, const IgnoredCommands& ignored);
  void update(const cycle::CycleSnapshot& snapshot);

 private:
  void reportBus(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reportDrive(std::size_t index, diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void summarize(std::size_t index, diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void warn(std::size_t index, const ProtectionReport& protection,
            diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void addFault(std::size_t index, diagnostic_updater::DiagnosticStatusWrapper& status) const;

  std::vector<std::string> names_;
  std::vector<profile::Series> series_;
  std::vector<DriveIdentity> identities_;
  std::vector<catalogue::DriveCatalogue> known_;
  std::vector<DriveValues> values_;
  std::vector<DriveProtection> protections_;
  std::vector<RampCheck> ramps_;
  CommissioningWarnings commissioning_;
  std::string device_;
  const IgnoredCommands& ignored_;
  cycle::CycleSnapshot snapshot_;
  diagnostic_updater::Updater updater_;
  Duration period_;
  Instant next_update_{};  // its own clock is ROS's, which may be set back or stand still
};

}  // namespace nord_driver::node
