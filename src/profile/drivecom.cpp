#include "profile/drivecom.h"

namespace nord_driver::profile {

DrivecomOutput DrivecomScaling::toDrivecom(const ProcessOutput& output) const noexcept {
  const auto words = velocity_mode_.toCia402(output);
  if (!words) return {};
  return {words->control_word, words->target_velocity};
}

ProcessInput DrivecomScaling::fromDrivecom(const DrivecomInput& input) const noexcept {
  return velocity_mode_.fromCia402({input.status_word, input.actual_speed});
}

}  // namespace nord_driver::profile
