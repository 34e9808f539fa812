#include "process_campaign/process_rules.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace nord_driver::test {

namespace {

constexpr double kTurns = 0.5;  // Hz
constexpr const char* kWheels[] = {"left", "right"};

/// When it was seen not to be enabled, after it had been, from `from` on.
std::optional<double> fallsAfter(const std::vector<TruthPoint>& wheel, double from) {
  for (std::size_t i = 1; i < wheel.size(); ++i) {
    if (wheel[i].time >= from && wheel[i - 1].enabled && !wheel[i].enabled) return wheel[i].time;
  }
  return std::nullopt;
}

/// From the call of ~enable until it fails, a stop, or the first wheel that has left "operation enabled".
std::vector<TimeSpan> allowedSpans(const ProcessRecord& record) {
  std::vector<TimeSpan> spans;
  for (const MadeCall& call : record.enablings) {
    double until = call.end && !call.success ? *call.end : HUGE_VAL;
    for (const double stop : record.stops) {
      if (stop >= call.begin) until = std::min(until, stop);
    }
    for (const auto& wheel : record.wheels) {
      if (const auto falls = fallsAfter(wheel, call.end.value_or(call.begin))) until = std::min(until, *falls);
    }
    spans.push_back({call.begin, until});
  }
  return spans;
}

/// The end of the last time that both have in common at or before `time`; nothing: there is none.
std::optional<double> lastCommon(const std::vector<TimeSpan>& a, const std::vector<TimeSpan>& b, double time) {
  std::optional<double> last;
  for (const TimeSpan& one : a) {
    for (const TimeSpan& other : b) {
      const double from = std::max(one.from, other.from);
      const double until = std::min({one.until, other.until, time});
      if (from <= until) last = std::max(last.value_or(until), until);
    }
  }
  return last;
}

}  // namespace

std::optional<std::string> enabledUnasked(const ProcessRecord& record, const ProcessBounds& bounds) {
  for (std::size_t w = 0; w < 2; ++w) {
    const auto& wheel = record.wheels[w];
    for (std::size_t i = 1; i < wheel.size(); ++i) {
      if (wheel[i - 1].enabled || !wheel[i].enabled) continue;
      const bool asked = std::any_of(record.enablings.begin(), record.enablings.end(), [&](const MadeCall& call) {
        return call.begin <= wheel[i].time && (!call.end || wheel[i].time <= *call.end + bounds.seen);
      });
      if (asked) continue;
      std::ostringstream out;
      out << kWheels[w] << " became \"operation enabled\" at " << wheel[i].time << " s, and nobody was asking for it";
      return out.str();
    }
  }
  return std::nullopt;
}

std::optional<std::string> turnsUncommanded(const ProcessRecord& record, const ProcessBounds& bounds) {
  const std::vector<TimeSpan> allowed = allowedSpans(record);
  for (std::size_t w = 0; w < 2; ++w) {
    for (const TruthPoint& point : record.wheels[w]) {
      if (std::fabs(point.frequency) < kTurns) continue;
      const auto last = lastCommon(allowed, record.commanded, point.time);
      if (last && point.time - *last <= bounds.stop) continue;
      std::ostringstream out;
      out << kWheels[w] << " has " << point.frequency << " Hz at " << point.time << " s, ";
      if (last) {
        out << point.time - *last << " s after the last moment at which it was enabled and commanded";
      } else {
        out << "and was never enabled and commanded";
      }
      return out.str();
    }
  }
  return std::nullopt;
}

std::optional<std::string> turnsAlone(const ProcessRecord& record, const ProcessBounds& bounds) {
  for (std::size_t w = 0; w < 2; ++w) {
    const auto& one = record.wheels[w];
    const auto& other = record.wheels[1 - w];
    std::size_t next = 0;
    bool other_enabled = false;
    std::optional<double> since;
    for (const TruthPoint& point : one) {
      for (; next < other.size() && other[next].time <= point.time; ++next) other_enabled = other[next].enabled;
      if (!point.enabled || point.setpoint == 0 || other_enabled || next == 0) {
        since.reset();
        continue;
      }
      if (!since) since = point.time;
      if (point.time - *since <= bounds.alone) continue;
      std::ostringstream out;
      out << kWheels[w] << " is told to turn at " << point.time << " s, " << point.time - *since
          << " s after the other wheel was seen not to be enabled";
      return out.str();
    }
  }
  return std::nullopt;
}

std::optional<std::string> unanswered(const std::vector<MadeCall>& calls, double patience) {
  for (const MadeCall& call : calls) {
    std::ostringstream out;
    if (!call.end) {
      out << call.service << ", called at " << call.begin << " s, has not ended";
      return out.str();
    }
    if (*call.end - call.begin > patience) {
      out << call.service << ", called at " << call.begin << " s, took " << *call.end - call.begin << " s of "
          << patience << " s";
      return out.str();
    }
    if (!call.not_carried_out.empty()) {
      out << call.service << ", called at " << call.begin << " s, brought no answer until " << *call.end
          << " s: " << call.not_carried_out;
      return out.str();
    }
    if (!call.success && call.message.empty()) {
      out << call.service << ", called at " << call.begin << " s, was refused without a sentence";
      return out.str();
    }
  }
  return std::nullopt;
}

}  // namespace nord_driver::test
