#include "node/values_publisher.h"

#include <utility>

namespace nord_driver::node {

ValuesPublisher::ValuesPublisher(ros::NodeHandle& private_node, std::string drive, DriveValues values)
    : values_(std::move(values)) {
  message_.name = std::move(drive);
  if (!values_.empty()) publisher_ = private_node.advertise<Values>(message_.name + "/values", 10);
}

void ValuesPublisher::publish(const cycle::DriveSnapshot& drive, ros::Time stamp) {
  if (values_.empty()) return;
  message_.header.stamp = stamp;
  message_.values = values_.values(drive);
  publisher_.publish(message_);
}

}  // namespace nord_driver::node
