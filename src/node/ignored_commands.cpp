#include "node/ignored_commands.h"

#include <cmath>

#include "config/setting_checks.h"
#include "cycle/cycle_ports.h"

namespace nord_driver::node {

std::string whyIgnored(double command) {
  if (!std::isfinite(command)) return "is not a number, or infinite";
  const std::string most = shortNumber(cycle::CyclePorts::kMostIncrement);
  return "is " + shortNumber(command) + ", expected -" + most + " to " + most + " rad or m";
}

}  // namespace nord_driver::node
