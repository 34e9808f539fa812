#include "node/stop_calls.h"

#include <algorithm>
#include <utility>

namespace nord_driver::node {

using cycle::RequestKind;

namespace {

// Of the lane of ~enable: kept for stops.
constexpr std::uint32_t kKeptForStops = 2;

/// Counts a call as long as it is carried out.
class Counted {
 public:
  explicit Counted(std::atomic<std::uint32_t>& calls) noexcept : calls_(calls), now_(++calls) {}
  ~Counted() { --calls_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

  /// With itself, when it came.
  std::uint32_t count() const noexcept { return now_; }

 private:
  std::atomic<std::uint32_t>& calls_;
  std::uint32_t now_;
};

}  // namespace

StopCalls::StopCalls(std::size_t drives, Duration patience, CarryOut carry_out)
    : patience_(patience), carry_out_(std::move(carry_out)) {
  enabling_.threads = enableThreads(drives);
  quick_stops_.threads = quickStopThreads(drives);
}

// All drives can be enabled one by one at the same time, and the base.
std::uint32_t StopCalls::enableThreads(std::size_t drives) noexcept {
  return std::max<std::uint32_t>(static_cast<std::uint32_t>(drives) + 1 + kKeptForStops, 8);
}

std::uint32_t StopCalls::quickStopThreads(std::size_t drives) noexcept {
  return static_cast<std::uint32_t>(drives) + 2;
}

cycle::Completion StopCalls::enable(bool on, DriveIndex drive) {
  return on ? enableIfFree(drive) : stop(enabling_, RequestKind::kDisable, drive);
}

cycle::Completion StopCalls::quickStop(DriveIndex drive) {
  return stop(quick_stops_, RequestKind::kQuickStop, drive);
}

cycle::Completion StopCalls::enableIfFree(DriveIndex drive) {
  const Counted call{enabling_.calls};
  if (call.count() <= enabling_.threads - kKeptForStops) return carryOut(RequestKind::kEnable, drive, patience_);
  cycle::Completion refusal;
  refusal.message = "too many calls wait for their drives already: ask again";
  return refusal;
}

cycle::Completion StopCalls::stop(Lane& lane, RequestKind kind, DriveIndex drive) {
  const Counted call{lane.calls};
  if (call.count() < lane.threads) return carryOut(kind, drive, patience_);
  // The last thread: the cycle begins the stop and answers in the same cycle.
  cycle::Completion answer = carryOut(kind, drive, Duration::zero());
  const bool begun = answer.id != 0;
  if (begun && !answer.success) {
    const Sentence its = answer.message;
    answer.message.format("too many calls wait for their drives already, this one does not: %.180s", its.c_str());
  }
  return answer;
}

cycle::Completion StopCalls::carryOut(RequestKind kind, DriveIndex drive, Duration patience) const {
  cycle::Request request;
  request.kind = kind;
  request.drive = drive;
  request.patience = patience;
  return carry_out_(request);
}

}  // namespace nord_driver::node
