// nord_param: parameters of the inverters on the command line, over the bus itself, without a roscore.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "nord_driver/core/version.h"
#include "nord_driver/tools/parameter_tool.h"
#include "nord_driver/transport/profibus_dp.h"

namespace {

using namespace nord_driver;
using tools::ParameterAnswer;
using tools::ParameterTool;

struct Options {
  std::vector<std::string> files;
  std::string device;
  double timeout = 10.0;  // s
  std::string drive;
  cycle::ParameterAddress address;
  cycle::ParameterWish wish;
};

std::unique_ptr<Transport> makeTransport(const std::string& name) {
  if (name == "nord_driver/profibus_dp" || name == "profibus_dp") return std::make_unique<ProfibusDpTransport>();
  throw ConfigError("transport: \"" + name + "\" is not valid, expected profibus_dp");
}

bool printed(const cycle::ParameterAddress& address, const ParameterAnswer& answer) {
  std::fprintf(answer.success ? stdout : stderr, "%s\n", tools::answerText(address, answer).c_str());
  return answer.success;
}

/// Every element of every parameter the catalogue knows of this series; of parameter sets the one asked for.
bool list(ParameterTool& tool, DriveIndex drive, std::uint8_t set) {
  for (std::uint16_t number = 0; number < 1000; ++number) {
    const profile::ParameterInfo* info = profile::findParameter(number, tool.series(drive));
    if (info == nullptr) continue;
    const bool array =
        info->shape == profile::ParameterShape::kArray || info->shape == profile::ParameterShape::kArrayPerSet;
    for (std::uint8_t index = 1; index <= (array ? info->elements : 1); ++index) {
      const cycle::ParameterAddress address{number, set, static_cast<std::uint8_t>(array ? index : 0)};
      const ParameterAnswer answer = tool.read(drive, address);
      std::printf("%s\n", tools::answerText(address, answer).c_str());
      std::fflush(stdout);
      if (!answer.success && !tool.waitForDrive(drive, Duration::zero())) return false;
    }
  }
  return true;
}

int run(int argc, char** argv) {
  CLI::App app{
      "Reads and writes parameters of NORD inverters over the bus, without ROS. It is the only master: end the "
      "driver first. The drives get the word OFF1 and are not moved."};
  app.set_version_flag("--version", std::string("nord_param ") + kVersion);
  app.require_subcommand(1);
  Options options;
  app.add_option("--config", options.files, "the driver's configuration; a later file is laid over an earlier one")
      ->required()
      ->allow_extra_args(false);
  app.add_option("--device", options.device, "bus device, in place of bus/device");
  app.add_option("--timeout", options.timeout, "how long to wait for the drive, in s");

  CLI::App* read = app.add_subcommand("read", "reads one parameter");
  CLI::App* write = app.add_subcommand("write", "writes one parameter and reads it back");
  CLI::App* all = app.add_subcommand("list", "reads every parameter that is known of this series");
  for (CLI::App* command : {read, write, all}) {
    command->add_option("drive", options.drive, "name of the drive in the configuration")->required();
    command->add_option("--set", options.address.parameter_set, "parameter set 1 to 4; 0: the one in force");
    if (command == all) continue;
    command->add_option("number", options.address.number, "the manual's number: 105 for P105")->required();
    command->add_option("--index", options.address.index, "array index, [-01] = 1; 0: no array");
  }
  write->add_option("value", options.wish.value, "in the parameter's unit")->required();
  write->add_flag("--persistent", options.wish.persistent, "to the EEPROM, which endures 100 000 writes; else RAM");
  write->add_flag("--raw", options.wish.allow_raw, "write a raw value where the unit is not known");
  CLI11_PARSE(app, argc, argv);

  YAML::Node config = tools::readYamlFiles(options.files);
  if (!options.device.empty()) config["bus"]["device"] = options.device;
  const tools::YamlSettings settings{"", config};
  ParameterTool tool{settings, makeTransport(settings.text("transport").value_or("nord_driver/profibus_dp"))};
  const DriveIndex drive = tool.driveNamed(options.drive);
  if (!tool.waitForDrive(drive, seconds(options.timeout))) {
    std::fprintf(stderr, "nord_param: %s\n", tool.trouble(drive).c_str());
    return EXIT_FAILURE;
  }
  bool good = false;
  if (read->parsed()) good = printed(options.address, tool.read(drive, options.address));
  if (write->parsed()) good = printed(options.address, tool.write(drive, options.address, options.wish));
  if (all->parsed()) good = list(tool, drive, options.address.parameter_set);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nord_param: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
