// What one drive may be told, judged from outside: by the words on the wire, and by what was asked. It knows nothing of
// the phases of Drive but whether one runs.
#pragma once

#include "drive/drive.h"
#include "explore/drive_members.h"
#include "profile/status_word.h"

namespace nord_driver::explore {

class DriveWatch {
 public:
  /// `rests`: P104 > 0 is accepted, so that OFF1 at a velocity of zero is no stop.
  explicit DriveWatch(bool rests) : rests_(rests) {}

  /// An enable was accepted of a drive that did not run.
  void enableAccepted(const drive::DriveReport& report, Verdict& verdict) {
    const profile::StatusWord status(report.status_word);
    verdict.require(report.online, "an enable was accepted of a drive that is not there");
    verdict.require(!fault_seen_ && !status.fault(), "an enable was accepted after a fault nobody acknowledged");
    verdict.require(status.busControl(), "an enable was accepted under local control");
    permit_ = Permit::kEnabling;
    idle_sent_ = ready_seen_ = enable_sent_ = zero_only_ = false;
    asked_ = 0;
  }
  void stopped() { permit_ = Permit::kNone; }
  void zeroAsked() {
    if (permit_ == Permit::kEnabling || rests_) permit_ = Permit::kNone;
    zero_only_ = true;
  }
  void quickStopAsked() {
    permit_ = Permit::kNone;
    quick_stop_due_ = true;
  }
  void acknowledged() { fault_seen_ = false; }
  /// "operation enabled" was reached, and nothing has ended it.
  bool runs() const { return permit_ == Permit::kRunning; }

  /// A telegram to the drive. `online`: it is heard.
  void checkOutput(const profile::ProcessOutput& output, bool online, Verdict& verdict) {
    const Word word = output.control_word;
    const bool enables = (word & 0x040Fu) == 0x040Fu;
    verdict.require(!enables || permit_ != Permit::kNone, "047F without an enable newer than the last cause to stop");
    verdict.require(!enables || ready_seen_, "047F before 047E was answered by \"ready to switch on\"");
    verdict.require(output.setpoints[0] == 0 || (enables && permit_ == Permit::kRunning && !zero_only_),
                    "a setpoint although nothing may move");
    verdict.require(!online || (word & 0x0400u) != 0, "zeros to a drive that is there");
    verdict.require((word & 0x0400u) == 0 || (word & 0x0006u) != 0, "OFF2 and OFF3 in one word");
    verdict.require((word & 0x0080u) == 0 || fault_now_, "an acknowledge bit without a fault");
    const bool stops = (word & 0x043Fu) == 0x043Bu || (word & 0x043Fu) == 0x043Du || (word & 0x0400u) == 0;
    verdict.require(!quick_stop_due_ || stops, "a quick stop asked for is not in the next word");
    quick_stop_due_ = false;
    if (permit_ == Permit::kEnabling && (word & 0x043Fu) == 0x043Eu) idle_sent_ = true;
    if (enables) enable_sent_ = true;
    set_sent_ = profile::parameterSet(word);
  }

  /// What the drive says; before the Drive hears it.
  void heard(profile::StatusWord status) {
    using profile::DriveState;
    fault_now_ = status.fault();
    fault_seen_ = fault_seen_ || fault_now_;
    silent_ = 0;
    if (fault_now_ || !status.busControl() || status.parameterSet() != set_sent_) return stopped();
    const DriveState state = status.state();
    const bool upwards = state == DriveState::kReadyToSwitchOn || state == DriveState::kSwitchedOn ||
                         state == DriveState::kOperationEnabled;
    if (permit_ == Permit::kRunning && !(rests_ ? upwards : state == DriveState::kOperationEnabled)) return stopped();
    if (permit_ != Permit::kEnabling) return;
    if (enable_sent_ && !upwards) return stopped();
    if (idle_sent_ && state == DriveState::kReadyToSwitchOn) ready_seen_ = true;
    if (ready_seen_ && (rests_ || (enable_sent_ && state == DriveState::kOperationEnabled))) permit_ = Permit::kRunning;
  }
  /// It says nothing, for `count` ticks.
  void silence(int count) {
    silent_ = std::min(silent_ + count, kDriveTimeout + 1);
    if (silent_ > kDriveTimeout) lost();
  }
  void lost() {
    fault_now_ = false;
    stopped();
  }

  /// After a cycle of `passed` ticks.
  void checkReport(const drive::DriveReport& report, int passed, Verdict& verdict) {
    const bool runs = drive::isEnabled(report.phase) || report.phase == drive::Phase::kEnabling ||
                      report.phase == drive::Phase::kHoldingZero;
    if (report.phase == drive::Phase::kEnabling) {
      // Silence is waited for before anything else.
      verdict.require(asked_ <= kEnableTimeout + kDriveTimeout, "an enable has no end");
      asked_ = std::min(asked_ + passed, kEnableTimeout + kDriveTimeout + 1);
      was_enabling_ = true;
      return;
    }
    verdict.require(!was_enabling_ || runs || report.refusal != drive::Refusal::kNone,
                    "an enable came to nothing, and nobody was told");
    was_enabling_ = false;
    if (!runs) stopped();
  }

  void describe(Key& key) const {
    key.add(permit_).add(quick_stop_due_).add(fault_now_).add(fault_seen_).add(was_enabling_);
    key.add(static_cast<std::uint8_t>(silent_)).add(static_cast<std::uint8_t>(was_enabling_ ? asked_ : 0));
    if (permit_ == Permit::kEnabling) key.add(idle_sent_).add(ready_seen_).add(enable_sent_).add(set_sent_);
    if (permit_ == Permit::kRunning) key.add(zero_only_).add(set_sent_);
  }

 private:
  enum class Permit : std::uint8_t { kNone, kEnabling, kRunning };

  bool rests_;
  Permit permit_ = Permit::kNone;
  bool idle_sent_ = false, ready_seen_ = false, enable_sent_ = false;  // since the enable
  bool zero_only_ = false, quick_stop_due_ = false;
  bool fault_now_ = false, fault_seen_ = false;
  bool was_enabling_ = false;
  std::uint8_t set_sent_ = 1;
  int asked_ = 0;   // ticks since the enable
  int silent_ = 0;  // ticks since it was heard
};

}  // namespace nord_driver::explore
