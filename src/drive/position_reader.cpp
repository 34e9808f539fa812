#include "drive/position_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace nord_driver::drive {

namespace {

// The telegrams of a module lag behind by its own cycles, now more, now less; an encoder trembles.
constexpr double kMargin = 1.5;
constexpr double kLag = 0.05;    // s
constexpr double kSlack = 20.0;  // steps
// Less than the 65 536 steps that two halves of different moments are away.
constexpr double kMost = 32'768.0;
// A first value and those that agree with it.
constexpr Duration kFirst = std::chrono::milliseconds{20};
// What the motor can do at most in a window: one of them is the 1 % that counts as standstill, with a little to spare.
constexpr double kStepsInWindow = 102.0;

bool isPossible(std::int64_t from, std::int64_t to, double max_speed, Duration dt) noexcept {
  const double allowed = max_speed * kMargin * (toSeconds(dt) + kLag) + kSlack;
  const double distance = std::fabs(static_cast<double>(to - from));
  return distance <= (allowed < kMost ? allowed : kMost);
}

// The count nearest to `last` whose low 16 bits are these.
std::int64_t continued(std::int64_t last, std::int32_t word) noexcept {
  const auto difference =
      static_cast<std::uint16_t>(static_cast<std::uint64_t>(word) - static_cast<std::uint64_t>(last));
  return last + static_cast<std::int16_t>(difference);
}

Duration windowFor(double max_speed) noexcept {
  const Duration fine = seconds(std::min(kStepsInWindow / max_speed, toSeconds(PositionReader::kLongestWindow)));
  return std::max(fine, PositionReader::kShortestWindow);
}

}  // namespace

void PositionReader::handleGap() noexcept {
  known_ = false;
  jumped_ = false;
  doubtful_.reset();
  speed_ = 0.0;
}

void PositionReader::handleValues(const profile::PositionField& field, const profile::ProcessValues& words,
                                  double max_speed, Instant now) noexcept {
  jumped_ = false;
  if (!field.carried()) return handleGap();
  window_ = windowFor(max_speed);
  const std::int32_t word = profile::getPosition(field, words);
  const double unseen = toSeconds(now - std::exchange(seen_, now));
  const std::int64_t value = field.bits == 16 && continued_ ? continued(steps_, word) : word;
  // A count of 16 bits that does not go on from the last one has begun anew: it is what its word is.
  const std::int64_t new_count = known_ ? word : value;
  // What goes on from a value that was held back came with it, and had no more time to come.
  const Instant came = goesOnFromDoubtful(new_count, max_speed, now) ? doubtful_->since : now;
  if (known_ && isPossible(steps_, value, max_speed, came - at_)) return believe(value, now);
  // Unseen for so long it may have gone further than two halves are apart: the last value tells nothing about this one.
  if (known_ && max_speed * kMargin * unseen > kMost) handleGap();
  doubt(known_ ? new_count : value, max_speed, now);
}

void PositionReader::handleNewZero(const profile::PositionField& field) noexcept {
  if (!known_) return;
  if (field.bits == 16) steps_ = static_cast<std::int16_t>(static_cast<std::uint64_t>(steps_));
  measureFrom(steps_, at_);
}

bool PositionReader::goesOnFromDoubtful(std::int64_t steps, double max_speed, Instant now) const noexcept {
  return doubtful_ && isPossible(doubtful_->steps, steps, max_speed, now - doubtful_->at);
}

void PositionReader::doubt(std::int64_t steps, double max_speed, Instant now) noexcept {
  const bool agrees = goesOnFromDoubtful(steps, max_speed, now);
  doubtful_ = Value{steps, now, agrees ? doubtful_->since : now};
  if (!agrees) return;
  if (now - doubtful_->since < (known_ ? kConfirm : kFirst)) return;
  jumped_ = known_;
  known_ = true;
  measureFrom(steps, now);
  believe(steps, now);
}

void PositionReader::believe(std::int64_t steps, Instant now) noexcept {
  doubtful_.reset();
  steps_ = steps;
  continued_ = true;
  at_ = now;
  if (now - samples_.front().at >= kShortestWindow) measure();
}

void PositionReader::measureFrom(std::int64_t steps, Instant at) noexcept {
  speed_ = 0.0;
  samples_.fill({steps, at});
}

// Before a whole window has passed a step may be a flicker; more than one is a motion already.
void PositionReader::measure() noexcept {
  const auto whole = std::find_if(samples_.begin(), samples_.end(),
                                  [this](const Sample& sample) { return at_ - sample.at >= window_; });
  const Sample& from = whole != samples_.end() ? *whole : samples_.back();
  const std::int64_t distance = steps_ - from.steps;
  const bool told = whole != samples_.end() || std::abs(distance) > 1;
  speed_ = told ? static_cast<double>(distance) / toSeconds(at_ - from.at) : 0.0;
  std::move_backward(samples_.begin(), samples_.end() - 1, samples_.end());
  samples_.front() = {steps_, at_};
}

}  // namespace nord_driver::drive
