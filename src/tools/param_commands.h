// The commands of nord_param: what each prints, and whether it worked.
#pragma once

#include <atomic>
#include <string>

#include "nord_driver/transport/transport.h"
#include "tools/parameter_dump.h"
#include "tools/parameter_link.h"
#include "tools/tool_config.h"

namespace nord_driver::tools {

struct WriteOptions {
  std::string value;  ///< as typed
  bool persistent = false;
  bool raw = false;
};

/// The address of NAME, --set and --index (0: not given). Throws UsageError when two of them contradict each other.
cycle::ParameterAddress addressOf(const std::string& name, int set, int index);

/// What can be known of a write before the bus is touched: throws UsageError when the value is none, or raw values
/// would be needed; Trouble when it is out of the catalogue's range.
cycle::ParameterWrite checkedWrite(const WriteOptions& write, const cycle::ParameterAddress& address,
                                   profile::Series series);

/// Of all drives of the configuration, whose `transport` is configured; sends nothing.
void printList(const ToolConfig& config, const Transport& transport);

// On a connected link; false: refused or different, and said so on stderr or stdout.
bool readParameter(ParameterLink& link, const cycle::ParameterAddress& address);
bool writeParameter(ParameterLink& link, const cycle::ParameterAddress& address, const cycle::ParameterWrite& write);
bool dumpParameters(ParameterLink& link, const std::atomic<bool>& end_asked);
bool compareParameters(ParameterLink& link, const Dump& reference, const std::atomic<bool>& end_asked);

}  // namespace nord_driver::tools
