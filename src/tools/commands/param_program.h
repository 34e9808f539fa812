// What all commands of nord_param have at hand: the options of the program, and the configuration and bus they lead to.
#pragma once

#include <yaml-cpp/yaml.h>

#include <atomic>
#include <boost/shared_ptr.hpp>
#include <functional>
#include <string>
#include <vector>

#include "catalogue/catalogues.h"
#include "catalogue/drive_catalogue.h"
#include "nord_driver/transport/transport.h"
#include "tools/bus_port.h"
#include "tools/command_line.h"
#include "tools/drive_parameters.h"
#include "tools/progress_bar.h"
#include "tools/tool_config.h"
#include "tools/transport_loader.h"

namespace nord_driver::tools {

/// What is done with a drive that answers. False: refused or different, and said so.
using DriveTask = std::function<bool(DriveParameters&)>;

class ParamProgram {
 public:
  /// Adds the options of the program, and from here on catches the signals that end it: a write that is under way is not
  /// cut off, P560 may have to be put back.
  explicit ParamProgram(CommandLine& line);

  // Once the command line was read.
  const std::vector<std::string>& files() const noexcept { return files_; }  ///< --config
  const BusPort& port() const noexcept { return port_; }
  Duration timeout() const noexcept { return seconds(timeout_.value); }
  /// SIGINT, SIGTERM or SIGHUP came.
  const std::atomic<bool>& endAsked() const noexcept { return end_asked_; }
  TransportLoader& loader() noexcept { return loader_; }

  /// The configuration of --config, one file over the other, with the port chosen. Throws UsageError and ConfigError.
  const YAML::Node& file();
  /// As the configuration names it; not configured. Throws as file().
  Transport& transport();
  /// Its name without prefix; empty without --config. Throws as file().
  std::string transportName();
  /// The drives of the configuration; none without --config. Throws as file().
  std::vector<std::string> driveNames();
  /// cataloguesFor() the configuration, where there is one. Throws as file().
  catalogue::Catalogues catalogues();
  /// On stderr, where it is a terminal.
  ProgressBar& progress() noexcept { return progress_; }
  /// The project's, those of the configuration, and --parameter-files.
  catalogue::Catalogues cataloguesFor(const ToolConfig& config) const;

  /// Opens the bus, does the task with the drive of that name, and closes the bus. `prepare` makes the task of what is
  /// known of the drive, and tells what is wrong already there: that reaches no bus. May be called for one drive after
  /// the other. Returns the exit code.
  int onDrive(const std::string& drive, const std::function<DriveTask(const catalogue::DriveCatalogue&)>& prepare);

 private:
  void load();
  /// Whoever has the device does not give it away while this program waits.
  void refuseBusInUse(const ToolConfig& config);

  std::vector<std::string> files_;
  BusPort port_;
  Seconds timeout_{5.0};
  std::vector<std::string> parameter_files_;
  const std::atomic<bool>& end_asked_;
  TransportLoader loader_;
  boost::shared_ptr<Transport> transport_;  // empty: nothing is loaded yet
  bool served_ = false;                     // it is configured for one drive
  YAML::Node file_;
  ProgressBar progress_;
};

}  // namespace nord_driver::tools
