// What the node that has a drive's bus publishes of it: ~<drive>/status and ~<drive>/process_data.
#pragma once

#include <ros/callback_queue.h>
#include <ros/subscriber.h>

#include <optional>
#include <string>
#include <vector>

#include "nord_driver/DriveStatus.h"
#include "nord_driver/ProcessData.h"
#include "tools/live_drive.h"
#include "tools/over_ros/node_life.h"

namespace nord_driver::tools {

/// ros::init() comes before it.
class NodeStatusFeed final : public StatusFeed {
 public:
  /// `node`: with its leading slash. Throws Trouble when there is no such node.
  NodeStatusFeed(const std::string& node, const std::string& drive);

  LiveStatus newest() override;

 private:
  std::string topic_;
  NodeLife life_;
  std::optional<LiveStatus> newest_;
  ros::CallbackQueue queue_;
  ros::Subscriber subscriber_;  // goes before the queue its callbacks lie in
};

/// As above. Each cycle since the node has connected; they come some at a time.
class NodeCycleFeed final : public CycleFeed {
 public:
  NodeCycleFeed(const std::string& node, const std::string& drive);

  std::vector<LiveCycle> take() override;

 private:
  std::string topic_;
  NodeLife life_;
  std::vector<LiveCycle> cycles_;
  ros::CallbackQueue queue_;
  ros::Subscriber subscriber_;
};

}  // namespace nord_driver::tools
