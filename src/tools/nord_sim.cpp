// nord_sim: simulated NORD drives on a pseudo-terminal or a CAN bus, without ROS.

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <atomic>
#include <boost/program_options.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "config/yaml_merge.h"
#include "config/yaml_tree.h"
#include "sim/bus_kind.h"
#include "sim/running_bus.h"
#include "tools/bus_port.h"
#include "tools/command_line.h"
#include "tools/end_signals.h"

namespace {

using nord_driver::sim::RunningBus;
using nord_driver::sim::SimConfig;
using namespace nord_driver::tools;

YAML::Node readFiles(const std::vector<std::string>& files) {
  YAML::Node merged;
  for (const std::string& file : files) {
    try {
      std::error_code unknown;
      std::string why = std::filesystem::is_directory(file, unknown) ? "it is a folder" : "";
      const YAML::Node node = why.empty() ? YAML::LoadFile(file) : YAML::Node{};
      if (why.empty()) why = nord_driver::whyNotWalkable(node);
      if (why.empty() && !node.IsMap() && !node.IsNull()) why = "it has no keys";
      if (!why.empty()) {
        throw nord_driver::sim::ConfigError("--config " + file + ": " + why + ", expected groups of keys and values");
      }
      merged = nord_driver::sim::mergeYaml(merged, nord_driver::withKeysMerged(node, "--config " + file));
    } catch (const YAML::Exception& error) {
      throw nord_driver::sim::ConfigError("--config " + file + ": " + error.what() + "; expected a readable YAML file");
    }
  }
  return merged;
}

SimConfig readConfig(const YAML::Node& merged, const BusPort& port) {
  const nord_driver::sim::BusKind& kind = nord_driver::sim::busKindOf(merged);
  return nord_driver::sim::readSimConfig(merged, chosenPort(port, kind.transport, kind.end_point));
}

/// Waits until the end is asked for, or until `duration` (s) is over; 0 = no limit.
void waitForEnd(const std::atomic<bool>& end_asked, double duration) {
  constexpr std::chrono::milliseconds kLook{20};
  const auto begun = std::chrono::steady_clock::now();
  const std::chrono::duration<double> limit{duration};
  while (!end_asked && (duration <= 0.0 || std::chrono::steady_clock::now() - begun < limit)) {
    std::this_thread::sleep_for(kLook);
  }
}

/// s: how long a drive beside a simulator may be silent. A program is late now and then where an inverter is not; three cycles
/// and what the files themselves say are the least.
double patientDriveTimeout(const YAML::Node& files) {
  const auto number = [&files](const char* key, double fallback) { return files[key].as<double>(fallback); };
  const double rate = number("cycle_rate", 100.0);
  return std::max({0.25, number("drive_timeout", 0.0), rate > 0.0 ? 3.0 / rate : 0.0});
}

int run(int argc, char** argv) {
  namespace po = boost::program_options;
  std::vector<std::string> files;
  BusPort port;
  Seconds duration;
  bool place = false, drive_timeout = false;
  CommandLine line{"nord_sim", NORD_DRIVER_VERSION,
                   "Simulated NORD inverters: a PROFIBUS DP segment on a pseudo-terminal, CANopen or DeviceNet nodes "
                   "on a CAN bus, or an InterBus ring behind a Modbus TCP gateway.",
                   "Exit code: 0 ended when asked to, 1 wrong configuration or another error, 2 wrong usage."};
  line.setBrief("simulated NORD inverters on their bus, without ROS");
  line.addOptions()("config", po::value(&files)->value_name("FILE...")->multitoken()->required(),
                    "YAML file with bus, drives and body; a later file is laid over an earlier one; required")(
      "bus", po::value(&port.bus)->value_name("VALUE"),
      "where the bus is, in place of what the file says: where to put the link to the pseudo-terminal, or the CAN "
      "interface (can0, vcan0, virtual:NAME)")("device", po::value(&port.device)->value_name("PATH"),
                                               "the same for a bus with bus/device")(
      "interface", po::value(&port.interface)->value_name("NAME"), "the same for a bus with bus/interface")(
      "duration", po::value(&duration)->value_name("SECONDS"),
      "seconds to run; without it until SIGINT, SIGTERM or SIGHUP")(
      "place", po::bool_switch(&place),
      "print where a simulated bus of the files' transport can be, as a value of --bus, and end: simulate.launch puts "
      "simulator and driver there")("drive-timeout", po::bool_switch(&drive_timeout),
                                    "print the drive_timeout, in s, that simulate.launch gives the driver, and end");
  if (const auto code = line.parse(argc, argv)) return *code;

  const std::atomic<bool>& end_asked = catchEndSignals();
  const YAML::Node merged = readFiles(files);
  if (place) {
    std::fputs(nord_driver::sim::busKindOf(merged).place, stdout);  // roslaunch takes a line's end as part of it
    return kDone;
  }
  if (drive_timeout) {
    std::printf("%.4f", patientDriveTimeout(merged));
    return kDone;
  }
  const SimConfig config = readConfig(merged, port);
  for (const std::string& warning : config.warnings) std::fprintf(stderr, "nord_sim: %s\n", warning.c_str());
  const std::unique_ptr<RunningBus> bus = nord_driver::sim::runBus(config);
  std::printf("%s\n", bus->where().c_str());
  std::fflush(stdout);
  waitForEnd(end_asked, duration.value);
  std::printf("referee: %s\n", bus->refereeReport().c_str());
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const UsageError& error) {
    std::fprintf(stderr, "nord_sim: %s\n", error.what());
    return kWrongUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nord_sim: %s\n", error.what());
    return kFailed;
  }
}
