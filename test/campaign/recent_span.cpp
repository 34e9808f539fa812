#include "campaign/recent_span.h"

#include <algorithm>

namespace nord_driver::test {

void RecentSpan::add(Instant now, Span value) {
  const bool same =
      !values_.empty() && values_.back().second.least == value.least && values_.back().second.most == value.most;
  if (!same) values_.emplace_back(now, value);
}

Span RecentSpan::since(Instant from) {
  while (values_.size() > 1 && values_[1].first <= from) values_.pop_front();
  Span all = values_.front().second;
  for (const auto& [since, value] : values_) {
    all.least = std::min(all.least, value.least);
    all.most = std::max(all.most, value.most);
  }
  return all;
}

}  // namespace nord_driver::test
