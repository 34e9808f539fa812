#include "tools/restore/restore_run.h"

#include <algorithm>
#include <utility>

#include "tools/comparison.h"
#include "tools/patient_access.h"

namespace nord_driver::tools {

namespace {

constexpr std::uint16_t kSaveInEeprom = 560;

catalogue::ParameterAddress eepromSwitch() {
  catalogue::ParameterAddress address;
  address.number = kSaveInEeprom;
  return address;
}

}  // namespace

RestoreRun::RestoreRun(DriveParameters& drive, RestoreRecord& record, Save save, const std::atomic<bool>& end_asked)
    : drive_(drive), record_(record), save_(std::move(save)), end_asked_(end_asked) {}

void RestoreRun::breakOff(const std::string& why) const {
  std::size_t written = 0;
  for (const RestoreRecord::Change& change : record_.changes) written += change.state == ChangeState::kWritten ? 1 : 0;
  const std::string taking =
      record_.state == RestoreState::kTakingBack
          ? "; it is not taken back as a whole: nord_param restore " + drive_.name() + " --take-back goes on with that"
          : "; " + std::to_string(written) + " of " + std::to_string(record_.changes.size()) +
                " are written: nord_param restore " + drive_.name() +
                " --resume goes on, --take-back puts back what was there";
  throw Trouble(why + taking);
}

// Somebody else may enable the drive while a hundred values are written.
void RestoreRun::requireRest() const {
  std::string moving;
  try {
    moving = drive_.notAtRest();
  } catch (const Trouble& trouble) {
    moving = trouble.what();
  }
  if (!moving.empty()) breakOff(moving);
}

// What ends the link to the drive ends the run, and so does what goes on being refused for the moment only.
ParameterAnswer RestoreRun::asked(const std::function<ParameterAnswer()>& access) {
  if (end_asked_) breakOff("ended");
  ParameterAnswer answer;
  try {
    answer = askPatiently(drive_, access);
  } catch (const Trouble& trouble) {
    breakOff(trouble.what());
  }
  if (!answer.success && !answer.refused) breakOff(answer.message);
  return answer;
}

ParameterAnswer RestoreRun::read(const catalogue::ParameterAddress& address) {
  return asked([&] { return drive_.read(address); });
}

ParameterAnswer RestoreRun::write(const catalogue::ParameterAddress& address, std::int32_t raw, bool persistent) {
  catalogue::ParameterAccess access = catalogue::accessTo(address, drive_.known());
  ParameterAnswer refused;
  refused.refused = true;
  refused.message = access.error.empty() ? catalogue::setRaw(access, raw, persistent) : access.error;
  if (!refused.message.empty()) return refused;
  ParameterAnswer answer = asked([&] { return drive_.write(access); });
  if (answer.used_up) breakOff(answer.message);  // taking back would be refused as well
  return answer;
}

bool RestoreRun::same(const catalogue::ParameterAddress& address, std::int32_t first, std::int32_t second) const {
  return meansSame(drive_.known(), address, first, second);
}

std::string RestoreRun::text(const catalogue::ParameterAddress& address, std::int32_t raw) const {
  return rawText(drive_.known(), address, raw);
}

std::string RestoreRun::title(const catalogue::ParameterAddress& address) const {
  return parameterTitle(address, drive_.known());
}

// A run that was killed between two steps of a RAM write leaves P560 = 0, and nobody saves anything any more.
void RestoreRun::lookAtEepromSwitch() {
  const ParameterAnswer answer = read(eepromSwitch());
  if (!answer.success) return;
  if (!record_.eeprom_switch) {
    record_.eeprom_switch = answer.raw;
  } else if (*record_.eeprom_switch != 0 && answer.raw == 0) {
    const ParameterAnswer written = write(eepromSwitch(), *record_.eeprom_switch, true);
    notes_.push_back(written.success
                         ? "P560 was left at 0 by the run before, and is 1 again"
                         : "P560 was left at 0 by the run before and cannot be put back to 1: " + written.message);
  }
}

void RestoreRun::lookAgain() {
  lookAtEepromSwitch();
  for (RestoreRecord::Change& change : record_.changes) {
    if (change.state != ChangeState::kBegun && change.state != ChangeState::kWritten) continue;
    const ParameterAnswer answer = read(change.address);
    const bool as_before = answer.success && same(change.address, answer.raw, change.before);
    if (answer.success && same(change.address, answer.raw, change.after)) {
      // Had it been this value before, nobody could tell by it that the value was saved.
      const bool saved = change.state == ChangeState::kWritten || !record_.persistent || !as_before;
      change.state = saved ? ChangeState::kWritten : ChangeState::kPending;
      continue;
    }
    if (answer.success && !as_before) {
      notes_.push_back(title(change.address) + " is " + text(change.address, answer.raw) +
                       ", neither what was there nor what was to come");
    } else if (as_before && change.state == ChangeState::kWritten) {
      notes_.push_back(title(change.address) + " was written and is " + text(change.address, answer.raw) + " again" +
                       (record_.persistent ? "" : ": what is in RAM only is lost when the drive is switched off"));
    }
    change.state = as_before ? ChangeState::kPending : ChangeState::kBegun;
  }
}

std::string RestoreRun::carryOut(RestoreRecord::Change& change) {
  if (change.state == ChangeState::kWritten) return {};
  if (end_asked_) breakOff("ended");  // before the journal says that it has begun
  requireRest();
  change.state = ChangeState::kBegun;
  save_(record_);
  const ParameterAnswer answer = write(change.address, change.after, record_.persistent);
  if (!answer.success) return title(change.address) + ": " + answer.message;
  change.state = ChangeState::kWritten;
  return {};
}

RestoreEnd RestoreRun::write() {
  record_.state = RestoreState::kWriting;
  lookAtEepromSwitch();
  save_(record_);
  bool verified = false;
  for (RestoreRecord::Change& change : record_.changes) {
    // From then on nobody can tell for certain that the drive still answers.
    if (!verified && stageOf(change.address.number) == RestoreStage::kReach) {
      verified = verify();
      if (!verified) return RestoreEnd::kDiffers;
    }
    const std::string refusal = carryOut(change);
    if (!refusal.empty()) return takeBackBecause(refusal);
  }
  if (!verified && !verify()) return RestoreEnd::kDiffers;
  record_.state = RestoreState::kVerified;
  save_(record_);
  return RestoreEnd::kVerified;
}

// What one parameter does to another, and what a drive that was switched off meanwhile has lost, shows only now.
bool RestoreRun::verify() {
  save_(record_);
  const std::size_t notes_before = notes_.size();
  for (RestoreRecord::Change& change : record_.changes) {
    if (change.state != ChangeState::kWritten) continue;
    const ParameterAnswer answer = read(change.address);
    if (answer.success && same(change.address, answer.raw, change.after)) continue;
    const bool as_before = answer.success && same(change.address, answer.raw, change.before);
    const std::string lost = as_before && !record_.persistent ? " as before: was the drive switched off?" : "";
    notes_.push_back(title(change.address) + " was written as " + text(change.address, change.after) + " and is " +
                     (answer.success ? text(change.address, answer.raw) + lost : "not readable: " + answer.message));
    change.state = as_before ? ChangeState::kPending : ChangeState::kBegun;  // taking back has to look at it
  }
  std::vector<Dump::Value> still_same;
  for (const Dump::Value& value : record_.same) {
    const ParameterAnswer answer = read(value.address);
    if (answer.success && !same(value.address, answer.raw, value.raw)) {
      notes_.push_back(title(value.address) + " was " + text(value.address, value.raw) + " and is " +
                       text(value.address, answer.raw) + " now");
      RestoreRecord::Change change;
      change.address = value.address;
      change.before = change.after = value.raw;
      change.state = ChangeState::kBegun;
      record_.changes.push_back(change);
    } else {
      still_same.push_back(value);
    }
  }
  record_.same = still_same;
  save_(record_);
  return notes_.size() == notes_before;
}

RestoreEnd RestoreRun::takeBackBecause(const std::string& why) {
  record_.why = why;
  return takeBack();
}

RestoreEnd RestoreRun::takeBack() {
  record_.state = RestoreState::kTakingBack;
  save_(record_);
  lookAtEepromSwitch();
  bool whole = true, tried_all = true;
  for (auto change = record_.changes.rbegin(); change != record_.changes.rend(); ++change) {
    if (change->state != ChangeState::kBegun && change->state != ChangeState::kWritten) continue;
    const TakenBack taken = takeBack(*change);
    whole = whole && taken == TakenBack::kYes;
    tried_all = tried_all && taken != TakenBack::kRefused;
    save_(record_);
  }
  if (tried_all) record_.state = RestoreState::kTakenBack;
  save_(record_);
  return whole ? RestoreEnd::kTakenBack : RestoreEnd::kTakenBackInPart;
}

RestoreRun::TakenBack RestoreRun::takeBack(RestoreRecord::Change& change) {
  const ParameterAnswer found = read(change.address);
  const bool there = found.success && same(change.address, found.raw, change.before);
  if (!there && found.success && !same(change.address, found.raw, change.after)) {
    notes_.push_back(title(change.address) + " is " + text(change.address, found.raw) +
                     ", which this restore has not written: it is left as it is");
    return TakenBack::kLeft;
  }
  ParameterAnswer answer = found;
  if (!there && found.success) {
    requireRest();
    answer = write(change.address, change.before, record_.persistent);
  }
  if (!answer.success) {
    notes_.push_back(title(change.address) + " cannot be put back to " + text(change.address, change.before) + ": " +
                     answer.message);
    return TakenBack::kRefused;
  }
  change.state = ChangeState::kTakenBack;
  return TakenBack::kYes;
}

std::size_t accessesOf(const RestoreRecord& record) {
  const auto pending =
      std::count_if(record.changes.begin(), record.changes.end(),
                    [](const RestoreRecord::Change& change) { return change.state != ChangeState::kWritten; });
  return static_cast<std::size_t>(pending) + record.changes.size() + record.same.size() + 1;
}

}  // namespace nord_driver::tools
