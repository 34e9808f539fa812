// Looks at some drives through the node that has their bus: by what it publishes, and by its parameter services.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tools/drive_nodes.h"
#include "tools/watch_list.h"
#include "tools/watch_table.h"

namespace nord_driver::tools {

/// Drives that move, too: nothing is sent to them but what their node sends anyway, and what is read on request.
class NodeWatch {
 public:
  /// `parameters`: read of every drive at each look, as users name them. `nodes` must outlive the object. Throws
  /// UsageError when one of the drives cannot have such a parameter, and Trouble when the node tells nothing of one.
  NodeWatch(DriveNodes& nodes, const std::string& node, const std::vector<DriveDescription>& drives,
            const std::vector<std::string>& parameters);

  /// As all drives are now. Throws Trouble when the node has ended.
  std::vector<WatchedDrive> look();
  const std::vector<std::string>& labels() const noexcept { return list_.labels(); }

 private:
  struct Watched {
    DriveDescription drive;
    std::unique_ptr<StatusFeed> status;
    std::unique_ptr<DriveParameters> parameters;  // empty: none was asked for
  };

  WatchedDrive look(Watched& watched, const std::vector<catalogue::ParameterAddress>& addresses);

  WatchList list_;
  std::vector<Watched> drives_;
};

}  // namespace nord_driver::tools
