#include "node/nothing_to_tune.h"

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>

#include <boost/function.hpp>

namespace nord_driver::node {

namespace {

constexpr char kGroup[] = "Default";  // the one every client looks for

dynamic_reconfigure::Config emptyConfig() {
  dynamic_reconfigure::Config config;
  config.groups.emplace_back();
  config.groups.back().name = kGroup;
  config.groups.back().state = true;
  return config;
}

dynamic_reconfigure::ConfigDescription emptyDescription() {
  dynamic_reconfigure::ConfigDescription description;
  description.groups.emplace_back();
  description.groups.back().name = kGroup;
  description.max = description.min = description.dflt = emptyConfig();
  return description;
}

}  // namespace

NothingToTune::NothingToTune(ros::NodeHandle& private_node)
    : descriptions_(private_node.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true)),
      updates_(private_node.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true)) {
  descriptions_.publish(emptyDescription());
  updates_.publish(emptyConfig());
  using Reconfigure = dynamic_reconfigure::Reconfigure;
  boost::function<bool(Reconfigure::Request&, Reconfigure::Response&)> callback = [](Reconfigure::Request& request,
                                                                                     Reconfigure::Response& response) {
    response.config = emptyConfig();
    const auto& wanted = request.config;
    if (wanted.bools.empty() && wanted.ints.empty() && wanted.doubles.empty() && wanted.strs.empty()) return true;
    ROS_WARN(
        "nord_driver: dynamic_reconfigure changes a base with left and right wheels only, and this node has none: "
        "nothing is changed");
    return true;
  };
  server_ = private_node.advertiseService("set_parameters", callback);
}

}  // namespace nord_driver::node
