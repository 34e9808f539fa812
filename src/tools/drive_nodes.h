// Nodes of the driver that run now and have a bus already: what this program asks them instead of the bus.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "catalogue/drive_catalogue.h"
#include "nord_driver/profile/series.h"
#include "nord_driver/transport/transport.h"
#include "tools/drive_parameters.h"
#include "tools/live_drive.h"
#include "transport/bus_scanner.h"

namespace nord_driver::tools {

/// What the configuration says of one drive.
struct DriveDescription {
  std::string name;
  profile::Series series = profile::Series::kSk5xxe;
  DriveIdentity identity;
  catalogue::DriveCatalogue known;
  bool positions = false;  ///< `mode: position`: its first words may be no frequencies
};

struct NodeQuery {
  std::string drive;     ///< its name; empty: whichever
  std::string port_key;  ///< of the group `bus`: "device"; empty: the transport opens nothing that has a name
  std::string port;      ///< what it says: "/dev/ttyUSB0"
};

class DriveNodes {
 public:
  virtual ~DriveNodes() = default;

  /// The name of a node on this machine that has this bus and this drive. None: there is none, or no ROS; found out
  /// without waiting.
  virtual std::optional<std::string> find(const NodeQuery& query) = 0;
  /// The drive's parameters through the node of that name. Throws Trouble when it does not offer them.
  virtual std::unique_ptr<DriveParameters> open(const std::string& node, const DriveDescription& drive) = 0;
  /// What that node tells of the drive. Throws Trouble as above, and when it tells nothing.
  virtual std::unique_ptr<StatusFeed> statusOf(const std::string& node, const std::string& drive) = 0;
  virtual std::unique_ptr<CycleFeed> cyclesOf(const std::string& node, const std::string& drive) = 0;
  /// Every drive of that node, as it knows them. Throws Trouble when nothing comes.
  virtual ScanReport scan(const std::string& node) = 0;

 protected:
  DriveNodes() = default;
  DriveNodes(const DriveNodes&) = default;
  DriveNodes& operator=(const DriveNodes&) = default;
};

}  // namespace nord_driver::tools
