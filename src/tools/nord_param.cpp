// nord_param: parameters of the inverters on the command line, over the bus itself, without a roscore.
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include "core/version.h"
#include "nord_driver/config/settings.h"
#include "tools/command_line.h"
#include "tools/commands/commands.h"
#include "tools/over_ros/ros_drive_nodes.h"
#include "tools/usage_error.h"

namespace {

using namespace nord_driver::tools;

constexpr char kAbout[] =
    "Reads and writes parameters of NORD inverters with the driver's configuration file: over the bus, without ROS, as "
    "its master while it runs; or, while the driver runs, through the driver's node.";

constexpr char kFooter[] =
    "A node of the driver that runs on this machine and has the bus is found by itself (stderr says so), any other one "
    "is "
    "named with --node: the node carries out what is asked, and refuses in its own words what cannot be done while a "
    "drive moves. Without a node this program opens the bus.\n"
    "It moves nothing and stops nothing: a drive that is not at rest is left as it is, and the command refused. One at "
    "rest gets the idle word 047E, the other drives of the bus get nothing. No watchdog runs and no node is guarded "
    "meanwhile, so that the end of the program trips nothing; a drive with P513 > 0 trips all the same, and is named.\n"
    "A serial device somebody else has is refused, and half a second is listened for another master. On "
    "CANopen a drive that runs without a master and sends nothing is not heard, and is stopped by the start-up of its "
    "node.\n"
    "restore writes what a drive can lose without being lost itself. What the bus reaches it by (address, baud rate, "
    "P509) is left out unless --with-bus-settings is given; what fits one machine may move another: read the plan.\n"
    "Exit code: 0 done, 1 refused, failed or different, 2 wrong usage or configuration. check-config judges one: 1 "
    "when "
    "it is refused.";

int run(int argc, char** argv) {
  CommandLine line{"nord_param", nord_driver::kVersion, kAbout, kFooter};
  line.setBrief("parameters of NORD inverters over their bus, without ROS");
  line.offer("SET", {"1", "2", "3", "4"});
  ParamProgram program{line};
  RosDriveNodes nodes;
  program.reachThrough(nodes);
  const std::vector<std::unique_ptr<ParamCommand>> commands = paramCommands();
  std::vector<std::pair<const Command*, ParamCommand*>> words;
  words.reserve(commands.size());
  for (const auto& command : commands) words.emplace_back(&command->addTo(line), command.get());
  if (const auto code = line.parse(argc, argv)) return *code;
  for (const auto& [asked, command] : words) {
    if (line.asksFor(*asked)) return command->run(program);
  }
  return kWrongUsage;  // parse() has refused it
}

// What was printed may be somebody's only copy of a drive.
int printed(int exit_code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  std::fputs("nord_param: not all of it could be printed: the disk is full, or nobody reads it any more\n", stderr);
  return exit_code == kDone ? kFailed : exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // whoever reads may go; the bus is left in order all the same
  try {
    return printed(run(argc, argv));
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
