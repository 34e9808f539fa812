#include <algorithm>

#include "sim/bus_kind.h"
#include "sim/canopen/can_config.h"
#include "sim/devicenet/dn_config.h"
#include "sim/interbus/ibs_config.h"
#include "sim/profibus/dp_config.h"

namespace nord_driver::sim {

namespace {

bool names(const Group& group, const BusKind& kind) {
  if (!group.has("transport")) return false;
  const std::string transport = group.get<std::string>("transport", "", "the name of a transport");
  const std::string end = kind.transport;
  return transport.size() >= end.size() && transport.compare(transport.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

// A new bus is one more line here and a folder of its own: doc/simulator.md, "Adding a bus".
const std::vector<BusKind>& busKinds() {
  static const std::vector<BusKind> kKinds{
      profibusKind(),
      canopenKind(),
      devicenetKind(),
      interbusKind(),
  };
  return kKinds;
}

const BusKind& busKindOf(const Group& root) {
  const Group bus(root.has("bus") ? root["bus"] : YAML::Node{}, "bus");
  const auto named = std::find_if(busKinds().begin(), busKinds().end(),
                                  [&](const BusKind& kind) { return names(root, kind) || names(bus, kind); });
  return named == busKinds().end() ? busKinds().front() : *named;
}

std::unique_ptr<RunningBus> runBus(const SimConfig& config) {
  const auto kind = std::find_if(busKinds().begin(), busKinds().end(),
                                 [&](const BusKind& candidate) { return config.bus.type() == *candidate.settings; });
  return (kind == busKinds().end() ? busKinds().front() : *kind).run(config);
}

}  // namespace nord_driver::sim
