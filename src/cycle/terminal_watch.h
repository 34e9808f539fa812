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
  kHeld,          ///< OFF2 or OFF3 that is not ours keeps it from becoming ready: status bit 4 or 5 = 0
  kLocalControl,  ///< status bit 9 = 0: the terminals have the say, and may turn the motor at any time
  kTurned,        ///< it had come to rest, and was enabled past this driver
};

/// What is to be told, and what was told before.
struct TerminalNews {
  TerminalFinding finding;
  TerminalFinding before;
};

/// Looks at one drive while it is disabled here, or on its way down: its digital inputs, and the bus I/O bits of P480, can start it all the
/// same (BU 0220 5.1.2, BU 0280 5.1.2).
class TerminalWatch {
 public:
  static constexpr int kNearStandstill = 164;  ///< |actual value 1|, of 16384
  /// A contact that flickers is told once in this time.
  static constexpr Duration kTellInterval = std::chrono::seconds{1};
  /// Bits 4 and 5 may follow our own last word, which the inverter has left behind by then: idle says OFF1.
  static constexpr Duration kHeldFor = std::chrono::milliseconds{500};

  /// Once a cycle, with what the drive has just said.
  void update(const drive::DriveReport& report, Instant now) noexcept {
    if (!report.online) *this = TerminalWatch{};
    const bool idle = report.phase == drive::Phase::kIdle || report.phase == drive::Phase::kAcknowledging ||
                      report.phase == drive::Phase::kSwitchingSet;
    // On the way down it is not enabled any more; one that had come to rest before turns by somebody else still.
    const bool goes_down = report.phase == drive::Phase::kStopping || report.phase == drive::Phase::kQuickStopping ||
                           report.phase == drive::Phase::kCoasting;
    const bool local = !profile::StatusWord{report.status_word}.busControl();
    // In vain it may be enabled meanwhile, or trip: nobody has released it.
    const bool held_on = finding_ == TerminalFinding::kHeld && !local && isHeld(report);
    if (!report.online || (!idle && !goes_down)) {
      rested_ = false;
      if (held_on) return;
      held_since_.reset();
      finding_ = TerminalFinding::kNone;
      return;
    }
    const bool turns =
        report.state == profile::DriveState::kOperationEnabled || std::abs(int{report.speed}) > kNearStandstill;
    // What a stop has left of a motion is not somebody else's.
    rested_ = rested_ || (idle && !turns);
    if (!held_on && (!idle || local || !isHeldBack(report))) {
      held_since_.reset();
    } else if (!held_since_) {
      held_since_ = now;
    }
    const bool held = held_since_ && now - *held_since_ >= kHeldFor;
    finding_ = rested_ && turns ? TerminalFinding::kTurned
               : local          ? TerminalFinding::kLocalControl
               : held           ? TerminalFinding::kHeld
                                : TerminalFinding::kNone;
  }
  TerminalFinding finding() const noexcept { return finding_; }

  /// The finding when it is to be told: at once when it is worse than what was told within kTellInterval, else after it.
  std::optional<TerminalNews> poll(Instant now) noexcept {
    if (now >= due_) worst_ = told_;
    if (finding_ == told_ || (now < due_ && finding_ <= worst_)) return std::nullopt;
    const TerminalNews news{finding_, told_};
    told_ = finding_;
    if (finding_ > worst_) worst_ = finding_;
    due_ = now + kTellInterval;
    return news;
  }

 private:
  static bool isHeldBack(const drive::DriveReport& report) noexcept {
    const bool not_ready = report.state == profile::DriveState::kSwitchOnDisabled ||
                           report.state == profile::DriveState::kNotReadyToSwitchOn;
    return not_ready && isHeld(report);
  }
  static bool isHeld(const drive::DriveReport& report) noexcept {
    const profile::StatusWord status{report.status_word};
    return !status.voltageEnabled() || !status.quickStopInactive();
  }

  std::optional<Instant> held_since_;
  bool rested_ = false;
  TerminalFinding finding_ = TerminalFinding::kNone;
  TerminalFinding told_ = TerminalFinding::kNone;
  TerminalFinding worst_ = TerminalFinding::kNone;  // of what was told until due_
  Instant due_{};
};

}  // namespace nord_driver::cycle
