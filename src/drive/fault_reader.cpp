#include "drive/fault_reader.h"

#include "profile/fault_number.h"

namespace nord_driver::drive {

using profile::ParameterOutcome;

namespace {

constexpr Duration kRetryAfter = seconds(1.0);
constexpr std::uint16_t kCurrentFault = 700;
constexpr std::uint8_t kFaultElement = 1;
constexpr std::uint8_t kReasonElement = 3;

std::uint16_t word(std::int32_t raw) noexcept {
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>(raw) & 0xFFFFu);
}

}  // namespace

void FaultReader::handleStatus(profile::StatusWord status) noexcept {
  if (status.fault() == fault_ && !away_) return;
  away_ = false;
  fault_ = status.fault();
  number_ = fault_ ? profile::kFaultNumberUnknown : std::uint16_t{0};
  if (fault_) last_number_ = profile::kFaultNumberUnknown;
  same_fault_ = false;
  retry_at_ = {};
}

void FaultReader::handleOffline() noexcept {
  away_ = true;
  fault_ = false;
  same_fault_ = false;
  under_way_ = Item::kNone;
  reason_state_ = ReasonState::kNotAsked;
}

void FaultReader::requestReason() noexcept {
  if (reason_state_ != ReasonState::kNotAvailable) reason_state_ = ReasonState::kReading;
}

void FaultReader::forgetReason() noexcept {
  same_hold_ = false;
  if (reason_state_ != ReasonState::kNotAvailable) reason_state_ = ReasonState::kNotAsked;
}

bool FaultReader::awaitsNumber() const noexcept {
  return under_way_ == Item::kFault || (fault_ && number_ == profile::kFaultNumberUnknown);
}

FaultReader::Item FaultReader::nextItem(Instant now) const noexcept {
  if (now < retry_at_) return Item::kNone;
  if (fault_ && number_ == profile::kFaultNumberUnknown) return Item::kFault;
  if (reason_state_ == ReasonState::kReading) return Item::kReason;
  return Item::kNone;
}

std::optional<profile::ParameterRequest> FaultReader::pollRequest(Instant now) noexcept {
  if (under_way_ != Item::kNone) return std::nullopt;
  under_way_ = nextItem(now);
  if (under_way_ == Item::kNone) return std::nullopt;
  same_fault_ = fault_;
  same_hold_ = true;
  retry_at_ = now + kRetryAfter;
  profile::ParameterRequest request;
  request.number = kCurrentFault;
  request.shape = profile::ParameterShape::kArray;
  request.index = under_way_ == Item::kFault ? kFaultElement : kReasonElement;
  return request;
}

void FaultReader::handleResult(const profile::ParameterResult& result) noexcept {
  const Item item = under_way_;
  under_way_ = Item::kNone;
  if (item == Item::kFault) handleNumber(result);
  if (item == Item::kReason) handleReason(result);
}

void FaultReader::handleNumber(const profile::ParameterResult& result) noexcept {
  // 0 with the fault bit set: the inverter has not filled P700 in yet, or has just emptied it.
  const std::uint16_t number = word(result.raw);
  if (result.outcome != ParameterOutcome::kDone || number == 0) return;
  if (last_number_ == profile::kFaultNumberUnknown && !fault_) last_number_ = number;
  if (!fault_ || !same_fault_) return;
  number_ = number;
  last_number_ = number;
  retry_at_ = {};
}

void FaultReader::handleReason(const profile::ParameterResult& result) noexcept {
  const bool refused = result.outcome == ParameterOutcome::kRefused && !mayPass(result.reason);
  if (refused || result.outcome == ParameterOutcome::kNoChannel) {
    reason_state_ = ReasonState::kNotAvailable;
    retry_at_ = {};
  } else if (!same_hold_) {
    retry_at_ = {};
  } else if (result.outcome == ParameterOutcome::kDone) {
    reason_ = word(result.raw);
    reason_state_ = ReasonState::kKnown;
    retry_at_ = {};
  }
}

}  // namespace nord_driver::drive
