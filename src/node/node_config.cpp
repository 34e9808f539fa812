#include "node/node_config.h"

#include <cmath>

#include "config/driver_settings.h"
#include "config/setting_checks.h"
#include "cycle/word_places.h"
#include "node/late_protection.h"

namespace nord_driver::node {

namespace {

// A base whose pose comes from wheels alone: sure of what it cannot do (z, roll, pitch), unsure of its heading.
constexpr std::array<double, 6> kDefaultCovariance{1e-3, 1e-3, 1e6, 1e6, 1e6, 3e-2};

std::array<double, 6> readCovariance(const TreeSettings& settings, const std::string& key) {
  const auto values = settings.numbers(key);
  if (!values) return kDefaultCovariance;
  std::array<double, 6> diagonal{};
  if (values->size() != diagonal.size()) {
    throw wrongSetting(settings, key, "a list of " + std::to_string(values->size()) + " numbers",
                       "six numbers: x, y, z, roll, pitch, yaw");
  }
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    diagonal[i] = (*values)[i];
    if (!(diagonal[i] >= 0.0)) {
      throw wrongSetting(settings, key, shortNumber(diagonal[i]), "six numbers that are not negative");
    }
  }
  return diagonal;
}

// What a controller file may hold that means nothing here.
void acceptControllerKeys(const TreeSettings& settings) {
  settings.accept("type");                             // a plugin class
  settings.accept("estimate_velocity_from_position");  // older controllers; inverters tell velocities
}

std::string readFrame(const TreeSettings& settings, const char* key, const std::string& fallback) {
  std::string frame = textOr(settings, key, fallback);
  if (frame.empty()) throw wrongSetting(settings, key, "\"\"", "the name of a frame");
  return frame;
}

PublishConfig readPublish(const TreeSettings& settings) {
  PublishConfig publish;
  publish.publish_rate = numberOr(settings, "publish_rate", publish.publish_rate, 0.0, 2000.0, "Hz");
  publish.status_rate = numberOr(settings, "status_rate", publish.status_rate, 0.1, 1000.0, "Hz");
  publish.diagnostic_period = numberOr(settings, "diagnostic_period", publish.diagnostic_period, 0.1, 3600.0, "s");
  publish.base_frame_id = readFrame(settings, "base_frame_id", publish.base_frame_id);
  publish.odom_frame_id = readFrame(settings, "odom_frame_id", publish.odom_frame_id);
  if (publish.odom_frame_id == publish.base_frame_id) {
    throw wrongSetting(settings, "odom_frame_id", "\"" + publish.odom_frame_id + "\"",
                       "another frame than base_frame_id: tf has no frame that is its own parent");
  }
  publish.enable_odom_tf = booleanOr(settings, "enable_odom_tf", publish.enable_odom_tf);
  publish.publish_cmd = booleanOr(settings, "publish_cmd", publish.publish_cmd);
  publish.allow_multiple_cmd_vel_publishers =
      booleanOr(settings, "allow_multiple_cmd_vel_publishers", publish.allow_multiple_cmd_vel_publishers);
  publish.pose_covariance_diagonal = readCovariance(settings, "pose_covariance_diagonal");
  publish.twist_covariance_diagonal = readCovariance(settings, "twist_covariance_diagonal");
  return publish;
}

// What starts the node may kill it before its drives are at rest; by what it was started a node cannot know.
void warnOfALongEnd(const TreeSettings& settings, NodeConfig& config) {
  constexpr Duration kRoslaunchWaits =
      std::chrono::seconds{15};   // from SIGINT to SIGTERM, by default; 2 s later SIGKILL
  constexpr double kSpare = 1.0;  // s, to let go of ROS
  const Duration end = config.cycle.shutdown_timeout + kQuickStopAtTheEnd;
  if (config.read_only || end <= kRoslaunchWaits) return;
  config.warnings.push_back(settings.fullName("shutdown_timeout") + ": with " +
                            shortNumber(toSeconds(config.cycle.shutdown_timeout)) + " s the end of the node may take " +
                            shortNumber(toSeconds(end)) + " s; roslaunch by default waits " +
                            shortNumber(toSeconds(kRoslaunchWaits)) +
                            " s, then kills it, and the drives coast: start it with roslaunch --sigint-timeout=" +
                            shortNumber(std::ceil(toSeconds(end) + kSpare)));
}

}  // namespace

NodeConfig readNodeConfig(const TreeSettings& settings, const std::string& robot_description) {
  NodeConfig config;
  config.transport = readTransportName(settings);
  config.bus_end_point = textOr(settings, "bus_end_point", "");
  config.auto_enable = booleanOr(settings, "auto_enable", false);
  config.allow_raw_parameters = booleanOr(settings, "allow_raw_parameters", false);
  config.read_only = booleanOr(settings, "read_only", false);
  if (config.read_only && config.auto_enable) {
    throw wrongSetting(settings, "read_only", "true",
                       "false where auto_enable is true: a node that looks on enables nothing");
  }
  config.writable_parameters = readWritableParameters(settings);
  config.parameter_files = settings.texts("parameter_files").value_or(std::vector<std::string>{});
  config.eeprom = readEepromSettings(settings);
  acceptControllerKeys(settings);
  config.publish = readPublish(settings);
  config.publish.publish_wheel_states = booleanOr(settings, "publish_wheel_joint_controller_state", false);
  config.bus = settings.group("bus");
  config.drives = readDriveList(settings);
  for (const DriveSettings& drive : config.drives) {
    const auto& group = static_cast<const TreeSettings&>(*drive.settings);  // as readDriveList has made it
    config.monitor.push_back(group.words("monitor").value_or(std::vector<std::string>{}));
  }
  config.cycle = cycle::readCycleConfig(settings, config.drives, robot_description);
  if (config.cycle.base) {
    const std::vector<std::string>& of_base = config.cycle.base->warnings;
    config.warnings.insert(config.warnings.end(), of_base.begin(), of_base.end());
  }
  if (config.read_only && config.cycle.acknowledge_bus_timeouts) {
    throw wrongSetting(settings, "read_only", "true", "false with acknowledge_at_start: bus_timeouts");
  }
  warnOfALongEnd(settings, config);
  config.trace = trace::readTraceConfig(settings);
  return config;
}

std::string applyEndPoint(NodeConfig& config, const EndPoint& end_point) {
  if (end_point.isNone()) {
    if (config.bus_end_point.empty()) return "";
    throw ConfigError("~bus_end_point: \"" + config.bus_end_point + "\" is not valid, expected none: the transport " +
                      config.transport + " opens nothing");
  }
  // Who only repeats what the file says keeps its second way as well.
  if (!config.bus_end_point.empty() && config.bus->text(end_point.key) != config.bus_end_point) {
    const bool second = *end_point.second_key != '\0' && config.bus->text(end_point.second_key);
    config.bus = config.bus->with(end_point.key, config.bus_end_point);
    if (second) config.bus = config.bus->with(end_point.second_key, config.bus_end_point);
  }
  return config.bus->text(end_point.key).value_or("");  // whether it has to be there, the transport decides
}

// Steered, a wheel may be turned round.
std::optional<DriveIndex> wheelAgainstForward(const cycle::CycleConfig& config,
                                              const std::vector<DriveIdentity>& identities) {
  if (!config.base || config.base->steered) return std::nullopt;
  for (const DriveIndex i : config.base->wheels()) {
    if (!identities[i].reverses && config.drives[i].drive.joint.inverted) return i;
  }
  return std::nullopt;
}

ConfiguredTransport configureTransport(NodeConfig& config, Transport& transport) {
  ConfiguredTransport configured;
  // Nothing in the modules is to trip when the one who looks on goes, and nothing is sent beside another master.
  if (config.read_only && !transport.serveParametersOnly()) {
    throw ConfigError("~read_only: true is not possible: the transport " + config.transport +
                      " cannot be on the bus without leading it, expected false");
  }
  configured.where = applyEndPoint(config, transport.endPoint());
  transport.configure(*config.bus, config.drives, config.cycle.cycle_rate);
  configured.warnings = transport.warnings();
  for (DriveIndex i = 0; i < config.drives.size(); ++i) {
    configured.identities.push_back(transport.identity(i));
    if (config.read_only && configured.identities[i].process_values == 0) {
      throw ConfigError("~read_only: true is not possible: over the transport " + config.transport +
                        " only its master gets process data, expected false");
    }
    cycle::checkWordsCarried(*config.drives[i].settings, config.cycle.drives[i].words, configured.identities[i]);
    if (config.cycle.drives[i].position) {
      cycle::checkPositionCarried(*config.drives[i].settings, *config.cycle.drives[i].position,
                                  config.cycle.drives[i].series, configured.identities[i]);
    }
    cycle::checkWordPlaces(*config.drives[i].settings, config.cycle.drives[i], configured.identities[i],
                           config.read_only);
    // Without a parameter channel P105 cannot be read: nobody could say what a setpoint means.
    if (configured.identities[i].parameter_channel == "none" && !config.cycle.drives[i].typed_max_frequency) {
      throw missingSetting(*config.drives[i].settings, "max_frequency",
                           "P105 in Hz, because this drive has no parameter channel to read it from");
    }
  }
  const std::vector<std::string> late = lateProtection(*config.bus, configured.identities);
  configured.warnings.insert(configured.warnings.end(), late.begin(), late.end());
  if (const auto wheel = wheelAgainstForward(config.cycle, configured.identities)) {
    configured.warnings.push_back(
        config.drives[*wheel].settings->fullName("inverted") +
        ": true keeps the base from ever driving forward, because this drive has no reverse as it is configured here, "
        "and a base rests as a whole while one of its wheels cannot turn as commanded; expected a telegram with a "
        "reverse, or false, with a motor that drives forward when it turns to the right");
  }
  return configured;
}

std::vector<std::string> unknownKeys(const TreeSettings& settings, const NodeConfig& config, const std::string& node) {
  // The search for a robot description begins with the node's own parameters.
  if (!node.empty()) settings.accept("robot_description");
  std::vector<const TreeSettings*> groups{&settings, config.bus.get()};
  for (const DriveSettings& drive : config.drives) {
    groups.push_back(static_cast<const TreeSettings*>(drive.settings.get()));
  }
  std::vector<std::string> sentences;
  for (const TreeSettings* group : groups) {
    for (const std::string& sentence : group->unknownKeys(node)) sentences.push_back(sentence);
  }
  return sentences;
}

}  // namespace nord_driver::node
