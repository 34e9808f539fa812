// The process data of the last cycles, drive by drive, as they went over the bus: what a trace shows before its fault.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "nord_driver/core/history_ring.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/process_data.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::trace {

/// One drive in one cycle.
struct ProcessDataRecord {
  Instant time{};
  std::uint64_t cycle = 0;  ///< from 0
  std::uint32_t drive = 0;
  bool answered = false;  ///< false: `input` is not of this cycle
  profile::ProcessOutput output;
  profile::ProcessInput input;
};

/// Cycles a trace shows before the one it is written for.
constexpr std::uint64_t kTracedCycles = 32;

/// Filled by the cycle's thread without waiting or allocating. Deeper than what a trace shows, because whoever writes
/// the trace comes later than the fault: by up to a second at 1000 cycles per second.
class ProcessDataHistory {
 public:
  explicit ProcessDataHistory(std::size_t drive_count);

  /// The cycle's thread only.
  void record(const std::vector<profile::ProcessOutput>& outputs, const std::vector<DriveExchange>& inputs,
              Instant now) noexcept;

  /// Whole cycles recorded so far. Any thread.
  std::uint64_t cycles() const noexcept { return ring_.pushed() / drive_count_; }
  /// Of one drive in one cycle (from 0). Nothing when it has been overwritten or has not come yet. Any thread.
  std::optional<ProcessDataRecord> at(std::uint64_t cycle, std::size_t drive) const noexcept {
    return ring_.read(cycle * drive_count_ + drive);
  }
  /// Cycle `last` (from 0) and up to 32 before it, oldest first, in each the drives in their order. Any thread.
  std::vector<ProcessDataRecord> upTo(std::uint64_t last) const;

 private:
  std::size_t drive_count_;
  HistoryRing<ProcessDataRecord> ring_;
};

}  // namespace nord_driver::trace
