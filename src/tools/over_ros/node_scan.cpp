#include "tools/over_ros/node_scan.h"

#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/node_handle.h>
#include <ros/param.h>

#include <algorithm>
#include <boost/function.hpp>
#include <chrono>
#include <cstdio>
#include <map>
#include <optional>
#include <vector>

#include "config/driver_settings.h"
#include "nord_driver/BusStatus.h"
#include "nord_driver/DeviceInfo.h"
#include "tools/drive_parameters.h"

namespace nord_driver::tools {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{11};  // device_info comes with the status, whose rate may be 0.1 Hz
const ros::WallDuration kSlice{0.05};

std::vector<std::string> deviceInfoTopics(const std::string& node) {
  constexpr char kEnding[] = "/device_info";
  ros::master::V_TopicInfo known;
  ros::master::getTopics(known);
  std::vector<std::string> topics;
  for (const ros::master::TopicInfo& topic : known) {
    const bool ends = topic.name.size() >= sizeof kEnding &&
                      topic.name.compare(topic.name.size() - sizeof kEnding + 1, std::string::npos, kEnding) == 0;
    if (ends && topic.name.compare(0, node.size() + 1, node + "/") == 0) topics.push_back(topic.name);
  }
  return topics;
}

bool names(const std::vector<std::string>& drives, const std::string& drive) {
  return std::find(drives.begin(), drives.end(), drive) != drives.end();
}

FoundStation stationOf(const DeviceInfo& drive, const BusStatus& bus, bool shares_its_address) {
  FoundStation station;
  station.number = drive.address;
  if (drive.ident != 0) {
    char ident[24];
    std::snprintf(ident, sizeof ident, "ident %04Xh", static_cast<unsigned>(drive.ident));
    station.module = ident;
  }
  station.series = drive.series;
  if (!drive.software_version.empty()) station.version = "inverter " + drive.software_version;
  station.note = "drive " + drive.name;
  if (shares_its_address) station.note += ", inverter " + std::to_string(drive.inverter);
  station.note += names(bus.online, drive.name) ? ", online" : ", does not answer";
  return station;
}

}  // namespace

ScanReport scanNode(const std::string& node) {
  ros::CallbackQueue queue;
  ros::NodeHandle handle;
  handle.setCallbackQueue(&queue);
  std::map<std::string, DeviceInfo> drives;
  std::optional<BusStatus> bus;
  std::vector<ros::Subscriber> subscribers;
  const std::vector<std::string> topics = deviceInfoTopics(node);
  if (topics.empty()) throw Trouble("node " + node + " tells of no drives: is it a nord_driver_node that runs?");
  for (const std::string& topic : topics) {
    const boost::function<void(const DeviceInfo::ConstPtr&)> take = [&drives, topic](const DeviceInfo::ConstPtr& told) {
      drives[topic] = *told;
    };
    subscribers.push_back(handle.subscribe<DeviceInfo>(topic, 1, take));
  }
  const boost::function<void(const BusStatus::ConstPtr&)> take = [&bus](const BusStatus::ConstPtr& told) {
    bus = *told;
  };
  subscribers.push_back(handle.subscribe<BusStatus>(node + "/bus_status", 1, take));
  const Clock::time_point end = Clock::now() + kPatience;
  while ((!bus || drives.size() < topics.size()) && Clock::now() < end) queue.callAvailable(kSlice);
  if (!bus || drives.empty()) throw Trouble("node " + node + " tells nothing of its bus: has it ended?");

  ScanReport report;
  std::string transport;
  ros::param::get(node + "/transport", transport);
  report.bus = "node " + node + (transport.empty() ? "" : " (" + shortTransportName(transport) + ")");
  report.number_name = "address";
  std::map<std::uint16_t, int> behind;
  for (const auto& drive : drives) ++behind[drive.second.address];
  for (const auto& [topic, drive] : drives) {
    report.stations.push_back(stationOf(drive, *bus, behind[drive.address] > 1));
  }
  std::stable_sort(report.stations.begin(), report.stations.end(),
                   [](const FoundStation& a, const FoundStation& b) { return a.number < b.number; });
  report.notes.push_back("bus: " + bus->text);
  report.notes.emplace_back(
      "These are the drives of the node, as it knows them: who else is on the bus is asked only while no node has it.");
  return report;
}

}  // namespace nord_driver::tools
