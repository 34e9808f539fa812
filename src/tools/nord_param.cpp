// nord_param: parameters of the inverters on the command line, over the bus itself, without a roscore.
#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "nord_driver/core/version.h"
#include "nord_driver/tools/command_line.h"
#include "nord_driver/tools/end_signals.h"
#include "nord_driver/tools/param_commands.h"
#include "nord_driver/tools/parameter_dump.h"
#include "nord_driver/tools/parameter_name.h"
#include "nord_driver/tools/transport_loader.h"
#include "nord_driver/tools/yaml_settings.h"

namespace {

using namespace nord_driver::tools;

constexpr char kAbout[] =
    "Reads and writes parameters of NORD inverters over the bus, without ROS: with the driver's configuration file, "
    "but "
    "not beside the driver. It is the master of the bus while it runs.";

constexpr char kFooter[] =
    "It moves nothing and stops nothing: a drive that is not at rest is left as it is, and the command refused. One at "
    "rest gets the idle word 047E, the other drives of the bus get nothing. No watchdog runs and no node is guarded "
    "meanwhile, so that the end of the program trips nothing; a drive with P513 > 0 trips all the same, and is named.\n"
    "End the driver first. A serial device in use is refused, and half a second is listened for another master. On "
    "CANopen a drive that runs without a master and sends nothing is not heard, and is stopped by the start-up of its "
    "node.\n"
    "A dump cannot be written back: the bus settings in it (P507 to P515, P543 to P548, P105) are the branch this "
    "program sits on, and what fits one drive may move another.\n"
    "Exit code: 0 done, 1 refused, failed or different, 2 wrong usage.";

struct Options {
  std::vector<std::string> files;
  BusPort port;
  double timeout = 5.0;  // s
  std::string drive;
  std::string parameter;
  int set = 0;
  int index = 0;
  WriteWish write;
  std::string dump;
};

void list(const YAML::Node& file) {
  const ToolConfig config = readToolConfig(file);
  TransportLoader loader;
  const auto transport = loader.load(config.transport);
  transport->configure(*config.bus, config.drives, config.cycle.cycle_rate);
  printList(config, *transport);
}

using Command = std::function<bool(ParameterLink&)>;

int carryOut(const ToolConfig& config, double timeout, const Command& command, const std::atomic<bool>& end_asked) {
  TransportLoader loader;
  const auto transport = loader.load(config.transport);
  ParameterLink link{config, *transport};
  link.connect(nord_driver::seconds(timeout), end_asked);
  bool done = false;
  std::exception_ptr stopped;
  try {
    done = command(link);
  } catch (const std::exception&) {
    stopped = std::current_exception();
  }
  for (const std::string& sentence : link.finish()) std::fprintf(stderr, "nord_param: %s\n", sentence.c_str());
  if (stopped) std::rethrow_exception(stopped);
  return done ? kDone : kFailed;
}

int run(int argc, char** argv) {
  CLI::App app{kAbout};
  app.footer(kFooter);
  app.set_version_flag("--version", std::string("nord_param ") + nord_driver::kVersion);
  app.require_subcommand(1);
  app.fallthrough();
  Options options;
  app.add_option("--config", options.files, "the driver's YAML file; a later file is laid over an earlier one")
      ->required()
      ->allow_extra_args(false);
  app.add_option("--device", options.port.device, "PROFIBUS: serial device, in place of the file's bus/device");
  app.add_option("--interface", options.port.interface,
                 "CANopen: interface (can0, virtual:NAME), in place of the file's bus/interface");
  app.add_option("--timeout", options.timeout, "s to wait for the drive to answer (5)")->check(positiveSeconds());

  CLI::App* const list_command = app.add_subcommand("list", "the drives of the file, and every known parameter");
  CLI::App* const read = app.add_subcommand("read", "read one parameter");
  CLI::App* const write = app.add_subcommand("write", "write one parameter, in RAM unless told otherwise");
  CLI::App* const dump = app.add_subcommand("dump", "print every known parameter as YAML");
  CLI::App* const compare = app.add_subcommand("compare", "tell how the settings of a drive differ from a dump");
  for (CLI::App* command : {read, write, dump, compare}) {
    command->add_option("DRIVE", options.drive, "its name in the file")->required();
  }
  for (CLI::App* command : {read, write}) {
    command->add_option("PARAMETER", options.parameter, "the manual's number: 105, P105 or P700[-01]")->required();
    command->add_option("--set", options.set, "parameter set 1 to 4; without it the set in force")
        ->check(CLI::Range(1, 4));
    command->add_option("--index", options.index, "array element, [-01] = 1")->check(CLI::Range(1, 99));
  }
  write->add_option("VALUE", options.write.value, "in the unit that list shows")->required();
  write->add_flag("--persistent", options.write.persistent,
                  "save it in the EEPROM, which endures 100 000 writes; writes even what is there");
  write->add_flag("--raw", options.write.raw, "VALUE is as transferred; needed where the unit is not known");
  compare->add_option("FILE", options.dump, "what dump has printed")->required();
  if (const auto code = parseArguments(app, argc, argv)) return *code;

  // A write that is under way is not cut off: P560 may have to be put back.
  const std::atomic<bool>& end_asked = catchEndSignals();
  YAML::Node file = readYamlFiles(options.files);
  choosePort(file, options.port);
  if (list_command->parsed()) {
    list(file);
    return kDone;
  }
  const ToolConfig config = readToolConfig(file, options.drive);
  Command command = [&end_asked](ParameterLink& link) { return dumpParameters(link, end_asked); };
  if (compare->parsed()) {
    command = [&end_asked, reference = readDump(options.dump)](ParameterLink& link) {
      return compareParameters(link, reference, end_asked);
    };
  }
  // What is wrong already here reaches no bus.
  if (read->parsed()) {
    const auto address = addressOf(options.parameter, options.set, options.index);
    command = [address](ParameterLink& link) { return readParameter(link, address); };
  }
  if (write->parsed()) {
    const auto address = addressOf(options.parameter, options.set, options.index);
    const auto wish = checkedWish(options.write, address, config.cycle.drives.front().series);
    command = [address, wish](ParameterLink& link) { return writeParameter(link, address, wish); };
  }
  return carryOut(config, options.timeout, command, end_asked);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const UsageError& error) {
    std::fprintf(stderr, "nord_param: %s\n", error.what());
    return kWrongUsage;
  } catch (const nord_driver::ConfigError& error) {
    std::fprintf(stderr, "nord_param: %s\n", error.what());
    return kWrongUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nord_param: %s\n", error.what());
    return kFailed;
  }
}
