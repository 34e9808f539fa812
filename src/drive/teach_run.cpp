#include "drive/teach_run.h"

namespace nord_driver::drive {

void TeachRun::start(Instant now, Duration hold, Duration timeout) noexcept {
  stage_ = Stage::kTeachIn;
  since_.reset();
  hold_ = hold;
  until_ = now + timeout;
}

TeachBits TeachRun::bits() const noexcept {
  return {stage_ == Stage::kTeachIn || stage_ == Stage::kQuit || stage_ == Stage::kTeachInAfter,
          stage_ == Stage::kQuit};
}

bool TeachRun::handleAnswer(Instant now) noexcept {
  if (stage_ == Stage::kNone) return false;
  if (!since_) since_ = now;
  if (now - *since_ < hold_) return false;
  since_.reset();
  switch (stage_) {
    case Stage::kNone:
    case Stage::kTeachIn:
      stage_ = Stage::kQuit;
      break;
    case Stage::kQuit:
      stage_ = Stage::kTeachInAfter;
      break;
    case Stage::kTeachInAfter:
      stage_ = Stage::kLow;
      break;
    case Stage::kLow:
      end();
  }
  return !isRunning();
}

}  // namespace nord_driver::drive
