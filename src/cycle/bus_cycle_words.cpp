// The part of the bus cycle that puts together what goes to each drive: its own word, and the further ones.
#include <algorithm>

#include "cycle/bus_cycle.h"
#include "cycle/word_places.h"

namespace nord_driver::cycle {

void BusCycle::addAxis(const DriveSetup& setup, CycleRole role) {
  const DriveIndex drive = axes_.size();
  const DriveIdentity identity = transport_.identity(drive);
  ParameterChannelUse channel;
  channel.timeout_owner = identity.timeout_owner;
  channel.capabilities = transport_.parameterCapabilities(drive);
  channel.monitor = setup.monitor;
  channel.follows = !setup.follows.empty();
  channel.told_by_telegram = identity.sources_by_telegram;
  channel.users_only = role == CycleRole::kGuest;
  drives_[drive].setParametersAwaited(!channel.users_only);
  if (role != CycleRole::kGuest) {
    channel.needs = driveNeeds(setup, identity.process_values, role == CycleRole::kOnlooker);
    if (setup.position) channel.field_order = setup.position->order;
  }
  axes_.emplace_back(drive, setup, channel);
  for (std::size_t i = 0; i < setup.words.setpoints.size() && role == CycleRole::kDriver; ++i) {
    if (setup.words.setpoints[i].moves) command_watch_.watch(drive, i, setup.words.setpoints[i]);
  }
}

bool BusCycle::followsCommand(DriveIndex drive, Instant now) noexcept {
  if (!supervisor_.groupOf(drive).commandAllowed() || drives_[drive].report().phase != drive::Phase::kEnabled) {
    return false;
  }
  if (supervisor_.inBase(drive)) return base_ ? base_->obeys() : steered_->obeys();
  return !isStale(ports_.newestDriveCommand(leaders_[drive].value_or(drive)), cmd_vel_timeout_, now);
}

void BusCycle::pollOutputs(Instant now) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    outputs_[i] = drives_[i].pollOutput(now);
    const Axis& axis = axes_[i];
    if (!axis.words.empty()) putWords(i, now);
    const drive::DriveReport& report = drives_[i].report();
    if (report.position.homing) axis.bits.putHome(outputs_[i], axis.parameters.device(), report.commanded_set);
    axis.bits.putElement(report.position.element, outputs_[i], axis.parameters.device(), report.commanded_set);
    axis.bits.putTeach(report.position.teach, outputs_[i], axis.parameters.device(), report.commanded_set);
    if (report.position.reset) axis.bits.putReset(outputs_[i], axis.parameters.device(), report.commanded_set);
  }
}

void BusCycle::putWords(DriveIndex i, Instant now) noexcept {
  Axis& axis = axes_[i];
  DriveWords::State state;
  state.set = drives_[i].report().commanded_set;
  state.max_frequency = drives_[i].maxFrequency(state.set);
  state.follows = followsCommand(i, now);
  state.in_doubt = axis.parameters.wordsInDoubt();
  const drive::Phase phase = drives_[i].report().phase;
  const drive::DriveGroup& group = supervisor_.groupOf(i);
  const drive::GroupPhase group_phase = group.report().phase;
  state.stop.enabled = group.commandAllowed();
  state.stop.stops = group.stops();
  state.stop.stands = group.stopStands();
  state.stop.stopping = phase == drive::Phase::kStopping || phase == drive::Phase::kQuickStopping ||
                        phase == drive::Phase::kCoasting || phase == drive::Phase::kHoldingZero ||
                        phase == drive::Phase::kOffline || drive::isOnWayDown(group_phase);
  axis.words.put(outputs_[i], state, axis.parameters.device(), ports_.newestWords(i), now);
  while (const auto finding = axis.words.pollFinding(names_[i].c_str(), axis.parameters.device(), state.in_doubt)) {
    ports_.tell({true, *finding});
  }
}

}  // namespace nord_driver::cycle
