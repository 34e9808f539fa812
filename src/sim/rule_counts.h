// How often each rule of a bus was broken: what every referee keeps and tells.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <numeric>
#include <string>

namespace nord_driver::sim {

/// What a referee reports who has nothing to report.
constexpr char kNoRuleBroken[] = "no rule broken";

/// `Rule`: an enumeration that ends with kCount; toString() has a sentence for each.
template <typename Rule>
class RuleCounts {
 public:
  void broken(Rule rule) noexcept { ++counts_[static_cast<std::size_t>(rule)]; }

  std::uint64_t count(Rule rule) const noexcept { return counts_[static_cast<std::size_t>(rule)]; }
  std::uint64_t total() const noexcept { return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0}); }
  bool content() const noexcept { return total() == 0; }
  /// "no rule broken", or each broken rule with its count, but those that are `left_out`.
  std::string report(std::initializer_list<Rule> left_out = {}) const {
    std::string text;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const auto rule = static_cast<Rule>(i);
      if (counts_[i] == 0 || std::find(left_out.begin(), left_out.end(), rule) != left_out.end()) continue;
      if (!text.empty()) text += "; ";
      text += std::to_string(counts_[i]) + " x " + toString(rule);
    }
    return text.empty() ? kNoRuleBroken : text;
  }
  void forget() noexcept { counts_.fill(0); }

 private:
  std::array<std::uint64_t, static_cast<std::size_t>(Rule::kCount)> counts_{};
};

}  // namespace nord_driver::sim
