// How fast a drive may be at most: as fast as was allowed within the time a stop needs to reach it, less the ramp since.
// On the way of a base from one command to another each wheel is between its speeds of the two.
#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

#include "campaign/moment.h"

namespace nord_driver::test {

class SpeedBound {
 public:
  /// After each cycle, `dt` s after the one before. `allowed`: Hz, what users want now; `cut`: the exchange is
  /// interrupted, it may follow new commands until the time-outs act; `on_the_way`: how long it may take to another command.
  void look(const Moment& moment, bool cut, double allowed, double ramp, double dt, Duration on_the_way = {}) {
    if (!cut) cut_since_.reset();
    if (cut && !cut_since_) cut_since_ = moment.now;
    const Instant heard = cut_since_.value_or(moment.now);
    allowed_now_ = moment.now <= heard + moment.reaction ? allowed : 0.0;
    // The same again: what was allowed last for so long.
    if (!allowed_.empty() && allowed_.back().second == allowed_now_) allowed_.pop_back();
    allowed_.emplace_back(heard, allowed_now_);
    while (allowed_.size() > kRemembered) allowed_.pop_front();
    double recent = 0.0;
    for (const auto& [from, value] : allowed_) {
      if (moment.now <= from + moment.reaction + on_the_way) recent = std::max(recent, value);
    }
    bound_ = std::max(recent, bound_ - ramp * dt);
  }
  /// Somebody else moves it, or nobody.
  void raise(double speed) { bound_ = std::max(bound_, speed); }

  double value() const noexcept { return bound_; }             ///< Hz
  double allowedNow() const noexcept { return allowed_now_; }  ///< Hz

 private:
  static constexpr std::size_t kRemembered = 600;  // changes, one in a cycle at most: longer than any reaction

  std::deque<std::pair<Instant, double>> allowed_;  // when the drive could hear it, Hz
  std::optional<Instant> cut_since_;
  double bound_ = 0.0;
  double allowed_now_ = 0.0;
};

}  // namespace nord_driver::test
