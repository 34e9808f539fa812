#include "cycle/standstill_requests.h"

#include <utility>

#include "cycle/user_messages.h"

namespace nord_driver::cycle {

namespace {

// One P151 watches up to four inverters, and the module stays in its time-out until all of them are acknowledged
// (BU 0220 4.2.3.2).
Sentence withNeighbour(const Sentence& answer, const char* neighbour) noexcept {
  Sentence text;
  text.format("%.120s; drive %s behind the same bus module has a fault too: after a time-out all must be acknowledged",
              answer.c_str(), neighbour);
  return text;
}

bool hasFault(const drive::DriveReport& report) noexcept {
  return report.fault_latched || (report.online && profile::StatusWord{report.status_word}.fault());
}

}  // namespace

StandstillRequests::StandstillRequests(std::vector<drive::Drive>& drives, std::vector<std::string> names,
                                       std::vector<std::optional<std::size_t>> modules)
    : drives_(drives), names_(std::move(names)), modules_(std::move(modules)) {
  modules_.resize(drives_.size());
}

template <typename Action>
void StandstillRequests::forEach(const Request& request, Action action) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (request.drive == kAllDrives || request.drive == i) action(i);
  }
}

void StandstillRequests::handleRequest(const Request& request, Instant now) noexcept {
  update(now);  // what a stop has just ended is answered before the drives' reports are about another request
  Job job{request, now + request.patience, ++last_token_, {}, false, {}};
  if (jobs_.full()) return completions_.answer(request, false, "too many requests are being carried out already");
  forEach(request, [&](DriveIndex i) {
    job.fault_stood = job.fault_stood || hasFault(drives_[i].report());
    const Sentence busy = othersRequest(request.kind, i);
    if (!busy.empty()) {
      if (job.refusal.empty()) job.refusal = busy;
    } else if (request.kind == RequestKind::kAcknowledge) {
      drives_[i].requestAcknowledge(now, job.token);
    } else {
      drives_[i].requestParameterSet(request.parameter_set, now, job.token);
    }
  });
  jobs_.push_back(job);
}

Sentence StandstillRequests::othersRequest(RequestKind kind, DriveIndex drive) const noexcept {
  const drive::DriveReport& report = drives_[drive].report();
  Sentence text;
  if (kind == RequestKind::kAcknowledge && report.phase == drive::Phase::kAcknowledging) {
    text.format("drive %s: a fault is being acknowledged: ask again", names_[drive].c_str());
  } else if (kind == RequestKind::kSelectParameterSet && report.phase == drive::Phase::kSwitchingSet) {
    text.format("drive %s: a switch to parameter set %u is running: ask again", names_[drive].c_str(),
                unsigned{report.commanded_set});
  }
  return text;
}

void StandstillRequests::update(Instant now) noexcept {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    if (!follow(jobs_[i], now)) jobs_[kept++] = jobs_[i];
  }
  jobs_.resize(kept);
}

bool StandstillRequests::follow(Job& job, Instant now) noexcept {
  std::optional<DriveIndex> busy;
  Sentence refused = job.refusal;
  forEach(job.request, [&](DriveIndex i) {
    const drive::RequestReport& report = reportOf(job.request, i);
    const auto refuse = [&](drive::Refusal why) {
      if (refused.empty()) refused = refusalMessage(names_[i].c_str(), why, drives_[i].report());
    };
    const std::size_t bit = i % job.ended.size();
    if (report.token == job.token) {
      job.ended[bit] = report.state != drive::RequestState::kRunning;
      if (!job.ended[bit] && !busy) busy = i;
      if (report.state == drive::RequestState::kRefused) {
        refuse(report.refusal);
        job.refusal = refused;
      }
    } else if (!job.ended[bit]) {  // of another request: this one's drive was busy
      return refuse(drive::Refusal::kBusy);
    }
    // Acknowledged, and in the same cycle there is the next one.
    const bool again = job.request.kind == RequestKind::kAcknowledge && drives_[i].report().fault_latched;
    if (job.ended[bit] && again) refuse(drive::Refusal::kFault);
  });
  if (busy && now < job.deadline) return false;
  if (busy) {
    completions_.answer(job.request, false, unconfirmed(job.request, *busy));
  } else if (job.request.kind == RequestKind::kAcknowledge) {
    const Sentence answer = refused.empty() ? acknowledged(job) : refused;
    const auto neighbour = faultedNeighbour(job.request);
    completions_.answer(job.request, refused.empty(),
                        neighbour ? withNeighbour(answer, names_[*neighbour].c_str()) : answer);
  } else if (!refused.empty()) {
    completions_.answer(job.request, false, refused);
  } else {
    Sentence text;
    text.format("parameter set %u is active", job.request.parameter_set);
    completions_.answer(job.request, true, text);
  }
  return true;
}

Sentence StandstillRequests::unconfirmed(const Request& request, DriveIndex drive) const noexcept {
  const drive::DriveReport& report = drives_[drive].report();
  const Sentence text = unconfirmedMessage(names_[drive].c_str(), report);
  if (request.kind != RequestKind::kSelectParameterSet || !report.online) return text;
  Sentence longer;
  longer.format("%s; parameter set %u is in force, %u was asked for", text.c_str(), unsigned{report.parameter_set},
                unsigned{request.parameter_set});
  return longer;
}

const char* StandstillRequests::acknowledged(const Job& job) noexcept {
  if (!job.fault_stood) return "no fault stood, and nothing was done";
  bool one_is_enabled = false;
  forEach(job.request,
          [&](DriveIndex i) { one_is_enabled = one_is_enabled || drive::isEnabled(drives_[i].report().phase); });
  return one_is_enabled ? "no fault stands; the drive that had one stays disabled until it is enabled"
                        : "no fault stands; the drives stay disabled until they are enabled";
}

std::optional<DriveIndex> StandstillRequests::faultedNeighbour(const Request& request) const noexcept {
  if (request.drive == kAllDrives || !modules_[request.drive]) return std::nullopt;
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    const drive::DriveReport& report = drives_[i].report();
    if (i != request.drive && modules_[i] == modules_[request.drive] && report.online && report.fault_latched) return i;
  }
  return std::nullopt;
}

const drive::RequestReport& StandstillRequests::reportOf(const Request& request, DriveIndex drive) const noexcept {
  const drive::DriveReport& report = drives_[drive].report();
  return request.kind == RequestKind::kAcknowledge ? report.acknowledge : report.set_switch;
}

}  // namespace nord_driver::cycle
