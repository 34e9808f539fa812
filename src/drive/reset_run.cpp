#include "drive/reset_run.h"

namespace nord_driver::drive {

void ResetRun::start(Instant now, Duration hold, Duration timeout) noexcept {
  stage_ = Stage::kHigh;
  since_.reset();
  hold_ = hold;
  until_ = now + timeout;
}

bool ResetRun::handleAnswer(bool is_new, Instant now) noexcept {
  if (stage_ == Stage::kNone) return false;
  if (!since_) since_ = now;
  if (now - *since_ < hold_) return false;
  if (stage_ == Stage::kHigh) {
    stage_ = Stage::kLow;
    since_.reset();
    return false;
  }
  if (!is_new) return false;
  end();
  return true;
}

}  // namespace nord_driver::drive
