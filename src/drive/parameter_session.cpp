#include "drive/parameter_session.h"

#include "drive/parameter_notes.h"
#include "profile/module_parameters.h"

namespace nord_driver::drive {

using profile::isOfModule;
using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterRequest;
using profile::ParameterResult;
using profile::ParameterShape;

namespace {

constexpr std::uint8_t kSwitchTries = 2;

// A word comes back with its high word 0 or, negative, FFFF; with anything else there the parameter is a double word.
bool isValue(const ParameterRequest& request, std::int32_t raw) noexcept {
  if (request.double_word) return raw == request.raw;
  const std::uint32_t high = static_cast<std::uint32_t>(raw) >> 16;
  const std::uint32_t difference = static_cast<std::uint32_t>(raw) ^ static_cast<std::uint32_t>(request.raw);
  return (high == 0 || high == 0xFFFFu) && (difference & 0xFFFFu) == 0;
}

// Not carried out for certain; everything else may have been.
bool surelyNotDone(ParameterOutcome outcome) noexcept {
  return outcome == ParameterOutcome::kRefused || outcome == ParameterOutcome::kBusy ||
         outcome == ParameterOutcome::kNoChannel;
}

bool isDone(const ParameterResult& result) noexcept {
  return result.outcome == ParameterOutcome::kDone;
}

bool isRefused(const ParameterResult& result, ParameterReason reason) noexcept {
  return result.outcome == ParameterOutcome::kRefused && result.reason == reason;
}

}  // namespace

bool ParameterSession::submit(const ParameterRequest& request) noexcept {
  if (!requests_.submit(request)) return false;
  if (requests_.size() == 1 && owesEepromSwitch()) switch_ = EepromSwitch::kRetryDue;
  return true;
}

// --- Handing out

void ParameterSession::begin() noexcept {
  run_ = {};
  run_.recovery = switch_ == EepromSwitch::kRetryDue;
  if (run_.recovery) {
    step_ = Step::kReadSwitch;
  } else if (!requests_.empty()) {
    step_ = Step::kReadValue;
  }
}

std::optional<ParameterRequest> ParameterSession::pollRequest(unsigned lane) noexcept {
  if (under_way_) return lane == lane_ ? std::nullopt : readAhead(lane);
  if (step_ == Step::kNone) begin();
  if (step_ == Step::kNone) return std::nullopt;
  if (step_ == Step::kSwitchOff && !owesEepromSwitch()) switch_ = EepromSwitch::kOwed;
  under_way_ = true;
  lane_ = lane;
  return requestFor(step_);
}

std::optional<ParameterRequest> ParameterSession::readAhead(unsigned lane) noexcept {
  const bool reads = step_ == Step::kReadValue && !run_.recovery && requests_.front().action == ParameterAction::kRead;
  if (!reads || owesEepromSwitch() || ahead_.full()) return std::nullopt;
  for (const Ahead& other : ahead_) {
    if (other.lane == lane) return std::nullopt;
  }
  // The one channel of a module has the other drives' requests to carry, too.
  const ParameterRequest* next = requests_.at(1 + ahead_.size());
  if (next == nullptr || next->action != ParameterAction::kRead || isOfModule(next->number)) return std::nullopt;
  ahead_.push_back(Ahead{lane, std::nullopt});
  return *next;
}

// What was read ahead is the running one now.
void ParameterSession::beginAhead() noexcept {
  const auto ahead = ahead_.takeFront();
  if (!ahead) return;
  run_ = {};
  step_ = Step::kReadValue;
  under_way_ = true;
  lane_ = ahead->lane;
  if (ahead->result) handleResult(*ahead->result, ahead->lane);
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
  const ParameterRequest& asked = requests_.front();
  request.number = asked.number;
  request.shape = run_.no_index ? ParameterShape::kPlain : asked.shape;
  request.parameter_set = asked.parameter_set;
  request.index = asked.index;
  request.scales = asked.scales;
  if (request.action != ParameterAction::kRead) {
    request.double_word = asked.double_word;
    request.raw = asked.raw;
  }
  return request;
}

// --- Results

void ParameterSession::handleResult(const ParameterResult& result, unsigned lane) noexcept {
  for (Ahead& ahead : ahead_) {
    if (ahead.lane != lane) continue;
    ahead.result = result;
    return;
  }
  if (!under_way_ || lane != lane_) return;
  under_way_ = false;
  switch (step_) {
    case Step::kNone:
      return;
    case Step::kReadValue:
      return handleValue(result);
    case Step::kWriteRam:
      return handleRamWrite(result);
    case Step::kReadSwitch:
      return run_.recovery ? handleRecoverySwitch(result) : handleSwitch(result);
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
  const ParameterRequest& request = requests_.front();
  const bool write = request.action != ParameterAction::kRead;
  if (!isDone(result)) {
    fail(result, request.number, write ? kNotRead : "");
    return finish();
  }
  run_.result.raw = result.raw;
  const bool persistent = request.action == ParameterAction::kWritePersistent;
  const bool may_be_ram = persistent && (request.even_if_same || ram_only_.holds(request));
  const bool same = write && isValue(request, result.raw) && !may_be_ram;
  if (!write || same) {
    run_.result.outcome = ParameterOutcome::kDone;
    if (same) run_.result.note = kSame;
    if (same && persistent && request.number == kSaveInEeprom) switch_ = EepromSwitch::kNotOurs;
    return finish();
  }
  if (persistent) {
    // P560 is the inverter's: a module saves what it is not told otherwise (BU 0280 4.1.1).
    step_ = request.number == kSaveInEeprom || isOfModule(request.number) ? Step::kWrite : Step::kReadSwitch;
  } else if (isOfModule(request.number) ? capabilities_.ram_writes : ram_writes_) {
    step_ = Step::kWriteRam;
  } else {
    writePlainly();
  }
}

void ParameterSession::handleRamWrite(const ParameterResult& result) noexcept {
  if (!surelyNotDone(result.outcome)) ram_only_.mark(requests_.front(), run_.no_index);
  if (isDone(result)) {
    step_ = Step::kReadBack;
  } else if (isRefused(result, ParameterReason::kNotSupported)) {
    ram_writes_ = ram_writes_ && isOfModule(requests_.front().number);  // the orders of one are not those of the other
    writePlainly();
  } else if (!retryWithoutIndex(result)) {
    fail(result, requests_.front().number, surelyNotDone(result.outcome) ? "" : kWriteUnanswered);
    finish();
  }
}

void ParameterSession::writePlainly() noexcept {
  const std::uint16_t number = requests_.front().number;
  if (number != kSaveInEeprom && !isOfModule(number)) {
    step_ = Step::kReadSwitch;
    return;
  }
  refuse(number == kSaveInEeprom ? kSwitchItself : kModuleSaves);
  finish();
}

void ParameterSession::handleRecoverySwitch(const ParameterResult& result) noexcept {
  if (isDone(result) && result.raw == 0) {
    step_ = Step::kSwitchOn;
    return;
  }
  if (isDone(result)) switch_ = EepromSwitch::kNotOurs;
  finish();
}

void ParameterSession::handleSwitch(const ParameterResult& result) noexcept {
  const bool persistent = requests_.front().action == ParameterAction::kWritePersistent;
  const bool off = isDone(result) && result.raw == 0;
  if (isDone(result) && !off) switch_ = EepromSwitch::kNotOurs;
  if (isRefused(result, ParameterReason::kNoSuchParameter)) {
    if (persistent && !run_.withdrawn) {
      run_.result.note = kNoSwitch;
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
  if (run_.withdrawn || (persistent && off)) {
    refuse(owesEepromSwitch() ? kNotPutBack : kWouldBeLost);
    return finish();
  }
  run_.switch_was_off = off && !owesEepromSwitch();
  if (run_.switch_was_off) run_.result.note = kWasOff;
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
  if (write && surelyNotDone(result.outcome)) switch_ = EepromSwitch::kNotOurs;
  putBackOrFinish();
}

void ParameterSession::handleWrite(const ParameterResult& result) noexcept {
  countValueWrite(result);
  if (!isDone(result)) {
    if (retryWithoutIndex(result)) return;
    fail(result, requests_.front().number, surelyNotDone(result.outcome) ? "" : kWriteUnanswered);
  }
  putBackOrFinish();
}

// The value has been written, or not: first of all P560 goes back to what it was.
void ParameterSession::putBackOrFinish() noexcept {
  if (owesEepromSwitch()) {
    step_ = Step::kSwitchOn;
  } else if (run_.failed) {
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
    switch_ = EepromSwitch::kNotOurs;
    if (run_.recovery) return finish();
    if (!run_.failed) run_.result.note = kToggled;
    return putBackOrFinish();
  }
  if (++run_.switch_tries < kSwitchTries) {
    step_ = Step::kSwitchOn;
    return;
  }
  if (!run_.recovery) {
    if (!run_.failed) isDone(result) ? refuse(kNotPutBack) : fail(result, kSaveInEeprom, kNotPutBack);
    run_.result.note = kNotPutBack;
  }
  finish();
}

void ParameterSession::handleReadBack(const ParameterResult& result) noexcept {
  const ParameterRequest& request = requests_.front();
  if (!isDone(result)) {
    fail(result, request.number, kNotReadBack);
  } else {
    run_.result.raw = result.raw;
    run_.result.outcome = ParameterOutcome::kDone;
    if (!isValue(request, result.raw)) refuse(kDiffers);
  }
  if (!run_.failed && request.action == ParameterAction::kWritePersistent) ram_only_.unmark(request, run_.no_index);
  finish();
}

// A parameter that was taken for set-dependent and is not; reads fall back by themselves.
bool ParameterSession::retryWithoutIndex(const ParameterResult& result) noexcept {
  if (run_.no_index || !isRefused(result, ParameterReason::kNotIndexed)) return false;
  run_.no_index = requests_.front().shape == ParameterShape::kPerSet;
  return run_.no_index;
}

void ParameterSession::fail(const ParameterResult& result, std::uint16_t number, const char* note) noexcept {
  run_.failed = true;
  run_.result.outcome = result.outcome;
  run_.result.reason = result.reason;
  run_.result.text = result.text;
  run_.result.note = note;
  if (result.outcome == ParameterOutcome::kRefused) run_.result.refused_number = number;
}

void ParameterSession::refuse(const char* note) noexcept {
  run_.failed = true;
  run_.result.outcome = ParameterOutcome::kRefused;
  run_.result.reason = ParameterReason::kDriver;
  run_.result.note = note;
}

void ParameterSession::finish() noexcept {
  step_ = Step::kNone;
  const bool others_wait = !run_.recovery && requests_.size() > 1;
  if (owesEepromSwitch()) switch_ = others_wait ? EepromSwitch::kRetryDue : EepromSwitch::kOwed;
  if (!run_.recovery) requests_.finish(run_.result);
  beginAhead();
}

void ParameterSession::countWrite(const ParameterResult& result) noexcept {
  if (surelyNotDone(result.outcome)) return;
  ++eeprom_writes_;
  run_.result.eeprom_written = true;
}

void ParameterSession::countValueWrite(const ParameterResult& result) noexcept {
  const ParameterRequest& request = requests_.front();
  const bool is_switch = request.number == kSaveInEeprom;
  const bool saved = isSaved();
  // P560 is the user's from then on: a 0 that may have arrived is not undone, a 1 that may not have is still owed.
  const bool decided = isDone(result) || (request.raw == 0 && !surelyNotDone(result.outcome));
  if (is_switch && decided) switch_ = EepromSwitch::kNotOurs;
  if (saved) return countWrite(result);
  if (!surelyNotDone(result.outcome)) ram_only_.mark(requests_.front(), run_.no_index);
}

void ParameterSession::handleOffline() noexcept {
  ParameterResult offline;
  offline.outcome = ParameterOutcome::kOffline;
  ahead_.clear();
  // What is under way may still be carried out.
  if (under_way_) {
    if (step_ == Step::kSwitchOff || step_ == Step::kSwitchOn) countWrite(offline);
    if (step_ == Step::kWrite) countValueWrite(offline);
    if (step_ == Step::kWriteRam) ram_only_.mark(requests_.front(), run_.no_index);
  }
  under_way_ = false;
  ram_writes_ = capabilities_.ram_writes;
  if (step_ != Step::kNone && !run_.recovery) {
    if (!run_.failed) fail(offline, 0, step_ == Step::kWrite || step_ == Step::kWriteRam ? kWriteUnanswered : "");
    if (owesEepromSwitch()) run_.result.note = kNotPutBack;
    finish();
  }
  step_ = Step::kNone;
  while (!requests_.empty()) {
    run_ = {};
    fail(offline, 0, "");
    finish();
  }
  if (owesEepromSwitch()) switch_ = EepromSwitch::kRetryDue;
}

}  // namespace nord_driver::drive
