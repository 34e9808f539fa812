// Where traces are written and how many are kept.
#pragma once

#include <cstddef>
#include <string>

#include "nord_driver/config/settings.h"

namespace nord_driver::trace {

struct TraceConfig {
  std::string directory;  ///< absolute; empty: none is configured
  std::size_t keep = 20;  ///< traces; the oldest of more are removed

  bool withFaults() const noexcept { return !directory.empty(); }
};

/// Where a trace goes that was asked for by hand while none is configured: ROS's own folder, `ros_home` ($ROS_HOME), or
/// ".ros" below `home` ($HOME). Either may be nullptr; empty when both are, or are empty.
std::string directoryByHand(const char* ros_home, const char* home);

/// Of a trace that is asked for by hand: `config`, with directoryByHand() where it has no directory.
TraceConfig byHand(TraceConfig config, const char* ros_home, const char* home);

/// `trace_directory` and `trace_keep`. Throws ConfigError.
TraceConfig readTraceConfig(const Settings& node);

}  // namespace nord_driver::trace
