// What decides on the behaviour of a DriveGroup, as bytes of a key.
#pragma once

#include "drive/drive_group.h"
#include "explore/two_wheels.h"

namespace nord_driver::explore {

NORD_EXPLORE_MEMBER(membersOf, drive::DriveGroup, members_)
NORD_EXPLORE_MEMBER(groupPhaseSinceOf, drive::DriveGroup, phase_since_)
NORD_EXPLORE_MEMBER(downSinceOf, drive::DriveGroup, down_since_)
NORD_EXPLORE_MEMBER(boundRunsOnOf, drive::DriveGroup, bound_runs_on_)
NORD_EXPLORE_MEMBER(zeroSinceOf, drive::DriveGroup, zero_since_)
NORD_EXPLORE_MEMBER(haltingSpeedOf, drive::DriveGroup, halting_speed_)
NORD_EXPLORE_MEMBER(slowerSinceOf, drive::DriveGroup, slower_since_)
NORD_EXPLORE_MEMBER(setpointIsZeroOf, drive::DriveGroup, setpoint_is_zero_)
NORD_EXPLORE_MEMBER(zeroSeenOf, drive::DriveGroup, zero_seen_)
NORD_EXPLORE_MEMBER(followedOf, drive::DriveGroup, followed_)

inline drive::GroupConfig groupConfig(const drive::StopWays& ways) {
  drive::GroupConfig config;
  config.shutdown_timeout = kShutdownTimeout * kTick;
  config.standstill_timeout = kStandstillTimeout * kTick;
  config.ways = ways;
  return config;
}

/// As describeDrive().
inline void describeGroup(const drive::DriveGroup& group, Instant now, Key& key) {
  using drive::GroupPhase;
  const auto since = [now](Instant when, int most) { return ticks(when, now, kTick, most + 1); };
  const GroupPhase phase = group.report().phase;
  key.add(phase).add(followedOf(group)).add(setpointIsZeroOf(group));
  if (phase == GroupPhase::kHalting) {
    key.add(since(groupPhaseSinceOf(group), kShutdownTimeout)).add(haltingSpeedOf(group));
    key.add(since(slowerSinceOf(group), kStandstillTimeout)).add(boundRunsOnOf(group));
    if (boundRunsOnOf(group)) key.add(since(downSinceOf(group), kShutdownTimeout));
  }
  if (phase == GroupPhase::kStopping || phase == GroupPhase::kRampingDown) {
    key.add(since(downSinceOf(group), kShutdownTimeout));
  }
  if (phase == GroupPhase::kRampingDown) {
    key.add(zeroSeenOf(group)).add(zeroSeenOf(group) ? since(zeroSinceOf(group), kStandstillTimeout) : std::uint8_t{0});
  }
}

}  // namespace nord_driver::explore
