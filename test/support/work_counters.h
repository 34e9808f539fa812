// Which counters of bus_status count what is done, not what goes wrong.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace nord_driver::test {

inline bool countsWork(std::string_view name) {
  constexpr std::array<std::string_view, 4> kWork{"cycles", "telegrams_sent", "telegrams_received", "exchanges"};
  return std::find(kWork.begin(), kWork.end(), name) != kWork.end();
}

}  // namespace nord_driver::test
