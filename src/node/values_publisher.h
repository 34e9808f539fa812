// ~<drive>/values: the parameters of drives/<name>/monitor.
#pragma once

#include <ros/ros.h>

#include <string>

#include "cycle/snapshot.h"
#include "node/drive_values.h"
#include "nord_driver/Values.h"

namespace nord_driver::node {

/// Of one drive. Where none is listed, there is no topic.
class ValuesPublisher {
 public:
  /// `private_node`: "~".
  ValuesPublisher(ros::NodeHandle& private_node, std::string drive, DriveValues values);

  void publish(const cycle::DriveSnapshot& drive, ros::Time stamp);

 private:
  DriveValues values_;
  Values message_;
  ros::Publisher publisher_;
};

}  // namespace nord_driver::node
