// Whether something besides this driver has a say in a drive that it has not enabled.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>

#include "drive/drive_report.h"
#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

enum class TerminalFinding : std::uint8_t {
  kNone,
  kLocalControl,  ///< status bit 9 = 0: the terminals have the say, and may turn the motor at any time
  kTurned,        ///< it had come to rest, and was enabled past this driver
};

/// Looks at one drive while it is disabled here, or on its way down: its digital inputs, and the bus I/O bits of P480, can start it all the
/// same (BU 0220 5.1.2, BU 0280 5.1.2).
class TerminalWatch {
 public:
  static constexpr int kNearStandstill = 164;  ///< |actual value 1|, of 16384
  /// A contact that flickers is told once in this time.
  static constexpr Duration kTellInterval = std::chrono::seconds{1};

  /// Once a cycle, with what the drive has just said.
  void update(const drive::DriveReport& report) noexcept {
    if (!report.online) *this = TerminalWatch{};
    const bool idle = report.phase == drive::Phase::kIdle || report.phase == drive::Phase::kAcknowledging ||
                      report.phase == drive::Phase::kSwitchingSet;
    // On the way down it is not enabled any more; one that had come to rest before turns by somebody else still.
    const bool goes_down = report.phase == drive::Phase::kStopping || report.phase == drive::Phase::kQuickStopping ||
                           report.phase == drive::Phase::kCoasting;
    if (!report.online || (!idle && !goes_down)) {
      rested_ = false;
      finding_ = TerminalFinding::kNone;
      return;
    }
    const bool turns =
        report.state == profile::DriveState::kOperationEnabled || std::abs(int{report.speed}) > kNearStandstill;
    // What a stop has left of a motion is not somebody else's.
    rested_ = rested_ || (idle && !turns);
    const bool local = !profile::StatusWord{report.status_word}.busControl();
    finding_ = rested_ && turns ? TerminalFinding::kTurned
               : local          ? TerminalFinding::kLocalControl
                                : TerminalFinding::kNone;
  }
  TerminalFinding finding() const noexcept { return finding_; }

  /// The finding when it is to be told: at once when it is worse than what was told within kTellInterval, else after it.
  std::optional<TerminalFinding> poll(Instant now) noexcept {
    if (now >= due_) worst_ = told_;
    if (finding_ == told_ || (now < due_ && finding_ <= worst_)) return std::nullopt;
    told_ = finding_;
    if (finding_ > worst_) worst_ = finding_;
    due_ = now + kTellInterval;
    return finding_;
  }

 private:
  bool rested_ = false;
  TerminalFinding finding_ = TerminalFinding::kNone;
  TerminalFinding told_ = TerminalFinding::kNone;
  TerminalFinding worst_ = TerminalFinding::kNone;  // of what was told until due_
  Instant due_{};
};

}  // namespace nord_driver::cycle
