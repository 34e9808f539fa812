#include "rules/dependency_rules.h"

#include <regex>
#include <set>
#include <sstream>

namespace nord_driver::rules {
namespace {

using Names = std::set<std::string>;

const std::string kManifest = "package.xml";
const std::string kInstaller = "scripts/install_deps.sh";
const std::string kCmake = "CMakeLists.txt and cmake/";
const std::string kTable = "test/rules/dependency_rules.cpp";

// What every use of the pattern has in its last group.
void collect(const std::string& text, const std::regex& pattern, std::size_t group, Names& names) {
  for (std::sregex_iterator use(text.begin(), text.end(), pattern), end; use != end; ++use) {
    std::istringstream words((*use)[group]);
    for (std::string word; words >> word;) names.insert(word);
  }
}

std::string withoutHashComments(const std::string& text) {
  static const std::regex kComment("#[^\n]*");
  return std::regex_replace(text, kComment, "");
}

Names inManifest(const std::string& text) {
  static const std::regex kDepend("<(\\w*depend)( [^>]*)?>([^<]+)</");
  Names names;
  collect(text, kDepend, 3, names);
  return names;
}

Names inInstaller(const std::string& text) {
  static const std::regex kPackages("(^|\n)packages=\\(([^)]*)\\)");
  Names names;
  collect(withoutHashComments(text), kPackages, 2, names);
  return names;
}

void addCmakeNames(const std::string& text, Names& names) {
  static const std::regex kPackage("find_package\\(\\s*([\\w-]+)");
  static const std::regex kComponents("find_package\\([^)]*COMPONENTS([^)]*)\\)");
  static const std::regex kLibrary("find_library\\(\\s*\\w+\\s+([\\w-]+)");
  const std::string code = withoutHashComments(text);
  collect(code, kPackage, 1, names);
  collect(code, kComponents, 1, names);
  collect(code, kLibrary, 1, names);
}

void compare(const std::string& file, const Names& found, const Names& expected, Violations& violations) {
  for (const std::string& name : expected) {
    if (found.count(name) == 0) violations.push_back(file + ": " + name + " is missing, " + kTable + " expects it");
  }
  for (const std::string& name : found) {
    if (expected.count(name) == 0) violations.push_back(file + ": " + name + " is not in the table of " + kTable);
  }
}

}  // namespace

const std::vector<Dependency>& dependencies() {
  static const std::vector<Dependency> kDependencies{
      {"", {"build-essential", "cmake"}, {"Threads"}},
      {"", {"librapidcheck-dev"}, {"rapidcheck"}},  // optional: older distributions have none
      {"", {}, {"control_msgs"}},                   // optional: Debian has none
      {"catkin", {"catkin"}, {"catkin"}},
      {"diagnostic_msgs", {"ros-core-dev", "python3-diagnostic-msgs"}, {"diagnostic_msgs"}},
      {"diagnostic_updater", {"libdiagnostic-updater-dev"}, {"diagnostic_updater"}},
      {"dynamic_reconfigure",
       {"libdynamic-reconfigure-config-init-mutex-dev", "python3-dynamic-reconfigure"},
       {"dynamic_reconfigure"}},
      {"gencpp", {"ros-core-dev"}, {"gencpp"}},
      {"geometry_msgs", {"ros-core-dev", "python3-geometry-msgs"}, {"geometry_msgs"}},
      {"google-mock", {"libgmock-dev"}, {}},
      {"gtest", {"libgtest-dev"}, {}},
      {"libboost-program-options-dev", {"libboost-program-options-dev"}, {"Boost", "program_options"}},
      {"libmodbus-dev", {"libmodbus-dev"}, {"modbus"}},
      {"liburdfdom-dev", {"liburdfdom-dev"}, {"urdfdom"}},
      {"liburdfdom-headers-dev", {"liburdfdom-headers-dev"}, {"urdfdom_headers"}},
      {"message_generation", {"ros-core-dev"}, {"message_generation"}},
      {"message_runtime", {"ros-core-dev"}, {}},
      {"nav_msgs", {"ros-core-dev", "python3-nav-msgs"}, {"nav_msgs"}},
      {"pluginlib", {"pluginlib-dev"}, {"pluginlib"}},
      {"robot_state_publisher", {"ros-robot-state-publisher"}, {}},
      {"rosbag", {"python3-rosbag"}, {}},
      {"rosbash", {"rosbash"}, {}},
      {"roscpp", {"ros-core-dev"}, {"roscpp"}},
      {"rosgraph_msgs", {"ros-core-dev"}, {}},
      {"roslaunch", {"ros-core-dev"}, {}},
      {"roslib", {"ros-core-dev"}, {"roslib"}},
      {"rospy", {"python3-rospy"}, {}},
      {"rostest", {"librostest-dev", "python3-rostest"}, {"rostest"}},
      {"sensor_msgs", {"ros-core-dev"}, {"sensor_msgs"}},
      {"std_msgs", {"ros-core-dev"}, {"std_msgs"}},
      {"std_srvs", {"ros-core-dev", "python3-std-srvs"}, {"std_srvs"}},
      {"tf2", {"libtf2-dev"}, {"tf2"}},
      {"tf2_msgs", {"libtf2-ros-dev"}, {}},
      {"tf2_ros", {"libtf2-ros-dev"}, {"tf2_ros"}},
      {"trajectory_msgs", {"ros-core-dev"}, {"trajectory_msgs"}},
      {"yaml-cpp", {"libyaml-cpp-dev"}, {"yaml-cpp"}},
  };
  return kDependencies;
}

Violations checkDependencies(const std::vector<SourceFile>& files, const std::vector<Dependency>& table) {
  Names manifest, installer, cmake;
  for (const SourceFile& file : files) {
    if (file.path == kManifest) manifest = inManifest(file.text);
    if (file.path == kInstaller) installer = inInstaller(file.text);
    const bool is_cmake = endsWith(file.path, "CMakeLists.txt") || endsWith(file.path, ".cmake");
    const bool for_tests_only = startsWith(file.path, "fuzz/") || startsWith(file.path, "bench/") ||
                                startsWith(file.path, "test/plugins/loopback/");  // a package of its own
    if (is_cmake && !for_tests_only) addCmakeNames(file.text, cmake);
  }
  Names keys, packages, found;
  for (const Dependency& dependency : table) {
    if (!dependency.key.empty()) keys.insert(dependency.key);
    packages.insert(dependency.packages.begin(), dependency.packages.end());
    found.insert(dependency.cmake.begin(), dependency.cmake.end());
  }
  Violations violations;
  compare(kManifest, manifest, keys, violations);
  compare(kInstaller, installer, packages, violations);
  compare(kCmake, cmake, found, violations);
  return violations;
}

}  // namespace nord_driver::rules
