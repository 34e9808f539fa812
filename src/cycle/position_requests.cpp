#include "cycle/position_requests.h"

#include <utility>

#include "cycle/user_messages.h"

namespace nord_driver::cycle {

using drive::Refusal;
using drive::RequestState;

namespace {

struct Texts {
  const char* what;  ///< a drive that follows velocities has none of
  const char* run;
};

Texts textsOf(RequestKind kind) noexcept {
  switch (kind) {
    case RequestKind::kTeach:
      return {"position to be taught", "teach-in"};
    case RequestKind::kResetPosition:
      return {"position to be reset", "resetting the position"};
    default:
      return {"reference run", "the reference run"};
  }
}

Sentence doneText(RequestKind kind, const char* name, double position) noexcept {
  Sentence text;
  switch (kind) {
    case RequestKind::kTeach:
      text.format("drive %s was told to take its position, %.6g, into its array", name, position);
      break;
    case RequestKind::kResetPosition:
      text.format("drive %s: its count was set anew, its position is %.6g", name, position);
      break;
    default:
      text.format("drive %s: the reference run has ended, its position is %.6g", name, position);
  }
  return text;
}

}  // namespace

PositionRequests::PositionRequests(std::vector<drive::Drive>& drives, const std::vector<Axis>& axes,
                                   std::vector<std::string> names)
    : drives_(drives), axes_(axes), names_(std::move(names)) {}

const drive::RequestReport& PositionRequests::reportOf(const Request& request) const noexcept {
  const drive::DriveReport& report = drives_[request.drive].report();
  if (request.kind == RequestKind::kResetPosition) return report.resetting;
  return request.kind == RequestKind::kTeach ? report.teaching : report.homing;
}

Sentence PositionRequests::refusalOf(const Request& request) const noexcept {
  const drive::Drive& drive = drives_[request.drive];
  const drive::DriveReport& report = drive.report();
  const char* const name = names_[request.drive].c_str();
  Sentence text;
  if (!drive.positions()) {
    text.format("drive %s follows velocities (mode: velocity): there is no %s", name, textsOf(request.kind).what);
  } else if (report.homing.state == RequestState::kRunning) {
    text.format("drive %s: a reference run is under way already", name);
  } else if (report.teaching.state == RequestState::kRunning) {
    text.format("drive %s: its position is being taught already", name);
  } else if (report.resetting.state == RequestState::kRunning) {
    text.format("drive %s: its position is being reset already", name);
  } else if (!report.online) {
    text = refusalMessage(name, Refusal::kOffline, report);
  } else {
    text = bitRefusal(request);
  }
  return text;
}

Sentence PositionRequests::bitRefusal(const Request& request) const noexcept {
  const Axis& axis = axes_[request.drive];
  const DeviceData& device = axis.parameters.device();
  const char* const name = names_[request.drive].c_str();
  const std::uint8_t set = drives_[request.drive].report().commanded_set;
  switch (request.kind) {
    case RequestKind::kTeach:
      return axis.bits.teachRefusal(name, device, set);
    case RequestKind::kResetPosition:
      return axis.bits.resetRefusal(name, device, set);
    default:
      return axis.bits.homeRefusal(name, device, set);
  }
}

void PositionRequests::handleRequest(const Request& request, Instant now) noexcept {
  if (request.drive >= drives_.size()) return completions_.answer(request, false, "of which drive?");
  const Sentence refusal = refusalOf(request);
  if (!refusal.empty()) return completions_.answer(request, false, refusal);
  const Job job{request, now + request.patience, ++last_token_};
  if (!jobs_.push_back(job)) {
    return completions_.answer(request, false, "too many requests are being carried out already");
  }
  drive::Drive& drive = drives_[request.drive];
  switch (request.kind) {
    case RequestKind::kTeach:
      return drive.requestTeaching(now, job.token);
    case RequestKind::kResetPosition:
      return drive.requestPositionReset(now, job.token);
    default:
      return drive.requestHoming(now, job.token);
  }
}

void PositionRequests::update(Instant now) noexcept {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    if (!follow(jobs_[i], now)) jobs_[kept++] = jobs_[i];
  }
  jobs_.resize(kept);
}

bool PositionRequests::follow(const Job& job, Instant now) noexcept {
  const drive::DriveReport& report = drives_[job.request.drive].report();
  const drive::RequestReport& asked = reportOf(job.request);
  const char* const name = names_[job.request.drive].c_str();
  Sentence text;
  if (asked.token == job.token && asked.state == RequestState::kRunning) {
    if (now < job.deadline) return false;
    text.format("drive %s: %s goes on, and has not ended in time", name, textsOf(job.request.kind).run);
    completions_.answer(job.request, false, text);
  } else if (asked.state == RequestState::kDone) {
    const double position = report.position.position.value_or(0.0);
    Completion done = answerTo(job.request, true, doneText(job.request.kind, name, position));
    if (job.request.kind == RequestKind::kTeach) {
      done.parameter.raw = axes_[job.request.drive].bits.inArray(position);
    }
    completions_.add(done);
  } else {
    completions_.answer(job.request, false, refusalMessage(name, asked.refusal, report));
  }
  return true;
}

}  // namespace nord_driver::cycle
