#include "nord_driver/cycle/drive_parameters.h"

#include <utility>

#include "nord_driver/cycle/parameter_access.h"
#include "nord_driver/cycle/sentences.h"

namespace nord_driver::cycle {

namespace {

// An id tells the drive, the asker and which question of the asker it is: sequence | asker | drive.
constexpr unsigned kDriveBits = 8, kAskerBits = 2;
constexpr std::uint32_t kDriveMask = (1u << kDriveBits) - 1, kAskerMask = (1u << kAskerBits) - 1;

constexpr Duration kReasonInterval = std::chrono::milliseconds{500};
constexpr Duration kMissingInterval = std::chrono::seconds{2};

void forgetScale(drive::Drive& drive) noexcept {
  for (std::uint8_t set = 1; set <= 4; ++set) drive.setMaxFrequency(set, Hertz{});
}

}  // namespace

bool changesProcessData(const Request& request) noexcept {
  const std::uint16_t number = request.parameter.number;
  return request.kind == RequestKind::kWriteParameter && (number == 105 || (number >= 543 && number <= 548));
}

DriveParameters::DriveParameters(DriveIndex drive, std::string name, profile::Series series,
                                 std::optional<double> typed_max_frequency, TimeoutOwner owner)
    : drive_(drive), name_(std::move(name)), typed_max_frequency_(typed_max_frequency), reader_(series, owner) {}

void DriveParameters::handleState(drive::Drive& drive, Instant now) noexcept {
  const drive::DriveReport& report = drive.report();
  if (report.online) {
    faults_.handleStatus(profile::StatusWord{report.status_word});
    askForReason(drive, now);
    if (scale_due_ && !writesProcessData()) scale(drive);
    scale_due_ = false;
    return;
  }
  scale_due_ = false;
  open_ids_ = {};
  faults_.handleOffline();
  reader_.handleOffline();
  session_.handleOffline();
  collect();
  // Another inverter may come back in its place: nothing is enabled with what P105 was before.
  forgetScale(drive);
}

// An idle drive that 047E does not lead to "ready to switch on" has a reason; it is known before anybody asks for it.
void DriveParameters::askForReason(drive::Drive& drive, Instant now) noexcept {
  const drive::DriveReport& report = drive.report();
  const bool waiting = report.phase == drive::Phase::kIdle || report.phase == drive::Phase::kEnabling;
  const bool held = waiting && (report.state == profile::DriveState::kSwitchOnDisabled ||
                                report.state == profile::DriveState::kNotReadyToSwitchOn);
  // While it is read again, the one known before stands.
  if (!held || faults_.reasonState() != drive::ReasonState::kReading) {
    const bool known = held && faults_.reasonState() == drive::ReasonState::kKnown && faults_.reason() != 0;
    drive.setSwitchOnReason(known ? std::optional<std::uint16_t>{faults_.reason()} : std::nullopt);
  }
  if (!held) {
    held_since_.reset();
  } else if (!held_since_) {
    held_since_ = now;
  } else if (now - *held_since_ >= kReasonInterval) {
    held_since_ = now;
    faults_.requestReason();
  }
}

// P105 as read; as typed where the drive does not tell it.
void DriveParameters::scale(drive::Drive& drive) const noexcept {
  for (std::uint8_t set = 1; set <= 4; ++set) {
    const auto& read = reader_.data().max_frequency[set - 1u];
    if (read) {
      drive.setMaxFrequency(set, Hertz{*read});
    } else if (typed_max_frequency_ && reader_.maxFrequenciesAsked()) {
      drive.setMaxFrequency(set, Hertz{*typed_max_frequency_});
    }
  }
}

bool DriveParameters::writesProcessData() const noexcept {
  for (const Request& request : pending_) {
    if (changesProcessData(request)) return true;
  }
  return false;
}

void DriveParameters::readDeviceAgain() noexcept {
  // Its question under way may have been answered before the write.
  open_ids_[static_cast<std::size_t>(Asker::kReader)] = 0;
  reader_.handleOffline();
  scale_due_ = false;
}

void DriveParameters::handleRequest(const Request& request, drive::Drive& drive) noexcept {
  const drive::DriveReport& report = drive.report();
  if (!report.online) return refuse(request, profile::ParameterOutcome::kOffline);
  if (pending_.full() || !session_.submit(taskOf(request, report.parameter_set))) {
    return refuse(request, profile::ParameterOutcome::kBusy);
  }
  pending_.push_back(request);
  if (changesProcessData(request)) forgetScale(drive);
}

void DriveParameters::refuse(const Request& request, profile::ParameterOutcome outcome) noexcept {
  drive::ParameterTaskResult result;
  result.id = request.id;
  result.outcome = outcome;
  completions_.answer(request, false, parameterSentence(name_.c_str(), request.parameter.number, result));
}

std::optional<profile::ParameterRequest> DriveParameters::pollRequest(Instant now) noexcept {
  for (std::size_t i = 0; i < kAskers; ++i) {
    if (open_ids_[i] != 0) continue;
    auto request = ask(static_cast<Asker>(i), now);
    if (!request) continue;
    sequence_ += 1u << (kDriveBits + kAskerBits);
    request->id = sequence_ | static_cast<std::uint32_t>(i) << kDriveBits | static_cast<std::uint32_t>(drive_);
    if (request->id == 0) request->id = sequence_ += 1u << (kDriveBits + kAskerBits);
    open_ids_[i] = request->id;
    return request;
  }
  return std::nullopt;
}

std::optional<profile::ParameterRequest> DriveParameters::ask(Asker asker, Instant now) noexcept {
  switch (asker) {
    case Asker::kFaults:
      return faults_.pollRequest(now);
    case Asker::kSession:
      return session_.pollRequest();
    case Asker::kReader:
      askMissingAgain(now);
      return reader_.pollRequest();
    case Asker::kCount:
      break;
  }
  return std::nullopt;
}

// A parameter channel that was busy elsewhere for a second must not keep the drive from ever being enabled. Where a
// P105 was typed it has taken the place of the missing one, and another scale could be a step of the speed.
void DriveParameters::askMissingAgain(Instant now) noexcept {
  if (typed_max_frequency_ || !reader_.missesMaxFrequency()) {
    missing_since_.reset();
  } else if (!missing_since_) {
    missing_since_ = now;
  } else if (now - *missing_since_ >= kMissingInterval) {
    missing_since_.reset();
    reader_.askMissingAgain();
  }
}

bool DriveParameters::handleResult(const profile::ParameterResult& result) noexcept {
  if ((result.id & kDriveMask) != drive_) return false;
  const std::size_t asker = result.id >> kDriveBits & kAskerMask;
  // An answer from before a loss must not pass for the answer to the question after it.
  if (asker >= kAskers || open_ids_[asker] != result.id) return true;
  open_ids_[asker] = 0;
  answer(static_cast<Asker>(asker), result);
  return true;
}

void DriveParameters::answer(Asker asker, const profile::ParameterResult& result) noexcept {
  switch (asker) {
    case Asker::kFaults:
      return faults_.handleResult(result);
    case Asker::kSession:
      session_.handleResult(result);
      return collect();
    case Asker::kReader:
      scale_due_ = true;  // not before: what was read before a loss is not what the drive has now
      return reader_.handleResult(result);
    case Asker::kCount:
      return;
  }
}

void DriveParameters::collect() noexcept {
  while (const auto result = session_.pollResult()) {
    for (std::size_t i = 0; i < pending_.size(); ++i) {
      if (pending_[i].id != result->id) continue;
      Completion completion = answerTo(pending_[i], result->outcome == profile::ParameterOutcome::kDone,
                                       parameterSentence(name_.c_str(), pending_[i].parameter.number, *result));
      completion.raw = result->raw;
      completions_.add(completion);
      // Whatever became of it: a write without an answer may have been carried out.
      if (changesProcessData(pending_[i])) readDeviceAgain();
      for (std::size_t j = i + 1; j < pending_.size(); ++j) pending_[j - 1] = pending_[j];
      pending_.resize(pending_.size() - 1);
      break;
    }
  }
}

}  // namespace nord_driver::cycle
