#include "tools/commands/param_program.h"

#include <cstdio>
#include <exception>

#include "config/driver_settings.h"
#include "config/yaml_settings.h"
#include "link/serial/lock_owner.h"
#include "tools/end_signals.h"
#include "tools/installed_catalogues.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

namespace po = boost::program_options;

namespace {

int carryOut(ParameterLink& link, Duration timeout, const LinkTask& task, const std::atomic<bool>& end_asked) {
  // On stdout it would be in the middle of what programs read.
  link.connect(timeout, end_asked,
               [](const std::string& wait) { std::fprintf(stderr, "nord_param: %s\n", wait.c_str()); });
  bool done = false;
  std::exception_ptr stopped;
  try {
    done = task(link);
  } catch (const std::exception&) {
    stopped = std::current_exception();
  }
  for (const std::string& sentence : link.finish()) std::fprintf(stderr, "nord_param: %s\n", sentence.c_str());
  if (stopped) std::rethrow_exception(stopped);
  return done ? kDone : kFailed;
}

void setNodesFree(YAML::Node& file) {
  const std::string transport = shortTransportName(transportOf(file));
  if (transport != "canopen") throw UsageError("--set-free is for CANopen, and the file's transport is " + transport);
  file["bus"]["set_free"] = true;
}

}  // namespace

ParamProgram::ParamProgram(CommandLine& line)
    : end_asked_(catchEndSignals()),
      progress_([](const std::string& text) { std::fputs(text.c_str(), stderr); }, columnsOfStderr()) {
  line.addOptions()("config", po::value(&files_)->value_name("FILE"),
                    "the driver's YAML file; a later file is laid over an earlier one; required, but for check-config")(
      "bus", po::value(&port_.bus)->value_name("VALUE"),
      "where the bus is: a serial device, a CAN interface or whatever else the file's transport opens, in place of "
      "what the file says")("device", po::value(&port_.device)->value_name("PATH"),
                            "the same for a transport with bus/device")(
      "interface", po::value(&port_.interface)->value_name("NAME"), "the same for a transport with bus/interface")(
      "timeout", po::value(&timeout_)->value_name("SECONDS"), "s to wait for the drive to answer (5)")(
      "parameter-files", po::value(&parameter_files_)->value_name("FILE"),
      "a file of parameters or faults of your own, laid over the driver's and those the configuration names; may be "
      "given several times")("node", po::value(&node_)->value_name("NAME"),
                             "the driver's node that is asked instead of the bus: /nord_driver; without it one on this "
                             "machine that has the bus is found by itself")(
      "yes", po::bool_switch(&yes_), "do not ask, where a command asks before it writes; elsewhere it changes nothing")(
      "set-free", po::bool_switch(&set_free_),
      "CANopen: nodes that somebody left operational are led to "
      "pre-operational, when for 2 s nobody commands them and "
      "none of them says that its drive runs");
}

// Whether it serves them is asked where its bus is opened (ParameterLink): a list, or a node, needs no more of it than
// its configuration.
boost::shared_ptr<Transport> ParamProgram::loadTransport(const std::string& name) {
  auto transport = loader_.load(name);
  transport->serveParametersOnly();
  return transport;
}

void ParamProgram::load() {
  if (transport_) return;
  if (files_.empty()) throw UsageError("the option '--config' is required but missing");
  file_ = readYamlFiles(files_);
  auto transport = loadTransport(transportOf(file_));
  choosePort(file_, port_, transport->endPoint());
  if (set_free_) setNodesFree(file_);
  transport_ = transport;
}

const YAML::Node& ParamProgram::file() {
  load();
  return file_;
}

Transport& ParamProgram::transport() {
  load();
  return *transport_;
}

std::string ParamProgram::transportName() {
  return files_.empty() ? "" : shortTransportName(transportOf(file()));
}

std::vector<std::string> ParamProgram::driveNames() {
  std::vector<std::string> names;
  if (files_.empty()) return names;
  for (const DriveSettings& drive : readDriveList(YamlSettings{"", file()})) names.push_back(drive.name);
  return names;
}

catalogue::Catalogues ParamProgram::catalogues() {
  ToolConfig config;
  if (!files_.empty()) config = readToolConfig(file(), transport().endPoint());
  return cataloguesFor(config);
}

catalogue::Catalogues ParamProgram::cataloguesFor(const ToolConfig& config) const {
  std::vector<std::string> own = config.parameter_files;
  own.insert(own.end(), parameter_files_.begin(), parameter_files_.end());
  try {
    return installedCatalogues(own);
  } catch (const ConfigError& error) {
    throw catalogue::namedBy("parameter_files", config.parameter_files, error);
  }
}

int ParamProgram::onDrive(const std::string& drive,
                          const std::function<DriveTask(const catalogue::DriveCatalogue&)>& prepare) {
  const ToolConfig config = readToolConfig(file(), drive);
  const catalogue::Catalogues catalogues = cataloguesFor(config);
  if (served_) {
    transport_.reset();  // configured for another drive; the library does not like two of them
    transport_ = loadTransport(config.transport);
  }
  served_ = true;
  const std::string node = nodeFor(*config.bus, config.drives.front().name);
  if (!node.empty()) return throughNode(node, config, catalogues, prepare);
  ParameterLink link{config, *transport_, catalogues};
  const DriveTask task = prepare(link.known());
  refuseBusInUse(*config.bus, "rosservice call /nord_driver/" + drive + "/read_parameter, or write_parameter");
  return carryOut(link, timeout(), task, end_asked_);
}

int ParamProgram::onDrives(const std::vector<std::string>& drives, const std::string& instead,
                           const std::function<LinkTask(ParameterLink&)>& prepare) {
  const ToolConfig config = readToolConfig(file(), drives);
  const catalogue::Catalogues catalogues = cataloguesFor(config);
  ParameterLink link{config, transport(), catalogues};
  const LinkTask task = prepare(link);
  refuseBusInUse(*config.bus, instead);
  const LinkTask and_tell = [&task](ParameterLink& connected) {
    const bool done = task(connected);
    for (DriveIndex i = 0; i < connected.driveCount(); ++i) {
      const std::string changed = connected.changedByReading(i);
      if (!changed.empty()) std::fprintf(stderr, "nord_param: %s\n", changed.c_str());
    }
    return done;
  };
  return carryOut(link, timeout(), and_tell, end_asked_);
}

std::optional<NodeWithDrives> ParamProgram::nodeWith(const std::vector<std::string>& drives) {
  const ToolConfig config = readToolConfig(file(), drives);
  const std::string node = nodeFor(*config.bus, config.drives.front().name);
  if (node.empty()) return std::nullopt;
  NodeWithDrives found = asked(node);
  found.catalogues = std::make_shared<const catalogue::Catalogues>(cataloguesFor(config));
  transport().configure(*config.bus, config.drives, config.cycle.cycle_rate);
  for (DriveIndex i = 0; i < config.asked; ++i) found.drives.push_back(describe(config, *found.catalogues, i));
  return found;
}

std::optional<NodeWithDrives> ParamProgram::nodeWithBus(const Settings& bus) {
  const std::string node = nodeFor(bus, "");
  if (node.empty()) return std::nullopt;
  return asked(node);
}

std::string ParamProgram::nodeFor(const Settings& bus, const std::string& drive) {
  if (nodes_ == nullptr || !node_.empty()) return node_;
  NodeQuery query;
  query.drive = drive;
  query.port_key = transport().endPoint().key;
  if (!query.port_key.empty()) query.port = bus.text(query.port_key).value_or("");
  return nodes_->find(query).value_or("");
}

NodeWithDrives ParamProgram::asked(const std::string& node) {
  if (nodes_ == nullptr) throw UsageError("--node " + node + ": this program was built without ROS");
  std::fprintf(stderr, "nord_param: through node %s, which has the bus\n", node.c_str());
  return {*nodes_, node, nullptr, {}};
}

DriveDescription ParamProgram::describe(const ToolConfig& config, const catalogue::Catalogues& catalogues,
                                        DriveIndex index) {
  const cycle::DriveSetup& drive = config.cycle.drives[index];
  const DriveIdentity identity = transport().identity(index);
  return {drive.name, drive.series, identity,
          catalogue::driveCatalogue(catalogues, drive.series, shortTransportName(config.transport),
                                    identity.timeout_owner == TimeoutOwner::kModule),
          drive.position.has_value()};
}

int ParamProgram::throughNode(const std::string& node, const ToolConfig& config,
                              const catalogue::Catalogues& catalogues,
                              const std::function<DriveTask(const catalogue::DriveCatalogue&)>& prepare) {
  if (nodes_ == nullptr) throw UsageError("--node " + node + ": this program was built without ROS");
  transport().configure(*config.bus, config.drives, config.cycle.cycle_rate);
  const DriveDescription description = describe(config, catalogues, 0);
  const DriveTask task = prepare(description.known);
  const auto parameters = nodes_->open(node, description);
  asked(node);
  return task(*parameters) ? kDone : kFailed;
}

// Whoever has the device does not give it away while this program waits.
void ParamProgram::refuseBusInUse(const Settings& bus, const std::string& instead) {
  const EndPoint end_point = transport().endPoint();
  if (end_point.isNone()) return;
  const std::string where = bus.text(end_point.key).value_or("");
  const auto owner = link::lockOwner(where.c_str());
  if (!owner) return;
  throw Trouble(where + " is in use by " + link::toText(*owner).str() +
                ": end it first; or ask the driver while it runs: " + instead);
}

}  // namespace nord_driver::tools
