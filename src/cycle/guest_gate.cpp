#include "cycle/guest_gate.h"

#include <algorithm>

namespace nord_driver::cycle {

using profile::DriveState;

namespace {

constexpr int kCyclesToSeeAll = 3;  // inverters behind one module do not answer in the same cycle

bool isAtRest(DriveState state) noexcept {
  return state == DriveState::kNotReadyToSwitchOn || state == DriveState::kSwitchOnDisabled ||
         state == DriveState::kReadyToSwitchOn || state == DriveState::kFault;
}

}  // namespace

void GuestGate::close(std::size_t awaited, bool reaches_others) {
  reaches_others_ = reaches_others;
  heard_each_.assign(awaited, false);
  fault_seen_.assign(awaited, false);
  closeAgain();
}

// What was acknowledged before stays to be told.
void GuestGate::closeAgain() noexcept {
  open_ = false;
  heard_ = false;
  cycles_heard_ = 0;
  running_.reset();
}

void GuestGate::holdBack(std::vector<profile::ProcessOutput>& outputs) const noexcept {
  if (open_) return;
  for (profile::ProcessOutput& output : outputs) output = {};
}

void GuestGate::handleInputs(std::vector<DriveExchange>& inputs) noexcept {
  const bool left =
      guest_ && std::any_of(inputs.begin(), inputs.end(), [](const DriveExchange& input) { return input.given_way; });
  if (left) closeAgain();
  if (open_) return;
  look(inputs);
  for (DriveExchange& input : inputs) input = {};
}

void GuestGate::look(const std::vector<DriveExchange>& inputs) noexcept {
  heard_ = !heard_each_.empty() && inputs.size() >= heard_each_.size();
  const std::size_t seen = std::min(inputs.size(), heard_each_.size());
  for (DriveIndex i = 0; i < seen; ++i) {
    heard_each_[i] = inputs[i].inverter_answers;
    heard_ = heard_ && heard_each_[i];
  }
  if (heard_) ++cycles_heard_;
  const std::size_t reached = reaches_others_ ? inputs.size() : seen;
  for (DriveIndex i = 0; i < reached && !running_; ++i) {
    if (!inputs[i].inverter_answers) continue;
    const DriveState state = profile::StatusWord{inputs[i].input.status_word}.state();
    if (i < seen && state == DriveState::kFault) fault_seen_[i] = true;
    if (!isAtRest(state)) running_ = Running{i, state};
  }
  open_ = cycles_heard_ >= kCyclesToSeeAll && !running_;
}

}  // namespace nord_driver::cycle
