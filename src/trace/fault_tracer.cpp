#include "trace/fault_tracer.h"

#include <algorithm>
#include <string>

namespace nord_driver::trace {

namespace {

std::string sentenceOf(const TraceTrigger& trigger, const std::string& name) {
  if (!trigger.text.empty()) return trigger.text.str();
  if (trigger.drive == cycle::kAllDrives) return "the base stopped";
  const char* what = trigger.kind == TraceTrigger::Kind::kFault ? ": a fault" : " stopped";
  return "drive " + name + what + " (status word " + toHexWord(trigger.status_word) + ")";
}

}  // namespace

std::optional<TraceResult> FaultTracer::poll(const TraceClock& clock) {
  take();
  if (!waiting_ || clock.bus - waiting_->time < kAfterFault) return std::nullopt;
  return write(clock);
}

std::optional<TraceResult> FaultTracer::finish(const TraceClock& clock) {
  take();
  if (!waiting_) return std::nullopt;
  return write(clock);
}

void FaultTracer::take() {
  while (const auto trigger = feed_.pollTrigger()) {
    const std::string name = trigger->drive == cycle::kAllDrives ? "base" : writer_.drives()[trigger->drive].name;
    const std::string sentence = sentenceOf(*trigger, name);
    if (!waiting_) {
      const char* kind = trigger->kind == TraceTrigger::Kind::kFault ? "fault_" : "stop_";
      waiting_ = TraceCause{kind + name, {}, trigger->time, trigger->cycle};
    }
    std::vector<std::string>& reasons = waiting_->reasons;
    if (std::find(reasons.begin(), reasons.end(), sentence) == reasons.end()) reasons.push_back(sentence);
  }
}

std::optional<TraceResult> FaultTracer::write(const TraceClock& clock) {
  const TraceCause cause = *waiting_;
  waiting_.reset();
  return writer_.write(cause, clock);
}

}  // namespace nord_driver::trace
