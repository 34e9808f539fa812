// Of a dump only what somebody has changed since the factory.
#pragma once

#include <vector>

#include "tools/parameter_dump.h"

namespace nord_driver::tools {

struct ChangedDump {
  Dump dump;  ///< settings that deviate from the factory setting; no information
  /// Settings whose factory setting the catalogue does not know: nobody can tell, and they are not in `dump`.
  std::vector<catalogue::ParameterAddress> unknown;
};

ChangedDump changedOnly(const Dump& whole, const catalogue::DriveCatalogue& known);

/// As dumpText(), with what is not in it named in a comment.
std::string changedText(const ChangedDump& changed, const catalogue::DriveCatalogue& known, const std::string& drive,
                        const std::string& address);

}  // namespace nord_driver::tools
