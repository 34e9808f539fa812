// Any text as the YAML file of a node, read as the node and `nord_param check-config` read it: it is taken or refused
// with one sentence, nothing else is ever thrown, and what is taken holds only what a cycle can run on.
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "config/driver_settings.h"
#include "config/yaml_settings.h"
#include "documents/bus_readers.h"
#include "fuzz.h"
#include "node/node_config.h"

namespace {

using namespace nord_driver;
using fuzz::require;

constexpr char kRobot[] =
    "<robot name=\"r\"><link name=\"base_link\"/><link name=\"l\"/><link name=\"r\"/>"
    "<joint name=\"left_wheel\" type=\"continuous\"><parent link=\"base_link\"/><child link=\"l\"/>"
    "<origin xyz=\"0 0.25 0\"/><axis xyz=\"0 1 0\"/><limit effort=\"1\" velocity=\"9\"/></joint>"
    "<joint name=\"right_wheel\" type=\"continuous\"><parent link=\"base_link\"/><child link=\"r\"/>"
    "<origin xyz=\"0 -0.25 0\"/><axis xyz=\"0 1 0\"/></joint></robot>";

/// As the node reads it; throws ConfigError.
void readBus(const node::NodeConfig& config) {
  const std::string bus = shortTransportName(config.transport);
  const auto read = bus == "canopen"     ? documents::readCanopen
                    : bus == "devicenet" ? documents::readDevicenet
                    : bus == "interbus"  ? documents::readInterbus
                                         : documents::readProfibus;
  read(*config.bus, config.drives, config.cycle.cycle_rate);
}

void check(const node::NodeConfig& config) {
  const cycle::CycleConfig& cycle = config.cycle;
  require(std::isfinite(cycle.cycle_rate) && cycle.cycle_rate > 0.0 && cycle.period() > Duration::zero());
  require(cycle.service_timeout > Duration::zero() && cycle.shutdown_timeout > Duration::zero());
  require(cycle.cmd_vel_timeout >= Duration::zero());
  require(!config.drives.empty() && config.drives.size() == cycle.drives.size());
  require(config.monitor.size() == config.drives.size());
  require(!config.read_only || !config.auto_enable);
  std::set<std::string> names;
  for (const cycle::DriveSetup& setup : cycle.drives) {
    const auto& joint = setup.drive.joint;
    require(names.insert(setup.name).second);
    require(std::isfinite(joint.gear_ratio) && joint.gear_ratio != 0.0 && joint.pole_pairs > 0);
    require(!setup.typed_max_frequency ||
            (std::isfinite(*setup.typed_max_frequency) && *setup.typed_max_frequency > 0));
    require(robot::problemOf(setup.limits, "").empty());
  }
  require(std::isfinite(config.publish.publish_rate) && config.publish.status_rate > 0.0);
  if (!cycle.base) return;
  std::set<DriveIndex> wheels;
  for (const DriveIndex wheel : cycle.base->wheels()) {
    require(wheel < cycle.drives.size() && wheels.insert(wheel).second);
  }
  robot::TwistLimiter{cycle.base->limits};  // throws where they contradict each other
  robot::makeKinematics(cycle.base->kind, cycle.base->geometry, cycle.base->left.size(), cycle.base->right.size());
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  YAML::Node file;
  try {
    file = YAML::Load(text);
  } catch (const YAML::Exception&) {  // what the readers of files make a sentence of
    return 0;
  }
  try {
    const YamlSettings settings{"~", file};
    node::NodeConfig config = node::readNodeConfig(settings, text.size() % 2 == 0 ? kRobot : "");
    readBus(config);
    check(config);
    for (const std::string& sentence : node::unknownKeys(settings, config, "/driver")) require(!sentence.empty());
  } catch (const ConfigError& error) {
    require(*error.what() != '\0');
  }
  return 0;
}
