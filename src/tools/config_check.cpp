#include "tools/config_check.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "config/drive_common.h"
#include "config/driver_settings.h"
#include "config/text_file.h"
#include "config/yaml_merge.h"
#include "config/yaml_settings.h"
#include "config/yaml_tree.h"
#include "node/node_config.h"
#include "profile/scaling.h"
#include "robot/wheel_speeds.h"
#include "tools/installed_catalogues.h"
#include "tools/key_lines.h"
#include "tools/monitored_parameters.h"
#include "tools/tool_config.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

namespace {

class Findings {
 public:
  Findings(CheckedConfig& config, const KeyLines& lines) : config_(config), lines_(lines) {}

  void warn(const std::string& sentence) { add(config_.warnings, sentence); }
  void refuse(const std::string& sentence) { add(config_.errors, sentence); }
  /// False: it threw a ConfigError, which is an error now.
  template <typename Step>
  bool run(Step step) {
    try {
      step();
      return true;
    } catch (const ConfigError& error) {
      refuse(error.what());
    }
    return false;
  }

 private:
  void add(std::vector<Finding>& to, const std::string& sentence) {
    const auto same = [&](const Finding& finding) { return finding.text == sentence; };
    if (std::any_of(to.begin(), to.end(), same)) return;
    to.push_back({lines_.lineOf(sentence), sentence});
  }

  CheckedConfig& config_;
  const KeyLines& lines_;
};

YAML::Node load(const std::vector<std::string>& files, CheckedConfig& config) {
  for (const std::string& file : files) {
    std::error_code unreadable;
    const std::string unfit = whyNoTextFile(file);
    if (!unfit.empty()) throw UsageError(file + ": " + unfit);
    if (!std::filesystem::exists(file, unreadable)) throw UsageError(file + ": there is no such file");
    if (!std::ifstream(file)) throw UsageError(file + ": this file cannot be read");
    try {
      const YAML::Node node = YAML::LoadFile(file);
      const std::string why = whyNotWalkable(node);
      if (node.IsMap() && why.empty()) {
        withKeysMerged(node, file);
        continue;
      }
      config.errors.push_back(
          {0, file + ": " + (why.empty() ? "" : why + ", ") + "expected a file of keys and values"});
    } catch (const ConfigError& error) {
      config.errors.push_back({0, error.what()});
    } catch (const YAML::Exception& error) {
      config.errors.push_back({error.mark.line + 1, error.msg + "; expected a readable YAML file"});
    }
    return {};
  }
  return readYamlFiles(files);
}

// As written; lists and groups in one line.
std::string written(const YAML::Node& node) {
  if (node.IsScalar()) return node.Scalar();
  YAML::Emitter emitter;
  emitter << YAML::Flow << node;
  return emitter.c_str();
}

const char* unitOf(const drive::PositionConfig& axis) {
  return axis.unit_per_radian == 1.0 ? "rad" : "m";
}

std::string targetsOf(const drive::PositionConfig& axis) {
  if (!axis.lower && !axis.upper) return "";
  const std::string unit = std::string(" ") + unitOf(axis);
  std::ostringstream text;
  if (axis.lower && axis.upper) {
    text << *axis.lower << " to " << *axis.upper << unit;
  } else {
    text << (axis.lower ? "not below " : "not above ") << (axis.lower ? *axis.lower : *axis.upper) << unit;
  }
  return text.str();
}

CheckedDrive driveOf(const node::NodeConfig& config, DriveIndex index, const DriveIdentity& identity) {
  const cycle::DriveSetup& setup = config.cycle.drives[index];
  CheckedDrive drive;
  drive.name = setup.name;
  drive.joint = setup.joint;
  drive.series = setup.series;
  drive.inverter = identity.inverter;
  drive.gear_ratio = setup.drive.joint.gear_ratio;
  drive.pole_pairs = setup.drive.joint.pole_pairs;
  drive.inverted = setup.drive.joint.inverted;
  drive.frequency_typed = setup.typed_max_frequency.has_value();
  drive.max_frequency = setup.typed_max_frequency.value_or(kFactoryMaxFrequency);
  drive.max_velocity = std::abs(profile::toRadPerSec(Hertz{drive.max_frequency}, setup.drive.joint).value);
  drive.limits = setup.limits;
  drive.leader = setup.follows;
  drive.positions = setup.position.has_value();
  if (setup.position) {
    const drive::PositionConfig& axis = setup.position->axis;
    drive.targets = targetsOf(axis);
    drive.by_element = axis.by_element;
    drive.unit = unitOf(axis);
    drive.max_velocity *= axis.unit_per_radian;
    drive.lower = axis.lower;
    drive.upper = axis.upper;
  }
  return drive;
}

std::vector<CheckedModule> modulesOf(const node::NodeConfig& config, const std::vector<DriveIdentity>& identities) {
  std::vector<CheckedModule> modules;
  std::vector<std::optional<std::size_t>> numbers;
  for (DriveIndex i = 0; i < identities.size(); ++i) {
    const DriveIdentity& identity = identities[i];
    auto at = numbers.end();
    if (identity.shared_module) at = std::find(numbers.begin(), numbers.end(), identity.shared_module);
    if (at == numbers.end()) {
      const std::string station = identity.address.substr(0, identity.address.find(", inverter "));
      modules.push_back({station, identity.parameter_channel, identity.protected_by, {}});
      at = numbers.insert(numbers.end(), identity.shared_module);
    }
    modules[static_cast<std::size_t>(at - numbers.begin())].drives.push_back(driveOf(config, i, identity));
  }
  return modules;
}

/// How much of `unit` the base can do: where the first wheel is at its limit.
double most(const robot::BaseKinematics& base, const robot::Twist2d& unit, const robot::WheelSpeeds& limits) {
  const robot::WheelSpeeds wheels = base.wheels(unit);
  double factor = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    if (wheels[i] != 0.0) factor = std::min(factor, limits[i] / std::abs(wheels[i]));
  }
  return std::isfinite(factor) ? factor : 0.0;
}

CheckedBase baseOf(const cycle::CycleConfig& config) {
  const cycle::BaseConfig& base = *config.base;
  CheckedBase checked;
  checked.kind = base.kind;
  checked.geometry = base.geometry;
  checked.limits = base.limits;
  for (const DriveIndex i : base.left) checked.left.push_back(config.drives[i].name);
  for (const DriveIndex i : base.right) checked.right.push_back(config.drives[i].name);
  for (std::size_t i = 0; base.steered && i < base.steered->wheels.size(); ++i) {
    checked.axles.push_back({config.drives[base.steered->wheels[i]].name, config.drives[base.steered->steering[i]].name,
                             base.steered->axles[i]});
    checked.angle_tolerance = base.steered->angle_tolerance;
  }
  robot::WheelSpeeds limits;
  for (const DriveIndex i : base.wheels()) {
    const cycle::DriveSetup& setup = config.drives[i];
    const Hertz full{setup.typed_max_frequency.value_or(kFactoryMaxFrequency)};
    double limit = std::abs(profile::toRadPerSec(full, setup.drive.joint).value);
    if (!base.joint_velocity_limits.empty()) limit = std::min(limit, base.joint_velocity_limits[limits.size()]);
    limits.push_back(limit);
  }
  const auto kinematics = base.kinematics();
  checked.linear_x = most(*kinematics, {1.0, 0.0, 0.0}, limits);
  checked.angular_z = most(*kinematics, {0.0, 1.0, 0.0}, limits);
  if (kinematics->movesSideways()) checked.linear_y = most(*kinematics, {0.0, 0.0, 1.0}, limits);
  return checked;
}

void takeOver(const node::NodeConfig& config, const node::ConfiguredTransport& transport, CheckedConfig& checked) {
  checked.modules = modulesOf(config, transport.identities);
  if (!config.cycle.base) return;
  checked.base = baseOf(config.cycle);
  if (node::wheelAgainstForward(config.cycle, transport.identities)) checked.base->linear_x = 0.0;
  std::vector<std::string> of_base;
  for (const DriveIndex i : config.cycle.base->drives()) of_base.push_back(config.cycle.drives[i].name);
  for (CheckedModule& module : checked.modules) {
    for (CheckedDrive& drive : module.drives) {
      drive.of_base = std::find(of_base.begin(), of_base.end(), drive.name) != of_base.end();
    }
  }
}

bool anyMonitored(const node::NodeConfig& config) {
  return std::any_of(config.monitor.begin(), config.monitor.end(), [](const auto& list) { return !list.empty(); });
}

void lookUpMonitored(const node::NodeConfig& config, const node::ConfiguredTransport& transport,
                     const catalogue::Catalogues& catalogues, Findings& findings) {
  for (DriveIndex i = 0; i < config.drives.size(); ++i) {
    const DriveIdentity& identity = transport.identities[i];
    const catalogue::DriveCatalogue known =
        catalogue::driveCatalogue(catalogues, config.cycle.drives[i].series, shortTransportName(config.transport),
                                  identity.timeout_owner == TimeoutOwner::kModule);
    findings.run([&] {
      const auto list = monitoredParameters(config.drives[i], config.monitor[i], known, identity);
      for (const std::string& sentence : notInCatalogue(config.drives[i], list)) findings.warn(sentence);
    });
  }
}

/// What is wrong with single drives and the bus, where the node would have ended before it came to them.
void tellTheRest(const YAML::Node& file, const YamlSettings& settings, const std::shared_ptr<Transport>& transport,
                 Findings& findings) {
  std::vector<DriveSettings> drives;
  if (!findings.run([&] { drives = readDriveList(settings); })) return;
  bool all_read = !drives.empty();
  for (const DriveSettings& drive : drives) all_read = findings.run([&] { readDriveCommon(drive); }) && all_read;
  if (!transport || !all_read) return;
  findings.run([&] {
    const double rate = YamlSettings{"", file}.number("cycle_rate").value_or(100.0);
    transport->configure(*settings.group("bus"), drives, rate);
  });
}

}  // namespace

CheckedConfig checkConfig(const std::vector<std::string>& files, const std::string& urdf, const BusPort& port,
                          const TransportMaker& make) {
  CheckedConfig checked;
  checked.files = files;
  YAML::Node file = load(files, checked);
  if (!checked.errors.empty()) return checked;
  const KeyLines lines(files);
  Findings findings(checked, lines);
  for (const std::string& twice : lines.keysTwice()) findings.warn(twice);
  if (!findings.run([&] { YamlSettings("", file); })) return checked;  // a value that is of no kind

  std::shared_ptr<Transport> transport;
  findings.run([&] {
    const std::string name = transportOf(file);
    checked.transport = shortTransportName(name);
    transport = make(name);
    choosePort(file, port, transport->endPoint());
  });
  const YamlSettings settings{"", file};
  node::NodeConfig config;
  node::ConfiguredTransport configured;
  const bool read = findings.run([&] { config = node::readNodeConfig(settings, urdf); }) && transport;
  if (!read) {
    tellTheRest(file, settings, transport, findings);
    return checked;
  }
  std::optional<catalogue::Catalogues> catalogues;
  if (!config.parameter_files.empty() || anyMonitored(config)) {
    findings.run(
        [&] { catalogues = installedCatalogues(config.parameter_files, settings.fullName("parameter_files")); });
  }
  checked.cycle_rate = config.cycle.cycle_rate;
  const bool done = findings.run([&] { configured = node::configureTransport(config, *transport); });
  checked.where = done ? configured.where : "";
  for (const auto& member : file["bus"]) {
    const auto key = member.first.as<std::string>();
    if (key != transport->endPoint().key) checked.bus.emplace_back(key, written(member.second));
  }
  for (const std::string& sentence : config.warnings) findings.warn(sentence);
  if (!done) return checked;
  if (catalogues) lookUpMonitored(config, configured, *catalogues, findings);
  for (const std::string& sentence : configured.warnings) findings.warn(sentence);
  for (const std::string& sentence : node::unknownKeys(settings, config)) findings.warn(sentence);
  takeOver(config, configured, checked);
  return checked;
}

}  // namespace nord_driver::tools
