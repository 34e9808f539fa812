// What decides on the behaviour of a Drive, as bytes of a key.
#pragma once

#include "drive/drive.h"
#include "explore/explorer.h"
#include "explore/private_member.h"

namespace nord_driver::explore {

NORD_EXPLORE_MEMBER(reportOf, drive::Drive, report_)
NORD_EXPLORE_MEMBER(phaseOf, drive::Drive, phase_)
NORD_EXPLORE_MEMBER(unansweredOf, drive::Drive, unanswered_)
NORD_EXPLORE_MEMBER(edgeOf, drive::Drive, edge_)
NORD_EXPLORE_MEMBER(missingOf, drive::Drive, missing_)
NORD_EXPLORE_MEMBER(lastUsefulOf, drive::Drive, last_useful_)
NORD_EXPLORE_MEMBER(edgeStageOf, drive::AcknowledgeEdge, stage_)
NORD_EXPLORE_MEMBER(edgeBegunOf, drive::AcknowledgeEdge, begun_)
NORD_EXPLORE_MEMBER(edgeAnswersOf, drive::AcknowledgeEdge, answers_)
NORD_EXPLORE_MEMBER(edgeSinceOf, drive::AcknowledgeEdge, since_)
NORD_EXPLORE_MEMBER(lastToldOf, drive::MissingInverter, last_told_)
NORD_EXPLORE_MEMBER(moduleBackOf, drive::MissingInverter, module_back_)

/// One tick is a bus cycle, and all time-outs are a few of them: the order of events and of time-outs is what counts.
constexpr Duration kTick = std::chrono::milliseconds{10};
constexpr int kDriveTimeout = 1, kEnableTimeout = 3, kShutdownTimeout = 3, kAcknowledgeTime = 1;

inline drive::DriveConfig driveConfig() {
  drive::DriveConfig config;
  config.joint.gear_ratio = 20.0;
  config.joint.pole_pairs = 2;
  config.max_frequency[0] = config.max_frequency[1] = Hertz{50.0};
  config.drive_timeout = kDriveTimeout * kTick;
  config.enable_timeout = kEnableTimeout * kTick;
  config.shutdown_timeout = kShutdownTimeout * kTick;
  config.acknowledge_time = kAcknowledgeTime * kTick;
  return config;
}

/// Left out: configuration, what is only told (velocities, causes by name), and what a phase does not look at.
inline void describeDrive(const drive::Drive& drive, Instant now, Key& key) {
  using drive::Phase;
  const drive::DriveReport& report = drive.report();
  const profile::StatusWord status(report.status_word);
  const auto since = [now](Instant when, int most) { return ticks(when, now, kTick, most + 1); };
  const auto since_told = [&](const std::optional<Instant>& when) {  // over its time is as good as never
    return std::min(when ? since(*when, kDriveTimeout) : std::uint8_t{255}, std::uint8_t{kDriveTimeout + 1});
  };
  const bool enabled = drive::isEnabled(report.phase);
  key.add(report.phase).add(report.online).add(report.parameter_set).add(report.commanded_set);
  key.add(report.fault_latched).add(since(lastUsefulOf(drive), kDriveTimeout));
  key.add(since_told(lastToldOf(missingOf(drive)))).add(since_told(moduleBackOf(missingOf(drive))));
  const auto& phase = phaseOf(drive);
  key.add(phase.sent).add(phase.ready_seen).add(enabled && phase.wanted.value != 0.0);
  const bool timed = report.phase == Phase::kIdle || report.phase == Phase::kEnabling ||
                     report.phase == Phase::kStopping || report.phase == Phase::kSwitchingSet ||
                     report.phase == Phase::kResting || report.phase == Phase::kResuming;
  key.add(timed ? since(phase.since, kShutdownTimeout) : std::uint8_t{0});
  if (report.phase == Phase::kOffline) {
    const auto& unanswered = unansweredOf(drive);
    const std::uint8_t left = ticks(now, unanswered.until, kTick, kShutdownTimeout);
    const bool over = left == 0 && !unanswered.due;
    key.add(left).add(unanswered.due).add(over ? profile::Command::kIgnored : unanswered.command);
  } else {
    key.add(report.state).add(status.fault()).add(status.busControl()).add(report.input.actual_values[0]);
  }
  if (report.phase == Phase::kAcknowledging) {
    const auto& edge = edgeOf(drive);
    key.add(edgeStageOf(edge))
        .add(edgeBegunOf(edge))
        .add(edgeAnswersOf(edge))
        .add(since(edgeSinceOf(edge), kAcknowledgeTime));
  }
}

}  // namespace nord_driver::explore
