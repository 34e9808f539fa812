#include "rules/include_rules.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace nord_driver::rules {
namespace {

using Names = std::set<std::string>;

/// The table: what a layer may use beside itself.
const std::map<std::string, Names>& table() {
  static const Names kTransport{"core",      "config",   "profile", "profibus", "canopen",
                                "devicenet", "interbus", "link",    "trace"};
  static const Names kTools{"core",     "config", "catalogue", "trace", "profile", "profibus", "canopen", "devicenet",
                            "interbus", "link",   "transport", "robot", "drive",   "cycle",    "sim",     "plugins"};
  static const Names kNode{"core",    "config",    "catalogue", "trace",   "profile",   "profibus",
                           "canopen", "devicenet", "interbus",  "link",    "transport", "robot",
                           "drive",   "cycle",     "sim",       "plugins", "tools",     "ros_support"};
  static const std::map<std::string, Names> kTable{
      {"core", {}},
      {"profile", {"core"}},
      {"profibus", {"core"}},
      {"canopen", {"core"}},
      {"devicenet", {"core"}},
      {"interbus", {"core"}},
      {"link", {"core"}},
      {"config", {"core", "profile"}},
      {"catalogue", {"core", "config", "profile"}},
      {"trace", {"core", "profile", "config", "transport", "cycle"}},
      {"robot", {"core"}},
      {"transport", kTransport},
      {"drive", {"core", "profile"}},
      {"cycle", {"core", "config", "profile", "drive", "transport", "robot"}},
      {"sim", {"core", "link"}},
      {"sim_node", {"core", "link", "sim", "ros_support"}},
      {"plugins", {"core", "transport"}},
      {"tools", kTools},
      {"node", kNode},
      {"system", kNode},                                // tests of the whole stack, without ROS
      {"support", {"core", "config", "transport"}},     // what tests of several folders share
      {"ros_support", {}},                              // the same for those with ROS
      {"rostest", {"node", "support", "ros_support"}},  // the programs as their users meet them
      {"socketcan", {"rostest"}},                       // tests of link/ and of the nodes that need a kernel with CAN
      {"rules", {}},
  };
  return kTable;
}

const Names kPure{"core", "profile", "profibus", "canopen", "devicenet", "interbus", "robot", "drive"};
const Names kWithRos{"node", "sim_node", "plugins", "tools", "rostest", "ros_support"};
const Names kForEveryTest{"sim", "link", "core", "support"};
const Names kThreads{"thread", "mutex", "shared_mutex", "condition_variable", "future"};

struct Place {
  bool is_test = false;
  std::string layer;  ///< empty: outside the table's folders
};

Place placeOf(const std::string& path) {
  const std::vector<std::string> parts = partsOf(path);
  if (parts.size() >= 4 && parts[0] == "include" && parts[1] == "nord_driver") return {false, parts[2]};
  if (parts.size() >= 3 && parts[0] == "src") return {false, parts[1]};
  if (parts.size() >= 3 && parts[0] == "test") return {true, parts[1]};
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

/// Which of our folders a header belongs to; empty when it is not ours. `own` is the including file's layer.
std::string layerOf(const std::string& header, bool quoted, const std::string& own) {
  const std::vector<std::string> parts = partsOf(header);
  if (parts.size() >= 3 && parts[0] == "nord_driver") return parts[1];
  if (!quoted) return {};
  if (parts.size() == 1) return own;
  return table().count(parts[0]) != 0 ? parts[0] : std::string{};
}

/// Tests may use what their layer may, the layer itself, helpers of its folder and the simulated far end; the
/// simulator's own tests, like the simulator, stay away from the driver.
bool mayUse(const Place& place, const std::string& used) {
  if (used == place.layer) return true;
  if (place.is_test && (place.layer == "node" || place.layer == "rostest")) return true;
  if (place.is_test && place.layer == "plugins" && used == "rostest") return true;  // one of its own
  if (place.is_test && place.layer != "rules" && kForEveryTest.count(used) != 0) return true;
  return table().at(place.layer).count(used) != 0;
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
    if (!isCpp(file) || place.layer.empty()) continue;
    ++read;
    if (table().count(place.layer) == 0) {
      violations.push_back(file.path + ": the folder " + place.layer + "/ has no row in the table of layers");
    } else {
      checkFile(file, place, violations);
    }
  }
  if (read == 0) violations.emplace_back("no C++ file under include/nord_driver, src and test");
  return violations;
}

}  // namespace nord_driver::rules
