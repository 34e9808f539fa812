#include "tools/over_ros/ros_drive_nodes.h"

#include <ros/init.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/network.h>
#include <ros/param.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "link/serial/lock_owner.h"
#include "tools/over_ros/node_feeds.h"
#include "tools/over_ros/node_life.h"
#include "tools/over_ros/node_parameters.h"
#include "tools/over_ros/node_scan.h"

namespace nord_driver::tools {

namespace {

constexpr char kProgram[] = "nord_param";  // as the master knows it, with a number behind

/// As roslaunch, rosservice and Debian's roscpp take it where the variable is not set: Debian's packages set none.
std::string masterUri() {
  const char* uri = std::getenv("ROS_MASTER_URI");
  return uri == nullptr || *uri == '\0' ? "http://localhost:11311" : uri;
}

bool masterAnswers() {
  std::string host;
  std::uint32_t port = 0;
  return ros::network::splitURI(masterUri(), host, port) && acceptsConnection(host, port);
}

/// Nodes that offer this drive's parameters, or did: one that was killed is still known. Without a drive: any drive's.
std::vector<std::string> nodesWith(const std::string& drive) {
  XmlRpc::XmlRpcValue arguments, result, payload;
  arguments[0] = ros::this_node::getName();
  std::vector<std::string> nodes;
  if (!ros::master::execute("getSystemState", arguments, result, payload, false)) return nodes;
  const std::string ending = (drive.empty() ? "" : "/" + drive) + "/read_parameter";
  XmlRpc::XmlRpcValue& services = payload[2];
  for (int i = 0; i < services.size(); ++i) {
    const std::string name = services[i][0];
    if (name.size() <= ending.size() || name.compare(name.size() - ending.size(), ending.size(), ending) != 0) continue;
    std::string node = name.substr(0, name.size() - ending.size());
    if (drive.empty()) node.erase(node.rfind('/'));
    if (!node.empty() && std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
  }
  return nodes;
}

/// A device behind all its links; what is no file, a CAN interface or a gateway, stays as it is.
std::string behindLinks(const std::string& port) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::canonical(port, error);
  return error ? port : path.string();
}

std::string portOf(const std::string& node, const std::string& key) {
  std::string port;
  if (ros::param::get(node + "/bus_end_point", port) && !port.empty()) return port;
  ros::param::get(node + "/bus/" + key, port);
  return port;
}

/// The id of its process, when it answers and runs here; the same device of another machine is another bus.
std::optional<int> processHere(const std::string& node) {
  const auto process = processOf(node);
  if (!process || link::programOf(*process).str() != "nord_driver_node") return std::nullopt;
  return process;
}

std::string withSlash(const std::string& node) {
  return node.front() == '/' ? node : "/" + node;
}

}  // namespace

RosDriveNodes::~RosDriveNodes() {
  if (begun_) ros::shutdown();
}

// The signals are this program's own. Without the variable upstream's roscpp aborts, Debian's does not.
void RosDriveNodes::begin() {
  if (begun_) return;
  ::setenv("ROS_MASTER_URI", masterUri().c_str(), 1);
  ros::init(ros::M_string{}, kProgram,
            ros::init_options::NoSigintHandler | ros::init_options::AnonymousName | ros::init_options::NoRosout);
  ros::start();
  begun_ = true;
}

std::optional<std::string> RosDriveNodes::find(const NodeQuery& query) {
  if (query.port_key.empty() || query.port.empty() || !masterAnswers()) return std::nullopt;
  begin();
  const auto owner = link::lockOwner(query.port.c_str());
  for (const std::string& node : nodesWith(query.drive)) {
    if (behindLinks(portOf(node, query.port_key)) != behindLinks(query.port)) continue;
    const auto process = processHere(node);
    if (process && (!owner || owner->process == *process)) return node;
  }
  return std::nullopt;
}

std::unique_ptr<DriveParameters> RosDriveNodes::open(const std::string& node, const DriveDescription& drive) {
  beginFor(node);
  return std::make_unique<NodeParameters>(withSlash(node), drive);
}

std::unique_ptr<StatusFeed> RosDriveNodes::statusOf(const std::string& node, const std::string& drive) {
  beginFor(node);
  return std::make_unique<NodeStatusFeed>(withSlash(node), drive);
}

std::unique_ptr<CycleFeed> RosDriveNodes::cyclesOf(const std::string& node, const std::string& drive) {
  beginFor(node);
  return std::make_unique<NodeCycleFeed>(withSlash(node), drive);
}

ScanReport RosDriveNodes::scan(const std::string& node) {
  beginFor(node);
  return scanNode(withSlash(node));
}

void RosDriveNodes::beginFor(const std::string& node) {
  if (!begun_ && !masterAnswers()) {
    throw Trouble("no ROS master answers at ROS_MASTER_URI (" + masterUri() + "): node " + node + " cannot be asked");
  }
  begin();
}

}  // namespace nord_driver::tools
