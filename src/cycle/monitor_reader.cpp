#include "cycle/monitor_reader.h"

#include <utility>

#include "cycle/user_messages.h"
#include "profile/parameter_shape.h"

namespace nord_driver::cycle {

using profile::ParameterOutcome;

MonitorReader::MonitorReader(std::vector<profile::ParameterRequest> parameters)
    : parameters_(std::move(parameters)), values_(parameters_.size()), left_out_(parameters_.size(), 0) {}

void MonitorReader::handleOffline() noexcept {
  for (MonitoredValue& value : values_) value = {};
  for (std::uint8_t& left_out : left_out_) left_out = 0;
  in_turn_ = false;
  waiting_ = false;
  timed_out_ = false;
  next_turn_ = {};
  not_before_ = {};
}

std::optional<profile::ParameterRequest> MonitorReader::pollRequest(std::uint8_t parameter_set, Instant now) noexcept {
  if (waiting_ || parameters_.empty()) return std::nullopt;
  if (timed_out_) {
    timed_out_ = false;
    not_before_ = now + kTurn;
  }
  if (now < not_before_) return std::nullopt;
  if (!in_turn_) {
    if (now < next_turn_) return std::nullopt;
    in_turn_ = true;
    next_turn_ = now + kTurn;
    next_ = 0;
  }
  for (; next_ != parameters_.size(); ++next_) {
    profile::ParameterRequest request = parameters_[next_];
    if (left_out_[next_] != 0) continue;
    if (profile::hasSets(request.shape) && request.parameter_set == 0) {
      if (parameter_set == 0) continue;
      request.parameter_set = parameter_set;
    }
    waiting_ = true;
    return request;
  }
  in_turn_ = false;
  return std::nullopt;
}

void MonitorReader::handleResult(const profile::ParameterResult& result, const char* drive) noexcept {
  if (!waiting_) return;
  waiting_ = false;
  // Not asked at all: the question is still to be put.
  if (result.outcome == ParameterOutcome::kBusy || result.outcome == ParameterOutcome::kOffline) return;
  MonitoredValue& value = values_[next_];
  value = {};
  timed_out_ = result.outcome == ParameterOutcome::kTimeout;
  if (result.outcome == ParameterOutcome::kDone) {
    value.state = MonitoredValue::State::kKnown;
    value.raw = result.raw;
  } else {
    value.state = timed_out_ ? MonitoredValue::State::kNoAnswer : MonitoredValue::State::kRefused;
    profile::ParameterResult told = result;
    told.refused_number = parameters_[next_].number;
    value.why.format("%s", parameterMessage(drive, told.refused_number, told).c_str());
    left_out_[next_] = static_cast<std::uint8_t>(!timed_out_ && !mayPass(result.reason));
  }
  ++next_;
}

}  // namespace nord_driver::cycle
