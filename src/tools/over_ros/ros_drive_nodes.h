// The nodes of the driver that run, found through the ROS master of the environment (ROS_MASTER_URI; where this is not
// set http://localhost:11311).
#pragma once

#include "tools/drive_nodes.h"

namespace nord_driver::tools {

/// Without a master nothing is asked and nothing waits: one that does not accept a connection within a third of a second
/// is none.
class RosDriveNodes final : public DriveNodes {
 public:
  RosDriveNodes() = default;
  /// Ends what was begun with ROS.
  ~RosDriveNodes() override;

  std::optional<std::string> find(const NodeQuery& query) override;
  std::unique_ptr<DriveParameters> open(const std::string& node, const DriveDescription& drive) override;
  std::unique_ptr<StatusFeed> statusOf(const std::string& node, const std::string& drive) override;
  std::unique_ptr<CycleFeed> cyclesOf(const std::string& node, const std::string& drive) override;
  ScanReport scan(const std::string& node) override;

 private:
  void begin();
  /// Throws Trouble when no master answers.
  void beginFor(const std::string& node);

  bool begun_ = false;
};

}  // namespace nord_driver::tools
