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
    foreign_.reset();
    end_ = now + time_;
    listening_ = time_ > Duration::zero();
  }
  /// `certain`: no noise.
  void handleForeign(std::uint8_t master, bool certain, Instant now) noexcept {
    if (!listening_) return;
    if (certain) foreign_ = master;
    end_ = now + time_;
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
  Duration time_;
  bool listening_ = false;
  Instant end_{};
  std::optional<std::uint8_t> foreign_;
};

}  // namespace nord_driver::profibus
