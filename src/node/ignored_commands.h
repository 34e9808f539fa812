// Commands that are no numbers, infinite or too large: how many there were, and when it is time to say so again.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/core/time.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::node {

/// What is wrong with a command of a drive that was not taken, to be written behind its name. Of those that are numbers
/// only an increment may be too large.
std::string whyIgnored(double command);

/// At most one line in a second, by the steady clock: with /use_sim_time and nobody on /clock that of ROS stands still.
class LogPause {
 public:
  /// Whether a line is due at `now`; then the next one is due a second later.
  bool isOver(Instant now) noexcept {
    if (last_ && now - *last_ < std::chrono::seconds{1}) return false;
    last_ = now;
    return true;
  }

 private:
  std::optional<Instant> last_;
};

/// By any thread.
class IgnoredCommands {
 public:
  explicit IgnoredCommands(std::size_t drives) : drives_(drives) {}

  /// One more for the base, or for a drive. How many of its kind to tell of now; none: a line was written just now.
  std::optional<std::uint64_t> addToBase(Instant now) { return add(base_, now); }
  std::optional<std::uint64_t> add(DriveIndex drive, Instant now) { return add(drives_[drive], now); }

  std::uint64_t ofBase() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return base_.count;
  }
  std::uint64_t of(DriveIndex drive) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return drives_[drive].count;
  }

 private:
  struct Kind {
    std::uint64_t count = 0;
    LogPause pause;
  };

  std::optional<std::uint64_t> add(Kind& kind, Instant now) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++kind.count;
    return kind.pause.isOver(now) ? std::optional<std::uint64_t>{kind.count} : std::nullopt;
  }

  mutable std::mutex mutex_;
  Kind base_;
  std::vector<Kind> drives_;
};

}  // namespace nord_driver::node
