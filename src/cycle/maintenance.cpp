#include "nord_driver/cycle/maintenance.h"

#include <utility>

#include "nord_driver/cycle/sentences.h"

namespace nord_driver::cycle {

Maintenance::Maintenance(std::vector<drive::Drive>& drives, std::vector<std::string> names)
    : drives_(drives), names_(std::move(names)) {}

template <typename Action>
void Maintenance::forEach(const Request& request, Action action) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (request.drive == kAllDrives || request.drive == i) action(i);
  }
}

void Maintenance::handleRequest(const Request& request, Instant now) noexcept {
  if (!jobs_.push_back({request, now + request.patience})) {
    return completions_.answer(request, false, "too many requests are being carried out already");
  }
  forEach(request, [&](DriveIndex i) {
    if (request.kind == RequestKind::kAcknowledge) {
      drives_[i].requestAcknowledge(now);
    } else {
      drives_[i].requestParameterSet(request.parameter_set, now);
    }
  });
}

void Maintenance::update(Instant now) noexcept {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    if (!follow(jobs_[i], now)) jobs_[kept++] = jobs_[i];
  }
  jobs_.resize(kept);
}

bool Maintenance::follow(const Job& job, Instant now) noexcept {
  bool busy = false;
  Sentence refused;
  forEach(job.request, [&](DriveIndex i) {
    const drive::RequestReport& report = reportOf(job.request, i);
    busy = busy || report.state == drive::RequestState::kRunning;
    if (refused.empty() && report.state == drive::RequestState::kRefused) {
      refused = refusalSentence(names_[i].c_str(), report.refusal, drives_[i].report());
    }
  });
  if (busy && now < job.deadline) return false;
  if (busy) {
    completions_.answer(job.request, false, "not confirmed in time");
  } else if (!refused.empty()) {
    completions_.answer(job.request, false, refused);
  } else if (job.request.kind == RequestKind::kAcknowledge) {
    completions_.answer(job.request, true, "no fault stands; the drives stay disabled until they are enabled");
  } else {
    Sentence text;
    text.format("parameter set %u is active", job.request.parameter_set);
    completions_.answer(job.request, true, text);
  }
  return true;
}

const drive::RequestReport& Maintenance::reportOf(const Request& request, DriveIndex drive) const noexcept {
  const drive::DriveReport& report = drives_[drive].report();
  return request.kind == RequestKind::kAcknowledge ? report.acknowledge : report.set_switch;
}

}  // namespace nord_driver::cycle
