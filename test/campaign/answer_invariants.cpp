#include "campaign/answer_invariants.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::test {

namespace {

const Call* callOf(const Moment& moment, std::uint32_t id) {
  for (const Call& call : *moment.calls) {
    if (call.request.id == id) return &call;
  }
  return nullptr;
}

std::string asked(const Call& call) {
  return "request " + std::to_string(call.request.id) + " (kind " +
         std::to_string(static_cast<int>(call.request.kind)) + ", drive " +
         (call.request.drive == cycle::kAllDrives ? "all" : std::to_string(call.request.drive)) + ")";
}

constexpr double kAtRest = 0.05;         // Hz
constexpr double kNearReference = 0.02;  // rad

}  // namespace

std::optional<std::string> EveryCallAnswered::look(const Moment& moment) {
  if (!moment.driver_ran || !moment.judged) return std::nullopt;
  for (const Call& call : *moment.calls) {
    // A cycle that began when the patience was over has answered when it ends.
    if (call.answered || moment.began <= call.submitted + call.request.patience) continue;
    return asked(call) + " is not answered " + std::to_string(toSeconds(moment.now - call.submitted)) +
           " s after it was asked, with a patience of " + std::to_string(toSeconds(call.request.patience)) + " s";
  }
  return std::nullopt;
}

std::optional<std::string> NoCallAnsweredTwice::look(const Moment& moment) {
  for (const cycle::Completion& answer : moment.answers) {
    if (++answers_[answer.id] > 1) return "request " + std::to_string(answer.id) + " is answered twice";
    if (callOf(moment, answer.id) == nullptr) return "request " + std::to_string(answer.id) + " was never asked";
  }
  return std::nullopt;
}

std::optional<std::string> AnswersAreTrue::look(const Moment& moment) {
  enabled_at_.resize(moment.drives.size(), Instant{});
  rested_at_.resize(moment.drives.size(), Instant{});
  for (std::size_t i = 0; i < moment.drives.size(); ++i) {
    const DriveTruth& drive = moment.drives[i];
    if (drive.turnsByBus() || (i == 0 && moment.stand_in_enabled)) enabled_at_[i] = moment.now;
    if (std::fabs(drive.frequency) < kAtRest) rested_at_[i] = moment.now;
  }
  for (const cycle::Completion& answer : moment.answers) {
    if (const Call* const call = callOf(moment, answer.id)) {
      if (auto wrong = judge(moment, answer, *call)) return wrong;
    }
  }
  return std::nullopt;
}

std::optional<std::string> AnswersAreTrue::judge(const Moment& moment, const cycle::Completion& answer,
                                                 const Call& call) const {
  using Kind = cycle::RequestKind;
  const Kind kind = call.request.kind;
  if (!answer.success) {
    if (answer.message.empty()) return asked(call) + " was refused without a sentence";
    return std::nullopt;
  }
  if (kind == Kind::kReadParameter || kind == Kind::kWriteParameter) {
    const auto held = std::find(call.held.begin(), call.held.end(), answer.parameter.raw);
    if (held != call.held.end()) return std::nullopt;
    return asked(call) + " tells the value " + std::to_string(answer.parameter.raw) + " of P" +
           std::to_string(call.request.parameter.number) + ", which the drive never had meanwhile";
  }
  for (std::size_t i = 0; i < moment.drives.size(); ++i) {
    if (call.request.drive != cycle::kAllDrives && call.request.drive != i) continue;
    // "And is held where the run ends": at 0, or a little beside it, where it is braked.
    if (kind == Kind::kHome && std::fabs(moment.drives[i].position) > kNearReference) {
      return asked(call) + " says that the reference run has ended, and drive " + std::to_string(i) + " is not there";
    }
    const bool stops = kind == Kind::kDisable || kind == Kind::kQuickStop || kind == Kind::kShutDown;
    // With P104 above 0 the motor gets no voltage before the first command (doc/safety.md).
    const bool waits = moment.drives[i].slowest > 0.0;
    if (kind == Kind::kEnable && !waits && moment.now - enabled_at_[i] > moment.reaction) {
      return asked(call) + " says that drive " + std::to_string(i) + " is enabled, and it is not";
    }
    if (stops && !moment.drives[i].bus_control) continue;
    // The rest of the one that stood in for it.
    if (stops && i == 0 && moment.stand_in_believed) continue;
    if (stops && moment.now - rested_at_[i] > moment.reaction) {
      return asked(call) + " says that drive " + std::to_string(i) + " is at rest, and it turns";
    }
  }
  return std::nullopt;
}

}  // namespace nord_driver::test
