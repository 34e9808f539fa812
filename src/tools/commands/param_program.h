// What all commands of nord_param have at hand: the options of the program, and the configuration and bus they lead to.
#pragma once

#include <yaml-cpp/yaml.h>

#include <atomic>
#include <boost/shared_ptr.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catalogue/catalogues.h"
#include "catalogue/drive_catalogue.h"
#include "nord_driver/transport/transport.h"
#include "tools/bus_port.h"
#include "tools/command_line.h"
#include "tools/drive_nodes.h"
#include "tools/drive_parameters.h"
#include "tools/parameter_link.h"
#include "tools/progress_bar.h"
#include "tools/tool_config.h"
#include "tools/transport_loader.h"

namespace nord_driver::tools {

/// What is done with a drive that answers. False: refused or different, and said so.
using DriveTask = std::function<bool(DriveParameters&)>;

/// Drives whose bus a node has, as the configuration describes them.
struct NodeWithDrives {
  DriveNodes& nodes;
  std::string name;
  std::shared_ptr<const catalogue::Catalogues> catalogues;  ///< what the drives are known by; they point into it
  std::vector<DriveDescription> drives;                     ///< in the order they were asked for
};

/// What is done with drives that answer, over the bus itself. False as above.
using LinkTask = std::function<bool(ParameterLink&)>;

class ParamProgram {
 public:
  /// Adds the options of the program, and from here on catches the signals that end it: a write that is under way is not
  /// cut off, P560 may have to be put back.
  explicit ParamProgram(CommandLine& line);

  /// Through which a drive is asked whose bus a node has; it must outlive the program. Without any, no node is looked
  /// for.
  void reachThrough(DriveNodes& nodes) noexcept { nodes_ = &nodes; }

  // Once the command line was read.
  const std::vector<std::string>& files() const noexcept { return files_; }  ///< --config
  const BusPort& port() const noexcept { return port_; }
  Duration timeout() const noexcept { return seconds(timeout_.value); }
  /// SIGINT, SIGTERM or SIGHUP came.
  const std::atomic<bool>& endAsked() const noexcept { return end_asked_; }
  TransportLoader& loader() noexcept { return loader_; }

  /// The configuration of --config, one file over the other, with the port chosen. Throws UsageError and ConfigError.
  const YAML::Node& file();
  /// As the configuration names it, for parameters only; not configured. Throws as file().
  Transport& transport();
  /// Its name without prefix; empty without --config. Throws as file().
  std::string transportName();
  /// The drives of the configuration; none without --config. Throws as file().
  std::vector<std::string> driveNames();
  /// cataloguesFor() the configuration, where there is one. Throws as file().
  catalogue::Catalogues catalogues();
  /// --yes: nobody is asked.
  bool isAgreed() const noexcept { return yes_; }
  /// On stderr, where it is a terminal.
  ProgressBar& progress() noexcept { return progress_; }
  /// The project's, those of the configuration, and --parameter-files.
  catalogue::Catalogues cataloguesFor(const ToolConfig& config) const;

  /// Does the task with the drive of that name: through a node, when --node names one or one has the bus, and says so;
  /// else opens the bus, and closes it after. `prepare` makes the task of what is known of the drive, and tells what is
  /// wrong already there: that reaches no bus. May be called for one drive after the other. Returns the exit code.
  int onDrive(const std::string& drive, const std::function<DriveTask(const catalogue::DriveCatalogue&)>& prepare);

  /// The node that has the bus of these drives, and says so; nothing: the bus is opened here.
  std::optional<NodeWithDrives> nodeWith(const std::vector<std::string>& drives);
  /// The same for whoever is on the bus of the file, whose drives need not be named.
  std::optional<NodeWithDrives> nodeWithBus(const Settings& bus);
  /// Throws Trouble where another process has the device of `bus`. `instead`: what tells as much while the driver has
  /// it, a clause.
  void refuseBusInUse(const Settings& bus, const std::string& instead);
  /// Over the bus itself, several drives at a time, and for what needs the process data. `prepare` may keep the link.
  /// `instead`: as above.
  int onDrives(const std::vector<std::string>& drives, const std::string& instead,
               const std::function<LinkTask(ParameterLink&)>& prepare);

 private:
  void load();
  boost::shared_ptr<Transport> loadTransport(const std::string& name);
  /// The node to ask; empty: none, the bus is opened here.
  std::string nodeFor(const Settings& bus, const std::string& drive);
  /// Of one of the drives of the configuration the transport was configured with.
  DriveDescription describe(const ToolConfig& config, const catalogue::Catalogues& catalogues, DriveIndex index);
  /// It is named on stderr.
  NodeWithDrives asked(const std::string& node);
  int throughNode(const std::string& node, const ToolConfig& config, const catalogue::Catalogues& catalogues,
                  const std::function<DriveTask(const catalogue::DriveCatalogue&)>& prepare);

  std::vector<std::string> files_;
  BusPort port_;
  Seconds timeout_{5.0};
  std::vector<std::string> parameter_files_;
  std::string node_;       // --node
  bool yes_ = false;       // --yes
  bool set_free_ = false;  // --set-free
  DriveNodes* nodes_ = nullptr;
  const std::atomic<bool>& end_asked_;
  TransportLoader loader_;
  boost::shared_ptr<Transport> transport_;  // empty: nothing is loaded yet
  bool served_ = false;                     // it is configured for one drive
  YAML::Node file_;
  ProgressBar progress_;
};

}  // namespace nord_driver::tools
