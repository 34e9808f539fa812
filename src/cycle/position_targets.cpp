#include "cycle/position_targets.h"

#include <cmath>

namespace nord_driver::cycle {

using drive::TargetRefusal;
using Kind = AskedPosition::Kind;

namespace {

// Beside the numbers of TargetRefusal.
constexpr int kTaken = 0, kNotPut = -1;

}  // namespace

std::optional<AskedPosition> PositionTargets::poll(const PositionCommand& newest) noexcept {
  if (newest.number != taken_) {
    taken_ = newest.number;
    increments_taken_ = 0.0;
    // Those before it have no meaning any more.
    if (newest.increments == 0.0) increases_taken_ = newest.increased;
    if (newest.element) return AskedPosition{Kind::kElement, 0.0, *newest.element};
    return AskedPosition{Kind::kTarget, newest.target};
  }
  if (newest.increased == increases_taken_) return std::nullopt;
  const double increment = newest.increments - increments_taken_;
  increases_taken_ = newest.increased;
  increments_taken_ = newest.increments;
  return AskedPosition{Kind::kIncrement, increment};
}

std::optional<Sentence> PositionTargets::handleAnswer(const char* drive, const AskedPosition& asked,
                                                      TargetRefusal refusal, double at, Instant now) noexcept {
  refused_ = {};
  const char* const why = drive::toString(refusal);
  if (refusal == TargetRefusal::kNone) {
    told_ = kTaken;
    return std::nullopt;
  }
  if (asked.kind == Kind::kElement) {
    refused_.format("drive %s: P613[-%02u], %.3f revolutions or %.6g of the joint, is not taken: %s", drive,
                    unsigned{asked.element}, asked.raw / 1000.0, asked.value, why);
  } else if (asked.kind == Kind::kTarget) {
    refused_.format("drive %s: the target %.6g is not taken: %s", drive, asked.value, why);
  } else if (std::isfinite(at)) {
    refused_.format("drive %s: the increment %.6g, to %.6g, is not taken: %s", drive, asked.value, at, why);
  } else {
    refused_.format("drive %s: the increment %.6g is not taken: %s", drive, asked.value, why);
  }
  return tell(static_cast<int>(refusal), now);
}

std::optional<Sentence> PositionTargets::refuse(const Sentence& why, Instant now) noexcept {
  refused_ = why;
  return tell(kNotPut, now);
}

std::optional<Sentence> PositionTargets::tell(int reason, Instant now) noexcept {
  if (reason == told_ && now - told_at_ < kTellInterval) return std::nullopt;
  told_ = reason;
  told_at_ = now;
  return refused_;
}

}  // namespace nord_driver::cycle
