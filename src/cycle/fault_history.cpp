#include "cycle/fault_history.h"

#include "profile/fault_number.h"

namespace nord_driver::cycle {

using profile::ParameterOutcome;

namespace {

constexpr std::uint16_t kLastFaults = 701;
constexpr std::uint8_t kMaxAttempts = 3;

}  // namespace

void FaultHistoryReader::handleFault(bool fault, std::uint16_t last_number, bool number_awaited) noexcept {
  if (fault && !fault_) {
    state_ = State::kNumberAwaited;
    waiting_ = false;
    history_ = {};
  }
  fault_ = fault;
  // Gone before P700 told it, which says "no fault" by now: only the history can tell it.
  const bool untold = !fault && !number_awaited;
  if (state_ != State::kNumberAwaited || !(profile::isFaultNumber(last_number) || untold)) return;
  state_ = State::kReading;
  attempts_ = 0;
}

void FaultHistoryReader::handleOffline() noexcept {
  fault_ = false;
  waiting_ = false;
  state_ = State::kIdle;
}

std::optional<profile::ParameterRequest> FaultHistoryReader::pollRequest() noexcept {
  if (state_ != State::kReading || waiting_) return std::nullopt;
  waiting_ = true;
  profile::ParameterRequest request;
  request.number = kLastFaults;
  request.shape = profile::ParameterShape::kArray;
  request.index = static_cast<std::uint8_t>(history_.numbers.size() + 1);
  return request;
}

void FaultHistoryReader::handleResult(const profile::ParameterResult& result) noexcept {
  if (!waiting_) return;
  waiting_ = false;
  // Not asked at all: the question is still to be put.
  if (result.outcome == ParameterOutcome::kBusy || result.outcome == ParameterOutcome::kOffline) return;
  if (result.outcome == ParameterOutcome::kTimeout && ++attempts_ < kMaxAttempts) return;
  if (result.outcome != ParameterOutcome::kDone) return end();
  attempts_ = 0;
  history_.numbers.push_back(static_cast<std::uint16_t>(static_cast<std::uint32_t>(result.raw) & 0xFFFFu));
  if (history_.numbers.full()) end();
}

void FaultHistoryReader::end() noexcept {
  state_ = State::kIdle;
  history_.asked = true;
}

}  // namespace nord_driver::cycle
