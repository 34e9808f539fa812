// Why the script of a start-up runs once more although every step of it was done. What it finds as it should be it leaves,
// so that this takes a tenth of a second. Each reason counts from the last time the node came, went, or was refused.
#pragma once

#include <cstdint>
#include <utility>

namespace nord_driver::canopen {

class ScriptRepeats {
 public:
  /// There were answers nobody had asked for: one of them may have been taken. Once.
  bool forSurplus() noexcept { return !std::exchange(surplus_, true); }
  void forgetSurplus() noexcept { surplus_ = false; }
  /// Answers were missing: the node may have begun anew meanwhile, and its boot-up been lost, too. On a line on which each
  /// run has some it is started all the same.
  bool forMissed() noexcept {
    if (missed_ == kMostForMissed) return false;
    ++missed_;
    return true;
  }
  /// It was started, and does not say that it is operational, perhaps for the same reason. Once.
  bool forStart() noexcept { return !std::exchange(started_, true); }
  bool started() const noexcept { return started_; }

 private:
  static constexpr std::uint8_t kMostForMissed = 2;

  bool surplus_ = false;
  bool started_ = false;
  std::uint8_t missed_ = 0;
};

}  // namespace nord_driver::canopen
