// Tells the token of another master from three bytes of noise: a token has no checksum.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"
#include "profibus/bus_parameters.h"
#include "profibus/telegram.h"

namespace nord_driver::profibus {

/// A token is believed when the same one, from and to the same master, was seen before in the time a token takes to
/// come round: not before the first was sent, and in less than a second, which is long for a ring and rare for noise.
class TokenWatch {
 public:
  explicit TokenWatch(const BusParameters& bus) noexcept
      : least_(bus.baud.characters(kTokenLength) + bus.baud.bits(33)) {}

  /// The line was opened anew, or nothing can be said of what came before.
  void forget() noexcept { seen_[0] = seen_[1] = {}; }
  /// True when it is the token of a master. `whole`: nothing but telegrams came with it.
  bool believes(const Telegram& token, bool whole, Instant now) noexcept {
    if (!whole) return false;
    for (Seen& seen : seen_) {
      if (!seen.at || seen.da != token.da || seen.sa != token.sa) continue;
      const Duration since = now - *seen.at;
      if (since >= least_) seen.at = now;
      return since >= least_ && since <= kLongestRound;
    }
    seen_[1] = seen_[0];
    seen_[0] = {now, token.da, token.sa};
    return false;
  }

 private:
  static constexpr std::size_t kTokenLength = 3;
  static constexpr Duration kLongestRound = std::chrono::seconds{1};

  struct Seen {
    std::optional<Instant> at = {};
    std::uint8_t da = 0, sa = 0;
  };

  Duration least_;
  Seen seen_[2];  // two masters hand it to and fro
};

}  // namespace nord_driver::profibus
