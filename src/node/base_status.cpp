#include "node/base_status.h"

#include "node/recovery_hint.h"

namespace nord_driver::node {

using diagnostic_msgs::DiagnosticStatus;

void reportBase(const cycle::CycleSnapshot& snapshot, const std::vector<std::string>& names, bool sideways,
                std::uint64_t ignored, diagnostic_updater::DiagnosticStatusWrapper& status) {
  const cycle::BaseSnapshot& base = snapshot.base;
  if (base.stopped) {
    status.summary(DiagnosticStatus::ERROR, base.text.str());
    status.add("to go on", recoveryHint(snapshot, names));
  } else if (base.enabled) {
    status.summary(DiagnosticStatus::OK, base.waits.empty() ? "enabled" : "enabled: " + base.waits.str());
  } else if (base.commanded) {
    status.summary(DiagnosticStatus::WARN, "disabled, while cmd_vel asks for a motion: send zero, then call ~enable");
  } else {
    status.summary(DiagnosticStatus::OK, base.text.empty() ? "disabled" : base.text.str());
  }
  status.add("linear velocity (m/s)", base.velocity.linear_x);
  if (sideways) status.add("velocity to the left (m/s)", base.velocity.linear_y);
  status.add("angular velocity (rad/s)", base.velocity.angular_z);
  status.add("commands ignored", ignored);
}

}  // namespace nord_driver::node
