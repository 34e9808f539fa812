// Whether an axis that goes by itself is still on the way it was sent.
#pragma once

#include <cmath>
#include <optional>

namespace nord_driver::drive {

/// Of a drive that is told the element of its array, and not the target: what it makes of the bits, its own manual says
/// (P610, BU 0510 and BU 0710 are not at hand). So it is watched: with no element chosen it stays where it is, and with
/// one it is between where it was and where the element is. An inverter that takes the bits for something else has left
/// that at once.
class PathGuard {
 public:
  /// It is to stay here. rad or m, as all of it.
  void hold(double at) noexcept { from_ = to_ = at; }
  /// From here to there. `braking`: how far it may go on the way it is on now before it turns round.
  void goTo(double from, double to, double braking) noexcept {
    from_ = std::fmin(from, to) - std::fabs(braking);
    to_ = std::fmax(from, to) + std::fabs(braking);
  }
  void forget() noexcept {
    from_.reset();
    to_.reset();
  }
  /// Farther than `margin` beside its way.
  bool isLeft(double position, double margin) const noexcept {
    return from_ && to_ && (position < *from_ - margin || position > *to_ + margin);
  }

 private:
  std::optional<double> from_;
  std::optional<double> to_;
};

}  // namespace nord_driver::drive
