// Listens before it lets its master talk: two masters that do not know each other ruin every telegram.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::profibus {

/// Silent for `time` from the beginning, and for as long again from every telegram of another master, or what may be
/// one. Once over, it stays over until `restart()`. A time of 0 does not listen.
class ListenFirst {
 public:
  explicit ListenFirst(Duration time) noexcept : time_(time) {}

  void restart(Instant now) noexcept {
    drawChance(now);
    foreign_.reset();
    gave_way_ = false;
    longer_ = Duration::zero();
    end_ = now + time_;
    listening_ = time_ > Duration::zero();
  }
  /// Likewise, because another master was heard after it was over. Two that listen for the same time begin in the same moment,
  /// again and again: who has hardly begun when it gives way once more listens for up to twice the time, by chance.
  void giveWay(Instant now) noexcept {
    const bool met_again = gave_way_ && now - end_ < time_;
    restart(now);
    gave_way_ = true;
    if (!met_again) return;
    longer_ = time_ / kShares * static_cast<int>((chance_ >> 33) % kShares);
    end_ += longer_;
  }
  /// `certain`: no noise.
  void handleForeign(std::uint8_t master, bool certain, Instant now) noexcept {
    if (!listening_) return;
    if (certain) foreign_ = master;
    end_ = now + time_ + longer_;
  }
  bool mayTalk(Instant now) noexcept {
    if (listening_ && now >= end_) listening_ = false;
    return !listening_;
  }

  bool isListening() const noexcept { return listening_; }
  Instant end() const noexcept { return end_; }
  /// Heard since the beginning.
  std::optional<std::uint8_t> foreign() const noexcept { return foreign_; }

 private:
  static constexpr int kShares = 1024;

  /// Every moment so far counts, so that who has met in one need not meet in the next.
  void drawChance(Instant now) noexcept {
    chance_ = (chance_ ^ static_cast<std::uint64_t>(now.time_since_epoch().count())) * 0xFF51AFD7ED558CCDu;
    chance_ ^= chance_ >> 33;
  }

  Duration time_;
  Duration longer_{};
  std::uint64_t chance_ = 0;
  bool listening_ = false;
  bool gave_way_ = false;
  Instant end_{};
  std::optional<std::uint8_t> foreign_;
};

}  // namespace nord_driver::profibus
