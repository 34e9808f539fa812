#include "drive/homing_run.h"

#include <algorithm>

namespace nord_driver::drive {

void HomingRun::start(Instant now, Duration timeout, Duration window) noexcept {
  running_ = true;
  settled_ = false;
  begun_ = false;
  quiet_since_.reset();
  quiet_ = std::max(kQuiet, window);
  until_ = now + timeout;
}

HomingRun::Outcome HomingRun::handleView(const HomingView& view, Instant now) noexcept {
  if (!running_) return Outcome::kGoesOn;
  settled_ = settled_ || (view.reached && view.still);
  begun_ = begun_ || !view.still || (settled_ && !view.reached);
  const bool quiet = begun_ && view.reached && view.still && !view.in_doubt && view.referenced.value_or(true);
  if (!quiet) quiet_since_.reset();
  if (quiet && !quiet_since_) quiet_since_ = now;
  Outcome outcome = Outcome::kGoesOn;
  if (now >= until_) outcome = Outcome::kTimedOut;
  if (quiet && now - *quiet_since_ >= quiet_) outcome = Outcome::kDone;
  if (outcome != Outcome::kGoesOn) running_ = false;
  return outcome;
}

}  // namespace nord_driver::drive
