#include "trace/trace_config.h"

#include "config/setting_checks.h"

namespace nord_driver::trace {

TraceConfig readTraceConfig(const Settings& node) {
  constexpr std::int64_t kMaxKept = 100'000;
  TraceConfig config;
  config.directory = textOr(node, "trace_directory", "");
  config.keep =
      static_cast<std::size_t>(integerOr(node, "trace_keep", static_cast<std::int64_t>(config.keep), 1, kMaxKept));
  // Nobody expands "~" in a parameter, and the working directory of a node is anywhere.
  if (config.withFaults() && config.directory.front() != '/') {
    throw wrongSetting(node, "trace_directory", "\"" + config.directory + "\"",
                       "an absolute path, such as /home/robot/trace, or nothing (no trace)");
  }
  return config;
}

std::string directoryByHand(const char* ros_home, const char* home) {
  if (ros_home != nullptr && *ros_home != '\0') return ros_home;
  return home != nullptr && *home != '\0' ? std::string(home) + "/.ros" : "";
}

TraceConfig byHand(TraceConfig config, const char* ros_home, const char* home) {
  if (config.directory.empty()) config.directory = directoryByHand(ros_home, home);
  return config;
}

}  // namespace nord_driver::trace
