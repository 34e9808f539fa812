// The commissioning check at the node: what is found in the parameters that the bus cycle has read, for /diagnostics and,
// once, for the log.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "catalogue/drive_catalogue.h"
#include "commissioning/asked_drive.h"
#include "commissioning/finding.h"
#include "cycle/snapshot.h"
#include "node/node_config.h"
#include "node/state_log.h"

namespace nord_driver::node {

/// What stops a drive when this computer dies is DriveProtection's to tell, with more than parameters in view.
class CommissioningWarnings {
 public:
  struct OfDrive {
    std::vector<std::string> warnings;  ///< sentences on errors and warnings
    std::vector<std::string> notes;     ///< the same of what is perhaps meant
  };

  /// `identities`, `known`: one per drive.
  CommissioningWarnings(const NodeConfig& config, const std::vector<DriveIdentity>& identities,
                        std::vector<catalogue::DriveCatalogue> known);

  /// Judges what has been read by now. Returns what no earlier call has found.
  std::vector<LogLine> update(const cycle::CycleSnapshot& snapshot);
  /// Of the last update; empty before everything has been asked for.
  const OfDrive& of(DriveIndex drive) const { return found_[drive]; }

 private:
  void take(const commissioning::Finding& finding, std::vector<LogLine>& news);

  std::vector<commissioning::AskedDrive> asked_;
  std::vector<catalogue::DriveCatalogue> known_;
  std::vector<OfDrive> found_;
  std::set<std::string> told_;
};

}  // namespace nord_driver::node
