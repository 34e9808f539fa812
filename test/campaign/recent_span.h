// What a value has been within some time.
#pragma once

#include <deque>
#include <utility>

#include "nord_driver/core/time.h"

namespace nord_driver::test {

/// From the least to the most of a value.
struct Span {
  double least = 0.0;
  double most = 0.0;
};

class RecentSpan {
 public:
  void add(Instant now, Span value);
  void forget() { values_.clear(); }
  bool empty() const noexcept { return values_.empty(); }
  /// Since `from`, what was so at that time included.
  Span since(Instant from);

 private:
  std::deque<std::pair<Instant, Span>> values_;  // from when on
};

}  // namespace nord_driver::test
