// The commissioning check over the bus: reads what the rules look at, and writes what they would have.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "catalogue/catalogues.h"
#include "commissioning/check.h"
#include "node/node_config.h"
#include "tools/drive_parameters.h"

namespace nord_driver::tools {

/// One drive of the configuration, and what became of it.
struct CommissionedDrive {
  commissioning::AskedDrive asked;
  catalogue::DriveCatalogue known;
  std::optional<commissioning::CommissioningFacts> facts;  ///< nothing: it could not be asked
  std::uint8_t set_in_force = 1;
  std::string trouble;  ///< why not
};

/// The drives `names` of the configuration, all where there are none. Throws ConfigError when one is not there.
/// `catalogues` must outlive them.
std::vector<CommissionedDrive> drivesToCheck(const node::NodeConfig& config,
                                             const std::vector<DriveIdentity>& identities,
                                             const std::vector<std::string>& names,
                                             const catalogue::Catalogues& catalogues);

/// Reads everything the rules look at. Throws Trouble when the drive is lost, or `end_asked`.
void readFacts(CommissionedDrive& drive, DriveParameters& parameters, const std::atomic<bool>& end_asked);

/// What is found in the drives that could be asked.
commissioning::Findings findingsIn(const std::vector<CommissionedDrive>& drives);

/// One value to be written.
struct Fix {
  commissioning::Finding finding;
  catalogue::ParameterAccess access;  ///< one to write
};

/// What of `findings` can be written in this drive, what gives the bus control first: without it an inverter may refuse
/// every other write (BU 0020 6.2.2). One value for each parameter.
std::vector<Fix> fixesFor(const CommissionedDrive& drive, const commissioning::Findings& findings, bool persistent);

}  // namespace nord_driver::tools
