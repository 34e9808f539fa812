#include "cycle/position_requests.h"

#include <utility>

#include "cycle/user_messages.h"

namespace nord_driver::cycle {

using drive::Refusal;
using drive::RequestState;

PositionRequests::PositionRequests(std::vector<drive::Drive>& drives, const std::vector<Axis>& axes,
                                   std::vector<std::string> names)
    : drives_(drives), axes_(axes), names_(std::move(names)) {}

const drive::RequestReport& PositionRequests::reportOf(const Request& request) const noexcept {
  const drive::DriveReport& report = drives_[request.drive].report();
  return request.kind == RequestKind::kTeach ? report.teaching : report.homing;
}

Sentence PositionRequests::refusalOf(const Request& request) const noexcept {
  const drive::Drive& drive = drives_[request.drive];
  const drive::DriveReport& report = drive.report();
  const char* const name = names_[request.drive].c_str();
  const bool teaches = request.kind == RequestKind::kTeach;
  Sentence text;
  if (!drive.positions()) {
    text.format("drive %s follows velocities (mode: velocity): there is no %s", name,
                teaches ? "position to be taught" : "reference run");
  } else if (report.homing.state == RequestState::kRunning) {
    text.format("drive %s: a reference run is under way already", name);
  } else if (report.teaching.state == RequestState::kRunning) {
    text.format("drive %s: its position is being taught already", name);
  } else if (!report.online) {
    text = refusalMessage(name, Refusal::kOffline, report);
  } else {
    const Axis& axis = axes_[request.drive];
    const DeviceData& device = axis.parameters.device();
    text = teaches ? axis.bits.teachRefusal(name, device, report.commanded_set)
                   : axis.bits.homeRefusal(name, device, report.commanded_set);
  }
  return text;
}

void PositionRequests::handleRequest(const Request& request, Instant now) noexcept {
  if (request.drive >= drives_.size()) return completions_.answer(request, false, "of which drive?");
  const Sentence refusal = refusalOf(request);
  if (!refusal.empty()) return completions_.answer(request, false, refusal);
  const Job job{request, now + request.patience, ++last_token_};
  if (!jobs_.push_back(job)) {
    return completions_.answer(request, false, "too many requests are being carried out already");
  }
  if (request.kind == RequestKind::kTeach) {
    drives_[request.drive].requestTeaching(now, job.token);
  } else {
    drives_[request.drive].requestHoming(now, job.token);
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
  const bool teaches = job.request.kind == RequestKind::kTeach;
  const char* const name = names_[job.request.drive].c_str();
  Sentence text;
  if (asked.token == job.token && asked.state == RequestState::kRunning) {
    if (now < job.deadline) return false;
    text.format("drive %s: %s goes on, and has not ended in time", name, teaches ? "teach-in" : "the reference run");
    completions_.answer(job.request, false, text);
  } else if (asked.state == RequestState::kDone) {
    text.format(teaches ? "drive %s was told to take its position, %.6g, into its array"
                        : "drive %s: the reference run has ended, its position is %.6g",
                name, report.position.position.value_or(0.0));
    Completion done = answerTo(job.request, true, text);
    if (teaches) done.parameter.raw = axes_[job.request.drive].bits.inArray(report.position.position.value_or(0.0));
    completions_.add(done);
  } else {
    completions_.answer(job.request, false, refusalMessage(name, asked.refusal, report));
  }
  return true;
}

}  // namespace nord_driver::cycle
