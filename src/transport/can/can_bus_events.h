// What is wrong with a CAN bus as a whole rather than with one drive, in words.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver {

/// Each event is handed on once; the last warning is the text of the bus for ten seconds. Never allocates.
class CanBusEvents {
 public:
  /// `explains`: it tells of another master, or of two nodes with one id: the reason of most that the nodes do
  /// meanwhile, and not to be hidden by it.
  void warn(const Sentence& text, Instant at, bool explains) noexcept;
  /// A warning of what the drives tell themselves: never the text of the bus. Left out where that text says it already.
  void mention(const Sentence& text, Instant at) noexcept;
  /// For information.
  void inform(const Sentence& text) noexcept { tell(text, false); }
  /// `lost`: received frames this computer took too late, since the start. Told at most once a second: a computer that
  /// is too slow has no time to lose.
  void noteLostFrames(const char* interface, std::uint64_t lost, Instant now) noexcept;

  std::optional<BusEvent> poll() noexcept { return events_.takeFront(); }
  /// The last warning; empty when it is too long ago.
  Sentence text(Instant now) const noexcept;
  /// That text explains.
  bool isExplained(Instant now) const noexcept;

 private:
  void tell(const Sentence& text, bool warning) noexcept;

  FixedVector<BusEvent, 8> events_;  // what does not fit is in the counters
  Sentence text_;
  Instant text_at_{};
  std::optional<Instant> explained_at_;
  std::uint64_t lost_told_ = 0;
  Instant lost_told_at_{};
};

}  // namespace nord_driver
