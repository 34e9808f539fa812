#include <algorithm>

#include "sim/bus_kind.h"
#include "sim/canopen/can_config.h"
#include "sim/devicenet/dn_config.h"
#include "sim/interbus/ibs_config.h"
#include "sim/profibus/dp_config.h"

namespace nord_driver::sim {

namespace {

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// The one that the group's `transport` names; nullptr where it has none.
const BusKind* namedIn(const Group& group) {
  if (!group.has("transport")) return nullptr;
  std::string expected;
  for (const BusKind& kind : busKinds()) expected += (expected.empty() ? "" : ", ") + std::string{kind.transport};
  const BusKind* found = nullptr;
  group.get<std::string>("transport", "", "one of " + expected, [&found](const std::string& transport) {
    for (const BusKind& kind : busKinds()) {
      if (endsWith(transport, kind.transport)) found = &kind;
    }
    return found != nullptr;
  });
  return found;
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
  const BusKind* const named = namedIn(root);
  const BusKind* const below = namedIn(bus);
  if (named != nullptr) return *named;
  return below != nullptr ? *below : busKinds().front();
}

std::unique_ptr<RunningBus> runBus(const SimConfig& config) {
  const auto kind = std::find_if(busKinds().begin(), busKinds().end(),
                                 [&](const BusKind& candidate) { return config.bus.type() == *candidate.settings; });
  return (kind == busKinds().end() ? busKinds().front() : *kind).run(config);
}

}  // namespace nord_driver::sim
