// DRIVECOM has no word that an inverter ignores: what stands at a start is looked at before the first one is written,
// because it takes the enable away, and so acknowledges a fault that nobody has seen yet (BU 0020 8).
#pragma once

#include <cstdint>
#include <optional>

#include "link/modbus/register_link.h"
#include "transport/interbus/input_watch.h"

namespace nord_driver {

/// Once, before drives are met. It ends with the first good inputs; and without any when the ring stands, which has
/// nothing to show, when the gateway refuses to be read, or after `longest`, counted from the first image of a connection
/// that stands: who cannot be read may take words all the same, and some inverter may still follow those of a driver that
/// was killed. A connection that is gone can neither be read nor take words, so the next one has its own `longest`; but only
/// so often, because the gateway may close each one for being read.
class FirstLook {
 public:
  FirstLook() = default;
  explicit FirstLook(Duration longest) noexcept : due_(true), longest_(longest) {}

  bool isDue() const noexcept { return due_; }
  /// After each cycle, when the drives were told what came.
  void handle(const InputWatch& watch, const link::LinkReport& report, Instant now) noexcept {
    if (!due_) return;
    if (report.counters.lost != lost_ && since_ && losses_ < kMostLosses) {
      since_.reset();
      ++losses_;
    }
    lost_ = report.counters.lost;
    if (report.state == link::LinkState::kConnected && !since_) since_ = now;
    const bool seen = watch.isFresh() || watch.worth() == InputWorth::kRingStands;
    // The register of the watchdog may have been refused before, and a second connection what it asks for.
    const bool refused = report.counters.refused_exchanges > 0;
    const bool overdue = since_ && now - *since_ >= longest_;
    due_ = !seen && !refused && !overdue;
  }

 private:
  // The link's pauses between them come to 4 s.
  static constexpr unsigned kMostLosses = 10;

  bool due_ = false;
  Duration longest_{};
  std::optional<Instant> since_;
  std::uint64_t lost_ = 0;  // as reported last
  unsigned losses_ = 0;     // of a connection that was looked at
};

}  // namespace nord_driver
