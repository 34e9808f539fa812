// nord_param: parameters of the inverters on the command line, over the bus itself, without a roscore.
#include <langinfo.h>
#include <unistd.h>

#include <atomic>
#include <boost/program_options.hpp>
#include <clocale>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "config/yaml_settings.h"
#include "core/version.h"
#include "tools/command_line.h"
#include "tools/config_check.h"
#include "tools/config_picture.h"
#include "tools/end_signals.h"
#include "tools/image_command.h"
#include "tools/installed_catalogues.h"
#include "tools/lock_owner.h"
#include "tools/param_commands.h"
#include "tools/parameter_dump.h"
#include "tools/parameter_link.h"
#include "tools/parameter_list.h"
#include "tools/transport_loader.h"

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
  Seconds timeout{5.0};
  std::string drive;
  std::string parameter;
  WholeNumber<1, 4> set;     ///< 0: not given
  WholeNumber<1, 99> index;  ///< 0: not given
  WriteOptions write;
  std::string dump;
  std::vector<std::string> parameter_files;
  std::string described;  ///< empty: list them all
  std::string checked;    ///< file
  std::string urdf;       ///< file
  bool json = false;
  ImageOptions image;
  WholeNumber<1, 256> count;  ///< 0: not given
};

nord_driver::catalogue::Catalogues cataloguesFor(const ToolConfig& config, const Options& options) {
  std::vector<std::string> own = config.parameter_files;
  own.insert(own.end(), options.parameter_files.begin(), options.parameter_files.end());
  return installedCatalogues(own);
}

void list(const YAML::Node& file, nord_driver::Transport& transport, const Options& options) {
  const ToolConfig config = readToolConfig(file, transport.endPoint());
  const nord_driver::catalogue::Catalogues catalogues = cataloguesFor(config, options);
  transport.configure(*config.bus, config.drives, config.cycle.cycle_rate);
  const std::string text = options.described.empty()
                               ? listText(config, transport, catalogues)
                               : descriptionText(config, transport, catalogues, options.described);
  std::fputs(text.c_str(), stdout);
}

// Box-drawing characters where somebody looks who can see them.
bool drawsLines() {
  std::setlocale(LC_CTYPE, "");
  return ::isatty(STDOUT_FILENO) != 0 && std::string(::nl_langinfo(CODESET)) == "UTF-8";
}

int check(const Options& options) {
  std::vector<std::string> files{options.checked};
  files.insert(files.end(), options.files.begin(), options.files.end());
  std::ostringstream urdf;
  if (!options.urdf.empty()) {
    const std::ifstream file(options.urdf);
    if (!file) throw UsageError("--urdf " + options.urdf + ": this file cannot be read");
    urdf << file.rdbuf();
  }
  TransportLoader loader;
  const CheckedConfig config = checkConfig(files, urdf.str(), options.port, [&loader](const std::string& name) {
    const auto transport = loader.load(name);
    return std::shared_ptr<nord_driver::Transport>(transport.get(), [transport](nord_driver::Transport*) {});
  });
  std::fputs((options.json ? configJson(config) : configPicture(config, drawsLines())).c_str(), stdout);
  return config.accepted() ? kDone : kFailed;
}

using Task = std::function<bool(DriveParameters&)>;

// Whoever has the device does not give it away while this program waits.
void refuseBusInUse(const ToolConfig& config, const nord_driver::EndPoint& end_point) {
  if (end_point.isNone()) return;
  const std::string where = config.bus->text(end_point.key).value_or("");
  const auto owner = lockOwner(where);
  if (!owner) return;
  throw Trouble(where + " is in use by " + (owner->name.empty() ? "a program" : owner->name) + " (process " +
                std::to_string(owner->process) +
                "): end it first; or ask the driver while it runs: rosservice call /nord_driver/" +
                config.drives.front().name + "/read_parameter, or write_parameter");
}

int carryOut(ParameterLink& link, double timeout, const Task& task, const std::atomic<bool>& end_asked) {
  link.connect(nord_driver::seconds(timeout), end_asked);
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

int run(int argc, char** argv) {
  namespace po = boost::program_options;
  Options options;
  CommandLine line{"nord_param", nord_driver::kVersion, kAbout, kFooter};
  line.setBrief("parameters of NORD inverters over their bus, without ROS");
  line.offer("SET", {"1", "2", "3", "4"});
  line.addOptions()("config", po::value(&options.files)->value_name("FILE"),
                    "the driver's YAML file; a later file is laid over an earlier one; required, but for check-config")(
      "bus", po::value(&options.port.bus)->value_name("VALUE"),
      "where the bus is: a serial device, a CAN interface or whatever else the file's transport opens, in place of "
      "what the file says")("device", po::value(&options.port.device)->value_name("PATH"),
                            "the same for a transport with bus/device")(
      "interface", po::value(&options.port.interface)->value_name("NAME"),
      "the same for a transport with bus/interface")("timeout", po::value(&options.timeout)->value_name("SECONDS"),
                                                     "s to wait for the drive to answer (5)")(
      "parameter-files", po::value(&options.parameter_files)->value_name("FILE"),
      "a file of parameters or faults of your own, laid over the driver's and those the configuration names; may be "
      "given several times");

  Command& list_command = line.addCommand("list", "the drives of the file, and every known parameter");
  list_command.options.add_options()("parameter", po::value(&options.described)->value_name("PARAMETER"),
                                     "everything that is known of one parameter: range, names of values, source");
  Command& read = line.addCommand("read", "read one parameter");
  Command& write = line.addCommand("write", "write one parameter, in RAM unless told otherwise");
  Command& dump = line.addCommand("dump", "print every known parameter as YAML");
  Command& compare = line.addCommand("compare", "tell how the settings of a drive differ from a dump");
  Command& image =
      line.addCommand("image", "show the words of a gateway's image and those that change; writes nothing");
  for (Command* command : {&read, &write, &dump, &compare}) {
    command->arguments.push_back({"DRIVE", "its name in the file", &options.drive});
  }
  for (Command* command : {&read, &write}) {
    command->arguments.push_back(
        {"PARAMETER", "its number or name: 105, P105, P700[-01], \"Maximum frequency\"", &options.parameter});
    command->options.add_options()("set", po::value(&options.set)->value_name("SET"),
                                   "parameter set 1 to 4; without it the set in force")(
        "index", po::value(&options.index)->value_name("INDEX"), "array element, [-01] = 1");
  }
  write.arguments.push_back({"VALUE", "in the unit that list shows, or the name of a value", &options.write.value});
  write.options.add_options()("persistent", po::bool_switch(&options.write.persistent),
                              "save it in the EEPROM, which endures 100 000 writes; writes even what is there")(
      "raw", po::bool_switch(&options.write.raw), "VALUE is as transferred; needed where the unit is not known");
  compare.arguments.push_back({"FILE", "what dump has printed", &options.dump});
  Command& check_config =
      line.addCommand("check-config", "read a configuration without hardware, and show what was understood");
  check_config.arguments.push_back({"FILE", "the driver's YAML file; --config lays others over it", &options.checked});
  check_config.options.add_options()("json", po::bool_switch(&options.json), "for programs")(
      "urdf", po::value(&options.urdf)->value_name("FILE"),
      "the robot's URDF, what robot_description is to the driver");
  image.options.add_options()("once", po::bool_switch(&options.image.once), "show it once, and end")(
      "json", po::bool_switch(&options.image.json), "one JSON object a line")(
      "count", po::value(&options.count)->value_name("COUNT"),
      "so many words at least; without it up to the last one of a drive");
  if (const auto code = line.parse(argc, argv)) return *code;
  if (line.asksFor(check_config)) return check(options);
  if (options.files.empty()) throw UsageError("the option '--config' is required but missing");

  // A write that is under way is not cut off: P560 may have to be put back.
  const std::atomic<bool>& end_asked = catchEndSignals();
  YAML::Node file = nord_driver::readYamlFiles(options.files);
  TransportLoader loader;
  const auto transport = loader.load(transportOf(file));
  choosePort(file, options.port, transport->endPoint());
  if (line.asksFor(list_command)) {
    list(file, *transport, options);
    return kDone;
  }
  if (line.asksFor(image)) {
    options.image.words = static_cast<std::size_t>(options.count.value);
    options.image.patience = nord_driver::seconds(options.timeout.value);
    return showImage(file, *transport, options.image, end_asked) ? kDone : kFailed;
  }
  const ToolConfig config = readToolConfig(file, options.drive);
  const nord_driver::catalogue::Catalogues catalogues = cataloguesFor(config, options);
  ParameterLink link{config, *transport, catalogues};
  Task task = [&end_asked](DriveParameters& drive) { return dumpParameters(drive, end_asked); };
  if (line.asksFor(compare)) {
    task = [&end_asked, reference = readDump(options.dump)](DriveParameters& drive) {
      return compareParameters(drive, reference, end_asked);
    };
  }
  // What is wrong already here reaches no bus.
  if (line.asksFor(read)) {
    const auto address = addressOf(options.parameter, options.set.value, options.index.value, link.known());
    task = [address](DriveParameters& drive) { return readParameter(drive, address); };
  }
  if (line.asksFor(write)) {
    const auto address = addressOf(options.parameter, options.set.value, options.index.value, link.known());
    const auto access = checkedWrite(options.write, address, link.known());
    task = [access](DriveParameters& drive) { return writeParameter(drive, access); };
  }
  refuseBusInUse(config, transport->endPoint());
  return carryOut(link, options.timeout.value, task, end_asked);
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
