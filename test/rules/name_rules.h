// The rule that the layers above the transports name no bus.
#pragma once

#include <string>
#include <vector>

#include "rules/source_tree.h"

namespace nord_driver::rules {

/// A line that may name a bus, and why.
struct NamedBus {
  std::string path;
  std::string text;    ///< part of the line
  std::string reason;  ///< for whoever reads the list
};

/// This project's.
const std::vector<NamedBus>& namedBuses();

/// No line of a C++ file below src/cycle, src/drive and src/node holds the name of a bus, in capitals or not, but for
/// the lines in `allowed`: a bus that is added must need no change there.
Violations checkBusNames(const std::vector<SourceFile>& files, const std::vector<NamedBus>& allowed);

}  // namespace nord_driver::rules
