#include "node/what_is_offered.h"

#include "node/wheel_state_publisher.h"

namespace nord_driver::node {

NodeConfig withWhatIsOffered(NodeConfig config, const TreeSettings& settings) {
  bool& wheel_states = config.publish.publish_wheel_states;
  if (!wheel_states || WheelStatePublisher::isOffered()) return config;
  wheel_states = false;
  config.warnings.push_back(settings.fullName("publish_wheel_joint_controller_state") +
                            " is not offered: there was no control_msgs when this driver was built; ~<drive>/status "
                            "tells command and velocity of each wheel");
  return config;
}

}  // namespace nord_driver::node
