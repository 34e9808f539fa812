#include "node/recovery_hint.h"

namespace nord_driver::node {

std::string recoveryHint(const cycle::CycleSnapshot& snapshot, const std::vector<std::string>& drive_names) {
  if (!snapshot.connected) return "bring the bus back (see \"bus\"), then ~enable";
  for (std::size_t i = 0; i < drive_names.size(); ++i) {
    if (!snapshot.drives[i].online) {
      return "bring drive " + drive_names[i] + " back (see \"drive " + drive_names[i] + "\"), then ~enable";
    }
  }
  for (std::size_t i = 0; i < drive_names.size(); ++i) {
    if (snapshot.drives[i].fault_number == 0 && !snapshot.drives[i].fault_latched) continue;
    return "remove the cause (see \"drive " + drive_names[i] + "\"), then ~acknowledge_faults, then ~enable";
  }
  return "~enable";
}

}  // namespace nord_driver::node
