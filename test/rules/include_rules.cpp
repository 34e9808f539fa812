#include "rules/include_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace nord_driver::rules {
namespace {

using Names = std::set<std::string>;

/// What every transport may use beside the engine and the link of its bus.
Names transportWith(const Names& own) {
  Names names{"core", "config", "profile", "transport", "trace/telegram_trace"};
  names.insert(own.begin(), own.end());
  return names;
}

/// The same for the far ends of the simulator.
Names simulatorWith(const Names& own) {
  Names names{"core", "sim", "sim/inverter", "sim/robot", "link"};
  names.insert(own.begin(), own.end());
  return names;
}

/// The table: what a layer may use beside itself. A layer is a folder, or a sub-folder that has a row of its own, or a
/// single file that has one. "sim/*" is sim and all rows below it; "*" is everything.
const std::map<std::string, Names>& table() {
  static const std::map<std::string, Names> kTable{
      {"core", {}},
      {"profile", {"core"}},
      {"profibus", {"core"}},
      {"canopen", {"core"}},
      {"devicenet", {"core"}},
      {"interbus", {"core"}},
      {"link", {"core"}},
      {"link/serial", {"core", "link", "link/serial/lock_owner"}},
      {"link/serial/lock_owner", {"core"}},  // which process has a device: for the programs, too
      {"link/can", {"core", "link"}},
      {"link/modbus", {"core", "link"}},
      {"state", {"core"}},
      {"config", {"core", "profile"}},
      {"catalogue", {"core", "config", "profile"}},
      {"robot", {"core"}},
      {"trace/telegram_trace", {"core"}},  // the ring a transport fills: below the transports
      {"transport", transportWith({})},
      {"transport/profibus", transportWith({"profibus", "link", "link/serial"})},
      {"transport/can", transportWith({"link", "link/can"})},  // what transports on a CAN bus share
      {"transport/canopen", transportWith({"canopen", "link", "link/can", "transport/can"})},
      {"transport/devicenet", transportWith({"devicenet", "link", "link/can", "transport/can"})},
      {"transport/interbus", transportWith({"interbus", "link", "link/modbus"})},
      {"drive", {"core", "profile"}},
      {"cycle", {"core", "config", "profile", "transport", "robot", "drive"}},
      {"commissioning", {"core", "config", "profile", "transport", "robot", "drive", "cycle", "catalogue"}},
      {"trace", {"core", "config", "profile", "transport", "cycle", "trace/telegram_trace"}},
      {"plugins", {"core", "transport/*"}},
      {"sim", {"core", "link", "sim/inverter", "sim/robot"}},
      {"sim/bus_kinds", {"core", "sim/*"}},  // the table of buses
      {"sim/inverter", {"core", "sim"}},
      {"sim/robot", {"core", "sim", "sim/inverter"}},
      {"sim/profibus", simulatorWith({"link/serial"})},
      {"sim/can", simulatorWith({"link/can"})},  // what every protocol on CAN needs of its bus
      {"sim/canopen", simulatorWith({"link/can", "sim/can"})},
      {"sim/devicenet", simulatorWith({"link/can", "sim/can"})},
      {"sim/interbus", simulatorWith({"link/modbus"})},
      {"sim_node", {"core", "sim", "ros_support"}},
      {"tools",
       {"core", "link/serial/lock_owner", "state", "config", "catalogue", "commissioning", "profile", "transport",
        "robot", "drive", "cycle", "sim", "node/node_config"}},
      {"tools/nord_param", {"core", "config", "tools/commands", "tools", "tools/over_ros"}},
      {"tools/restore",
       {"core", "config", "link/serial/lock_owner", "state", "catalogue", "profile", "cycle", "tools"}},
      {"tools/over_ros",  // the way through a running node
       {"core", "config", "catalogue", "profile", "transport", "link/modbus", "link/serial/lock_owner", "tools"}},
      {"tools/commands",  // of nord_param, one file each
       {"core", "config", "link/serial/lock_owner", "catalogue", "commissioning", "profile", "transport", "robot",
        "drive", "cycle", "node/node_config", "tools/*"}},
      {"node/node_config",  // what a file says, for the node and for the programs
       {"core", "config", "profile", "transport", "robot", "drive", "cycle", "trace", "node/late_protection"}},
      {"node/late_protection", {"core", "config", "transport"}},  // what of it is warned of
      {"node",
       {"core", "state", "config", "catalogue", "commissioning", "profile", "transport", "robot", "drive", "cycle",
        "trace/*", "tools", "node/node_config", "node/late_protection", "ros_support"}},
      {"system", {"*"}},                             // tests of the whole stack, without ROS
      {"explore", {"*"}},                            // every order of events, at one object or few
      {"campaign", {"*"}},                           // generated faults, on every bus
      {"process_campaign", {"*"}},                   // the same with real processes
      {"support", {"core", "config", "transport"}},  // what tests of several folders share
      {"ros_support", {}},                           // the same for those with ROS
      {"rostest", {"*"}},                            // the programs as their users meet them
      {"socketcan", {"rostest"}},                    // tests of link/ and of the nodes that need a kernel with CAN
      {"documents", {"*"}},                          // what documents say of the code
      {"rules", {}},
  };
  return kTable;
}

/// What only one bus needs, or only one kind of link: no file knows two of a set, tests included.
bool areApart(const std::string& layer, const std::string& used) {
  static const std::array<Names, 2> kApart{{{"profibus", "canopen", "devicenet", "interbus"}, {"serial", "can"}}};
  const auto last = [](const std::string& name) { return name.substr(name.rfind('/') + 1); };
  const std::string one = last(layer), other = last(used);
  return one != other && std::any_of(kApart.begin(), kApart.end(), [&](const Names& names) {
           return names.count(one) != 0 && names.count(other) != 0;
         });
}

const Names kPure{"core", "profile", "profibus", "canopen", "devicenet", "interbus", "robot", "drive"};
const Names kWithRos{"node",           "sim_node", "plugins",          "tools",
                     "tools/over_ros", "rostest",  "process_campaign", "ros_support"};
const Names kForEveryTest{"sim", "link", "core", "support"};
const Names kProgramTests{"node", "tools"};  // those of the programs bring a bus of their own
const Names kThreads{"thread", "mutex", "shared_mutex", "condition_variable", "future"};

struct Place {
  bool is_test = false;
  std::string folder;  ///< "transport/canopen"; empty: outside the table's folders
  std::string layer;   ///< the row of the table it falls under; empty: there is none
};

std::string folderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string{} : path.substr(0, slash);
}

/// The first folder of a layer: "transport" of "transport/canopen".
std::string groupOf(const std::string& layer) {
  return layer.substr(0, layer.find('/'));
}

/// The nearest row above a path without its root: "transport/canopen/canopen.h" -> "transport/canopen".
std::string rowOf(const std::string& path) {
  std::string name = path.substr(0, path.rfind('.'));
  while (!name.empty() && table().count(name) == 0) name = folderOf(name);
  return name;
}

Place placeOf(const std::string& path) {
  for (const char* root : {"include/nord_driver/", "src/", "test/"}) {
    if (!startsWith(path, root)) continue;
    const std::string inside = path.substr(std::string{root}.size());
    if (folderOf(inside).empty()) return {};
    return {startsWith(path, "test/"), folderOf(inside), rowOf(inside)};
  }
  return {};
}

bool isGeneratedMessage(const std::string& header) {
  const std::vector<std::string> parts = partsOf(header);
  return parts.size() == 2 && parts[0] == "nord_driver" && std::isupper(static_cast<unsigned char>(parts[1][0])) != 0;
}

bool isRos(const std::string& header) {
  static const Names kFolders{"actionlib",
                              "bond",
                              "class_loader",
                              "diagnostic_updater",
                              "dynamic_reconfigure",
                              "message_filters",
                              "nodelet",
                              "pluginlib",
                              "ros",
                              "rosbag",
                              "rosconsole",
                              "roscpp",
                              "rosgraph",
                              "roslib",
                              "rostest",
                              "tf",
                              "topic_tools",
                              "urdf",
                              "xmlrpcpp"};
  const std::vector<std::string> parts = partsOf(header);
  if (isGeneratedMessage(header) || startsWith(header, "XmlRpc")) return true;
  if (parts.size() < 2) return false;
  const std::string& folder = parts[0];
  return kFolders.count(folder) != 0 || startsWith(folder, "tf2") || endsWith(folder, "_msgs") ||
         endsWith(folder, "_srvs");
}

/// A header of the C++ standard library has neither folder nor ending.
bool isStandard(const std::string& header) {
  return header.find_first_of("./") == std::string::npos;
}

/// Which row a header falls under; its first folder when that has none; empty when it is not ours. `own` is the
/// including file's layer.
std::string layerOf(const std::string& header, bool quoted, const std::string& own) {
  const std::vector<std::string> parts = partsOf(header);
  const bool installed = parts.size() >= 3 && parts[0] == "nord_driver";
  if (!installed && !quoted) return {};
  if (parts.size() == 1) return own;
  const std::string inside = installed ? header.substr(header.find('/') + 1) : header;
  const std::string row = rowOf(inside);
  return row.empty() && installed ? parts[1] : row;
}

/// Tests may use what their layer may, the layer itself, helpers of its folder and the simulated far end; the
/// simulator's own tests, like the simulator, stay away from the driver.
bool mayUse(const Place& place, const std::string& used) {
  if (used == place.layer) return true;
  if (areApart(place.layer, used)) return false;
  const std::string group = groupOf(used);
  if (place.is_test && place.layer == "plugins" && group == "rostest") return true;  // one of its own
  if (place.is_test && (kProgramTests.count(place.layer) != 0 || group == place.layer)) return true;
  if (place.is_test && place.layer != "rules" && kForEveryTest.count(group) != 0) return true;
  const Names& row = table().at(place.layer);
  return row.count("*") != 0 || row.count(used) != 0 || row.count(group + "/*") != 0;
}

std::string reasonAgainst(const Place& place, const std::string& header, bool quoted) {
  if (header.find("..") != std::string::npos) return "goes up by '..'; name the header from its root";
  // rostest is a package of ROS and a folder of ours.
  const bool own_rostest = quoted && startsWith(header, "rostest/");
  if (isRos(header) && !own_rostest) {
    return kWithRos.count(place.layer) != 0 ? "" : "is ROS, which " + place.layer + "/ must not know";
  }
  const std::string used = layerOf(header, quoted, place.layer);
  if (!used.empty()) {
    if (table().count(used) == 0) return "lies in a folder without a row in the table of layers";
    return mayUse(place, used) ? "" : "is of " + used + "/, which " + place.layer + "/ must not use";
  }
  if (place.is_test || kPure.count(place.layer) == 0) return {};
  if (kThreads.count(header) != 0) return "is about threads; " + place.layer + "/ is handed everything, time included";
  const bool urdf = place.layer == "robot" && (startsWith(header, "urdf_parser/") || startsWith(header, "urdf_model/"));
  return isStandard(header) || urdf ? "" : "is no header of the standard library; " + place.layer + "/ uses no other";
}

std::string callAgainst(const std::string& line) {
  for (const char* call :
       {"::now(", "sleep_for", "sleep_until", "usleep(", "nanosleep", "clock_gettime", "gettimeofday"}) {
    if (line.find(call) != std::string::npos) return call;
  }
  return {};
}

void checkFile(const SourceFile& file, const Place& place, Violations& violations) {
  static const std::regex kInclude(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
  const std::vector<std::string> lines = linesOf(withoutComments(file.text));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string where = file.path + ":" + std::to_string(i + 1) + ": ";
    std::smatch match;
    if (std::regex_search(lines[i], match, kInclude)) {
      const std::string reason = reasonAgainst(place, match[2], match[1] == "\"");
      if (!reason.empty()) violations.push_back(where + match[2].str() + " " + reason);
    }
    const std::string call = kPure.count(place.layer) != 0 ? callAgainst(lines[i]) : std::string{};
    if (!call.empty()) violations.push_back(where + call + " asks a clock or waits; time is an argument here");
  }
}

}  // namespace

Violations checkIncludes(const std::vector<SourceFile>& files) {
  Violations violations;
  std::size_t read = 0;
  for (const SourceFile& file : files) {
    const Place place = placeOf(file.path);
    if (!isCpp(file) || place.folder.empty()) continue;
    ++read;
    // A row of its own for every folder, so that a new bus's does not go by what its neighbours may.
    if (place.layer.empty() || (!place.is_test && table().count(place.folder) == 0)) {
      violations.push_back(file.path + ": the folder " + place.folder + "/ has no row in the table of layers");
    } else {
      checkFile(file, place, violations);
    }
  }
  if (read == 0) violations.emplace_back("no C++ file under include/nord_driver, src and test");
  return violations;
}

}  // namespace nord_driver::rules
