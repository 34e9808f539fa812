#include "cycle/position_requests.h"

#include <utility>

#include "cycle/user_messages.h"

namespace nord_driver::cycle {

using drive::Refusal;
using drive::RequestState;

PositionRequests::PositionRequests(std::vector<drive::Drive>& drives, const std::vector<Axis>& axes,
                                   std::vector<std::string> names)
    : drives_(drives), axes_(axes), names_(std::move(names)) {}

Sentence PositionRequests::refusalOf(DriveIndex drive) const noexcept {
  const drive::DriveReport& report = drives_[drive].report();
  const char* const name = names_[drive].c_str();
  Sentence text;
  if (!drives_[drive].positions()) {
    text.format("drive %s follows velocities (mode: velocity): there is no reference run", name);
  } else if (report.homing.state == RequestState::kRunning) {
    text.format("drive %s: a reference run is under way already", name);
  } else if (!report.online) {
    text = refusalMessage(name, Refusal::kOffline, report);
  } else {
    text = axes_[drive].bits.homeRefusal(name, axes_[drive].parameters.device(), report.commanded_set);
  }
  return text;
}

void PositionRequests::handleRequest(const Request& request, Instant now) noexcept {
  if (request.drive >= drives_.size()) return completions_.answer(request, false, "of which drive?");
  const Sentence refusal = refusalOf(request.drive);
  if (!refusal.empty()) return completions_.answer(request, false, refusal);
  const Job job{request, now + request.patience, ++last_token_};
  if (!jobs_.push_back(job)) {
    return completions_.answer(request, false, "too many requests are being carried out already");
  }
  drives_[request.drive].requestHoming(now, job.token);
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
  const char* const name = names_[job.request.drive].c_str();
  Sentence text;
  if (report.homing.token == job.token && report.homing.state == RequestState::kRunning) {
    if (now < job.deadline) return false;
    text.format("drive %s: the reference run goes on, and has not ended in time", name);
    completions_.answer(job.request, false, text);
  } else if (report.homing.state == RequestState::kDone) {
    text.format("drive %s: the reference run has ended, its position is %.6g", name,
                report.position.position.value_or(0.0));
    completions_.answer(job.request, true, text);
  } else {
    completions_.answer(job.request, false, refusalMessage(name, report.homing.refusal, report));
  }
  return true;
}

}  // namespace nord_driver::cycle
