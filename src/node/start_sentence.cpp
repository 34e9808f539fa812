#include "node/start_sentence.h"

#include "config/driver_settings.h"

namespace nord_driver::node {

std::string startSentence(const NodeConfig& config, const std::vector<DriveIdentity>& identities,
                          const std::string& where) {
  std::string text = "transport " + shortTransportName(config.transport);
  if (!where.empty()) text += " at " + where;
  text += ", " + std::to_string(identities.size()) + (identities.size() == 1 ? " drive: " : " drives: ");
  for (std::size_t i = 0; i < identities.size(); ++i) {
    text += (i == 0 ? "" : ", ") + config.cycle.drives[i].name + " (" + identities[i].address + ")";
  }
  if (!config.cycle.base) {
    text += ", no base";
  } else {
    text += std::string(", base ") + robot::nameOf(config.cycle.base->kind);
  }
  if (config.cycle.acknowledge_bus_timeouts) {
    text += ", bus time-outs (E10) found at start are acknowledged (acknowledge_at_start)";
  }
  return text + (config.read_only ? ", looking on only (read_only)" : "");
}

}  // namespace nord_driver::node
