// What the bus cycle leaves for the trace: its process data, and the moments a trace is written for.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/event_ring.h"
#include "cycle/cycle_observer.h"
#include "cycle/request.h"
#include "cycle/snapshot.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"
#include "trace/process_data_history.h"

namespace nord_driver::trace {

struct TraceTrigger {
  enum class Kind : std::uint8_t {
    kFault,  ///< the fault bit of a drive rose
    kStop,   ///< a drive or the base stopped, and nobody had asked for it
  };
  Kind kind = Kind::kFault;
  DriveIndex drive = cycle::kAllDrives;  ///< kAllDrives: the base
  Instant time{};
  std::uint64_t cycle = 0;
  Word status_word = 0;  ///< of the drive; 0 for the base
  Sentence text;         ///< why it stopped; may be empty
};

class TraceFeed final : public cycle::CycleObserver {
 public:
  explicit TraceFeed(std::size_t drive_count);

  void handleCycle(const std::vector<profile::ProcessOutput>& outputs, const std::vector<DriveExchange>& inputs,
                   const cycle::CycleSnapshot& snapshot) noexcept override;

  /// One outside thread only. When nobody takes them, the newest are lost.
  std::optional<TraceTrigger> pollTrigger() noexcept { return triggers_.pop(); }
  /// Any thread.
  const ProcessDataHistory& history() const noexcept { return history_; }

 private:
  struct Seen {
    std::uint64_t faults = 0;
    bool stopped = false;
    bool turned = false;  // enabled or in a quick stop, and heeding this bus
    bool off1 = false;    // was sent it
  };

  void handleDrive(DriveIndex drive, const cycle::DriveSnapshot& snapshot, TraceTrigger& trigger) noexcept;
  static bool fallsOut(Seen& seen, const cycle::DriveSnapshot& snapshot) noexcept;

  ProcessDataHistory history_;
  EventRing<TraceTrigger, 16> triggers_;
  std::vector<Seen> drives_;
  bool base_stopped_ = false;
};

}  // namespace nord_driver::trace
