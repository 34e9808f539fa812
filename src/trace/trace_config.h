// Where traces are written and how many are kept.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "nord_driver/config/settings.h"

namespace nord_driver::trace {

struct TraceConfig {
  std::string directory;  ///< absolute
  std::size_t keep = 20;  ///< traces; the oldest of more are removed
};

/// Where a trace goes that was asked for by hand while none is configured: ROS's own folder, `ros_home` ($ROS_HOME), or
/// ".ros" below `home` ($HOME). Either may be nullptr; empty when both are, or are empty.
std::string directoryByHand(const char* ros_home, const char* home);

/// `trace_directory` and `trace_keep`; nothing when the directory is empty or absent. Throws ConfigError.
std::optional<TraceConfig> readTraceConfig(const Settings& node);

}  // namespace nord_driver::trace
