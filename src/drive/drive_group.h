// Drives that stand or fall together: the wheels of a base, or one drive alone. All are enabled or none; when one
// stops, the others are brought to rest.
//
// Owns no drive. Each cycle: every member's handleInput(), then update(), then every member's pollOutput(). The layer
// above follows commands while commandAllowed(), and ramps its setpoint down to zero while wantsZeroRamp().
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "drive/drive.h"
#include "drive/stop_way.h"
#include "nord_driver/core/time.h"

namespace nord_driver::drive {

struct GroupConfig {
  /// Bounds the way down: the zero ramp with OFF1 after it, then quick stop; and the others' own ramp after one has
  /// stopped.
  Duration shutdown_timeout = seconds(10.0);
  /// With the setpoint at zero: how long to wait for standstill before OFF1 takes over the ramp (P104 > 0 never lets it
  /// come). On the others' own ramp it counts from where they get no slower.
  Duration standstill_timeout = seconds(1.0);
  /// |actual value 1| that counts as near standstill, of 16384.
  std::int16_t near_standstill = 164;
  StopWays ways;
};

enum class GroupPhase : std::uint8_t {
  kDisabled,
  kEnabling,
  kEnabled,
  kRampingDown,    ///< disable asked: 047F, the setpoint comes down from above
  kHalting,        ///< a member stopped: the others at setpoint 0 on their own ramp
  kStopping,       ///< OFF1 on all, or OFF2
  kQuickStopping,  ///< OFF3 on all
};

/// It is being brought to rest.
constexpr bool isOnWayDown(GroupPhase phase) noexcept {
  return phase != GroupPhase::kDisabled && phase != GroupPhase::kEnabling && phase != GroupPhase::kEnabled;
}

/// The answer to requestEnable(), or what ended an enabling.
struct GroupRefusal {
  Refusal refusal = Refusal::kNone;
  std::size_t member = 0;  ///< who refused
  bool accepted() const noexcept { return refusal == Refusal::kNone; }
};

struct GroupReport {
  GroupPhase phase = GroupPhase::kDisabled;
  /// Why the group stopped by itself or by quick stop, since it was last enabled; the first cause stays.
  StopCause stop_cause = StopCause::kNone;
  std::size_t stop_member = 0;  ///< the member that stopped first
  GroupRefusal refusal;         ///< of the last enabling
};

class DriveGroup {
 public:
  /// Members must outlive the group. Throws std::invalid_argument when there is none, or a null one.
  explicit DriveGroup(std::vector<Drive*> members, const GroupConfig& config = GroupConfig());

  /// Asks every member first; enables all, or none. What ends the enabling later stands in report().refusal.
  GroupRefusal requestEnable(Instant now) noexcept;
  void requestDisable(Instant now) noexcept;
  void requestQuickStop(Instant now) noexcept;
  /// From the layer above, each cycle: a velocity command is there and not too old. One that was followed and has grown
  /// old stops the group in the way chosen; before the first there is nothing to stop.
  void commandIsFresh(bool fresh, Instant now) noexcept;
  /// From the layer above: the setpoint it hands to the members has reached zero.
  void setpointIsZero(bool zero) noexcept { setpoint_is_zero_ = zero; }

  void update(Instant now) noexcept;

  /// All members are enabled and nothing stops them: the velocity command may be followed.
  bool commandAllowed() const noexcept { return report_.phase == GroupPhase::kEnabled; }
  /// Disable was asked for: hand the members a setpoint that ramps down to zero.
  bool wantsZeroRamp() const noexcept { return report_.phase == GroupPhase::kRampingDown; }
  /// Disabled, and every member confirms rest by its state (or is offline: nothing reaches it).
  bool settled() const noexcept;

  /// Counts each stop that was asked for or began, of a disabled group as well: a fault, OFF2, OFF3 or local control of
  /// a member stops what turns past the group.
  std::uint32_t stops() const noexcept { return stops_; }
  /// A fault, OFF2, OFF3 or local control stands at a member. One that is no longer heard keeps its last word.
  bool stopStands() const noexcept;

  const GroupReport& report() const noexcept { return report_; }
  std::size_t size() const noexcept { return members_.size(); }

 private:
  void enter(GroupPhase phase, Instant now) noexcept;
  void disableOnWayDown(Instant now) noexcept;
  /// A fault, OFF2, OFF3 or local control has come to a member.
  bool stopBegan() noexcept;
  bool haltIfAMemberStopped(Instant now) noexcept;
  void updateEnabling(Instant now) noexcept;
  void updateRampingDown(Instant now) noexcept;
  void updateHalting(Instant now) noexcept;
  /// The time of the way down is over: all are stopped by OFF3.
  bool quickStopWhenOverdue(Instant now) noexcept;
  void updateStopping() noexcept;
  void stop(StopWay way, StopCause cause, Instant now) noexcept;
  void haltTheOthers(Instant now) noexcept;
  void shutdownAll(StopCause cause, Instant now) noexcept;
  void coastAll(StopCause cause, Instant now) noexcept;
  void quickStopAll(StopCause cause, Instant now) noexcept;
  bool quickStopTheRest(Instant now) noexcept;
  void latch(StopCause cause, std::size_t member) noexcept;
  /// All its members go to positions: a setpoint of zero stops none of them.
  bool onlyPositions() const noexcept;
  bool isHoming() const noexcept;
  bool nearStandstill() const noexcept;
  bool getsSlower(Instant now) noexcept;

  std::vector<Drive*> members_;
  GroupConfig config_;
  GroupReport report_;
  Instant phase_since_{};
  Instant down_since_{};        // since when a way down is on: its bound runs over several phases
  bool bound_runs_on_ = false;  // of a way down that was asked for, into the halt behind it
  Instant zero_since_{};
  std::uint32_t stops_ = 0;
  std::vector<Word> heard_;  // the status word of each member in the last cycle
  int halting_speed_ = 0;    // the least so far, of all that halt together
  Instant slower_since_{};
  StopCause down_for_ = StopCause::kNone;  // why its members are ramped down; asked for, there is nothing to tell
  bool setpoint_is_zero_ = false;
  bool zero_seen_ = false;
  bool followed_ = false;  // a fresh command, since the group is enabled
};

}  // namespace nord_driver::drive
