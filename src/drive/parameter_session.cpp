#include "drive/parameter_session.h"

#include "drive/parameter_notes.h"
#include "profile/pkw.h"

namespace nord_driver::drive {

using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterRequest;
using profile::ParameterResult;
using profile::ParameterShape;

namespace {

constexpr std::uint16_t kSaveInEeprom = 560;
constexpr std::uint8_t kSwitchTries = 2;

// A word comes back with its high word 0 or, negative, FFFF; with anything else there the parameter is a double word.
bool isValue(const ParameterTask& task, std::int32_t raw) noexcept {
  if (task.double_word) return raw == task.raw;
  const std::uint32_t high = static_cast<std::uint32_t>(raw) >> 16;
  const std::uint32_t difference = static_cast<std::uint32_t>(raw) ^ static_cast<std::uint32_t>(task.raw);
  return (high == 0 || high == 0xFFFFu) && (difference & 0xFFFFu) == 0;
}

// Not carried out for certain; everything else may have been.
bool surelyNotDone(ParameterOutcome outcome) noexcept {
  return outcome == ParameterOutcome::kRefused || outcome == ParameterOutcome::kBusy ||
         outcome == ParameterOutcome::kNoChannel || outcome == ParameterOutcome::kNotActivated;
}

bool isDone(const ParameterResult& result) noexcept {
  return result.outcome == ParameterOutcome::kDone;
}

bool isError(const ParameterResult& result, std::uint16_t number) noexcept {
  return result.outcome == ParameterOutcome::kRefused && result.error_number == number;
}

}  // namespace

bool ParameterSession::submit(const ParameterTask& task) noexcept {
  if (!tasks_.submit(task)) return false;
  if (tasks_.size() == 1) try_recovery_ = owes_switch_;
  return true;
}

// --- Handing out

void ParameterSession::begin() noexcept {
  failed_ = false;
  no_index_ = false;
  switch_was_off_ = false;
  switch_tries_ = 0;
  recovering_ = owes_switch_ && try_recovery_;
  if (recovering_) {
    step_ = Step::kReadSwitch;
  } else if (!tasks_.empty()) {
    result_ = {};
    step_ = Step::kReadValue;
  }
}

std::optional<ParameterRequest> ParameterSession::pollRequest() noexcept {
  if (under_way_) return std::nullopt;
  if (step_ == Step::kNone) begin();
  if (step_ == Step::kNone) return std::nullopt;
  if (step_ == Step::kSwitchOff) owes_switch_ = true;
  under_way_ = true;
  return requestFor(step_);
}

ParameterRequest ParameterSession::requestFor(Step step) const noexcept {
  ParameterRequest request;
  switch (step) {
    case Step::kReadSwitch:
    case Step::kCheckSwitchOff:
    case Step::kCheckSwitchOn:
      request.number = kSaveInEeprom;
      return request;
    case Step::kSwitchOff:
    case Step::kSwitchOn:
      request.number = kSaveInEeprom;
      request.action = ParameterAction::kWritePersistent;
      request.raw = step == Step::kSwitchOn ? 1 : 0;
      return request;
    case Step::kNone:
    case Step::kReadValue:
    case Step::kReadBack:
      break;
    case Step::kWriteRam:
      request.action = ParameterAction::kWriteRam;
      break;
    case Step::kWrite:
      request.action = ParameterAction::kWritePersistent;
      break;
  }
  const ParameterTask& task = tasks_.front();
  request.number = task.number;
  request.shape = no_index_ ? ParameterShape::kPlain : task.shape;
  request.parameter_set = task.set;
  request.index = task.index;
  if (request.action != ParameterAction::kRead) {
    request.double_word = task.double_word;
    request.raw = task.raw;
  }
  return request;
}

// --- Results

void ParameterSession::handleResult(const ParameterResult& result) noexcept {
  if (!under_way_) return;
  under_way_ = false;
  switch (step_) {
    case Step::kNone:
      return;
    case Step::kReadValue:
      return handleValue(result);
    case Step::kWriteRam:
      return handleRamWrite(result);
    case Step::kReadSwitch:
      return handleSwitch(result);
    case Step::kSwitchOff:
    case Step::kCheckSwitchOff:
      return handleSwitchOff(result);
    case Step::kWrite:
      return handleWrite(result);
    case Step::kSwitchOn:
    case Step::kCheckSwitchOn:
      return handleSwitchOn(result);
    case Step::kReadBack:
      return handleReadBack(result);
  }
}

void ParameterSession::handleValue(const ParameterResult& result) noexcept {
  const ParameterTask& task = tasks_.front();
  const bool write = task.kind != ParameterTaskKind::kRead;
  if (!isDone(result)) {
    fail(result, task.number, write ? kNotRead : "");
    return finish();
  }
  result_.raw = result.raw;
  const bool persistent = task.kind == ParameterTaskKind::kWritePersistent;
  const bool may_be_ram = persistent && (task.even_if_same || ram_only_.holds(task));
  const bool same = write && isValue(task, result.raw) && !may_be_ram;
  if (!write || same) {
    result_.outcome = ParameterOutcome::kDone;
    if (same) result_.note = kSame;
    return finish();
  }
  if (persistent && task.number == kSaveInEeprom) {
    owes_switch_ = false;  // the user decides over it now
    step_ = Step::kWrite;
  } else if (persistent) {
    step_ = Step::kReadSwitch;
  } else if (ram_orders_) {
    step_ = Step::kWriteRam;
  } else {
    writePlainly();
  }
}

void ParameterSession::handleRamWrite(const ParameterResult& result) noexcept {
  if (!surelyNotDone(result.outcome)) ram_only_.mark(tasks_.front());
  if (isDone(result)) {
    step_ = Step::kReadBack;
  } else if (isError(result, profile::pkw_error::kInvalidOrder)) {
    ram_orders_ = false;
    writePlainly();
  } else if (!retryWithoutIndex(result)) {
    fail(result, tasks_.front().number, surelyNotDone(result.outcome) ? "" : kWriteUnanswered);
    finish();
  }
}

void ParameterSession::writePlainly() noexcept {
  if (tasks_.front().number != kSaveInEeprom) {
    step_ = Step::kReadSwitch;
    return;
  }
  refuse(kSwitchItself);
  finish();
}

void ParameterSession::handleSwitch(const ParameterResult& result) noexcept {
  if (recovering_) {
    if (isDone(result) && result.raw != 0) owes_switch_ = false;
    if (isDone(result) && result.raw == 0) {
      step_ = Step::kSwitchOn;
    } else {
      finish();
    }
    return;
  }
  const bool persistent = tasks_.front().kind == ParameterTaskKind::kWritePersistent;
  const bool off = isDone(result) && result.raw == 0;
  if (isDone(result) && !off) owes_switch_ = false;
  if (isError(result, profile::pkw_error::kInvalidNumber)) {
    if (persistent) {
      result_.note = kNoSwitch;
      step_ = Step::kWrite;
      return;
    }
    refuse(kNothingSpares);
    return finish();
  }
  if (!isDone(result)) {
    fail(result, kSaveInEeprom, kSwitchUnread);
    return finish();
  }
  if (persistent && off) {
    refuse(owes_switch_ ? kNotPutBack : kWouldBeLost);
    return finish();
  }
  switch_was_off_ = off && !owes_switch_;
  if (switch_was_off_) result_.note = kWasOff;
  step_ = persistent || off ? Step::kWrite : Step::kSwitchOff;
}

void ParameterSession::handleSwitchOff(const ParameterResult& result) noexcept {
  const bool write = step_ == Step::kSwitchOff;
  if (write) countWrite(result);
  if (isDone(result) && (write || result.raw == 0)) {
    step_ = write ? Step::kCheckSwitchOff : Step::kWrite;
    return;
  }
  if (isDone(result)) {
    refuse(kNotSet);
  } else {
    fail(result, kSaveInEeprom, kNotSet);
  }
  if (write && surelyNotDone(result.outcome)) owes_switch_ = false;
  putBackOrFinish();
}

void ParameterSession::handleWrite(const ParameterResult& result) noexcept {
  countValueWrite(result);
  if (!isDone(result)) {
    if (retryWithoutIndex(result)) return;
    fail(result, tasks_.front().number, surelyNotDone(result.outcome) ? "" : kWriteUnanswered);
  }
  putBackOrFinish();
}

// The value has been written, or not: first of all P560 goes back to what it was.
void ParameterSession::putBackOrFinish() noexcept {
  if (owes_switch_) {
    step_ = Step::kSwitchOn;
  } else if (failed_) {
    finish();
  } else {
    step_ = Step::kReadBack;
  }
}

void ParameterSession::handleSwitchOn(const ParameterResult& result) noexcept {
  const bool write = step_ == Step::kSwitchOn;
  if (write) countWrite(result);
  if (isDone(result) && write) {
    step_ = Step::kCheckSwitchOn;
    return;
  }
  if (isDone(result) && result.raw != 0) {
    owes_switch_ = false;
    if (recovering_) return finish();
    if (!failed_) result_.note = kToggled;
    return putBackOrFinish();
  }
  if (++switch_tries_ < kSwitchTries) {
    step_ = Step::kSwitchOn;
    return;
  }
  if (!recovering_) {
    if (!failed_) isDone(result) ? refuse(kNotPutBack) : fail(result, kSaveInEeprom, kNotPutBack);
    result_.note = kNotPutBack;
  }
  finish();
}

void ParameterSession::handleReadBack(const ParameterResult& result) noexcept {
  const ParameterTask& task = tasks_.front();
  if (!isDone(result)) {
    fail(result, task.number, kNotReadBack);
  } else {
    result_.raw = result.raw;
    result_.outcome = ParameterOutcome::kDone;
    if (!isValue(task, result.raw)) refuse(kDiffers);
  }
  if (!failed_ && task.kind == ParameterTaskKind::kWritePersistent) ram_only_.unmark(tasks_.front());
  finish();
}

// A parameter that was taken for set-dependent and is not answers a write with error 4; reads fall back by themselves.
bool ParameterSession::retryWithoutIndex(const ParameterResult& result) noexcept {
  if (no_index_ || !isError(result, profile::pkw_error::kNoArray)) return false;
  no_index_ = tasks_.front().shape == ParameterShape::kPerSet;
  return no_index_;
}

void ParameterSession::fail(const ParameterResult& result, std::uint16_t number, const char* note) noexcept {
  failed_ = true;
  result_.outcome = result.outcome;
  result_.note = note;
  if (result.outcome != ParameterOutcome::kRefused) return;
  result_.error_number = result.error_number;
  result_.abort_code = result.abort_code;
  result_.refused_number = number;
  if (result.error_number == profile::pkw_error::kNotRepresentable) result_.note = kTooWide;
}

void ParameterSession::refuse(const char* note) noexcept {
  failed_ = true;
  result_.outcome = ParameterOutcome::kRefused;
  result_.note = note;
}

void ParameterSession::finish() noexcept {
  step_ = Step::kNone;
  if (recovering_) {
    recovering_ = false;
    try_recovery_ = false;
    return;
  }
  try_recovery_ = owes_switch_ && tasks_.size() > 1;
  tasks_.finish(result_);
}

void ParameterSession::countWrite(const ParameterResult& result) noexcept {
  if (surelyNotDone(result.outcome)) return;
  ++eeprom_writes_;
  result_.eeprom_written = true;
}

void ParameterSession::countValueWrite(const ParameterResult& result) noexcept {
  if (!owes_switch_ && !switch_was_off_) return countWrite(result);
  if (!surelyNotDone(result.outcome)) ram_only_.mark(tasks_.front());
}

void ParameterSession::handleOffline() noexcept {
  ParameterResult offline;
  offline.outcome = ParameterOutcome::kOffline;
  // What is under way may still be carried out.
  if (under_way_) {
    if (step_ == Step::kSwitchOff || step_ == Step::kSwitchOn) countWrite(offline);
    if (step_ == Step::kWrite) countValueWrite(offline);
    if (step_ == Step::kWriteRam) ram_only_.mark(tasks_.front());
  }
  under_way_ = false;
  ram_orders_ = true;
  if (step_ != Step::kNone && !recovering_) {
    if (!failed_) fail(offline, 0, step_ == Step::kWrite || step_ == Step::kWriteRam ? kWriteUnanswered : "");
    if (owes_switch_) result_.note = kNotPutBack;
    finish();
  }
  step_ = Step::kNone;
  recovering_ = false;
  while (!tasks_.empty()) {
    result_ = {};
    fail(offline, 0, "");
    finish();
  }
  try_recovery_ = owes_switch_;
}

}  // namespace nord_driver::drive
