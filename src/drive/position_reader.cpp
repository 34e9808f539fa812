#include "drive/position_reader.h"

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
constexpr Duration kSpeedWindow = std::chrono::milliseconds{40};

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
  speed_ = 0.0;
  speed_from_ = {steps_, at_, at_};
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
  speed_ = 0.0;
  speed_from_ = {steps, now, now};
  believe(steps, now);
}

void PositionReader::believe(std::int64_t steps, Instant now) noexcept {
  doubtful_.reset();
  steps_ = steps;
  continued_ = true;
  at_ = now;
  if (now - speed_from_.at < kSpeedWindow) return;
  speed_ = static_cast<double>(steps - speed_from_.steps) / toSeconds(now - speed_from_.at);
  speed_from_ = {steps, now, now};
}

}  // namespace nord_driver::drive
