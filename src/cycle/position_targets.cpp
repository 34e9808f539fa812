#include "cycle/position_targets.h"

namespace nord_driver::cycle {

using drive::TargetRefusal;

std::optional<double> PositionTargets::poll(const PositionCommand& newest) noexcept {
  if (newest.number == taken_) return std::nullopt;
  taken_ = newest.number;
  return newest.target;
}

std::optional<Sentence> PositionTargets::handleAnswer(const char* drive, double target, TargetRefusal refusal,
                                                      Instant now) noexcept {
  refused_ = {};
  if (refusal == TargetRefusal::kNone) {
    told_ = refusal;
    return std::nullopt;
  }
  refused_.format("drive %s: the target %.6g is not taken: %s", drive, target, drive::toString(refusal));
  if (refusal == told_ && now - told_at_ < kTellInterval) return std::nullopt;
  told_ = refusal;
  told_at_ = now;
  return refused_;
}

}  // namespace nord_driver::cycle
