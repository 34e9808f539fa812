// Whether the heartbeats of one id come twice as often as one node sends them: then two nodes do.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

/// Two nodes with one id and the same heartbeat time take turns: each heartbeat comes that time after the last but one. The
/// heartbeats of one node come that time after the last one; a bundle of them, kept back by a host that stood still or by an
/// adapter, all at once.
class HeartbeatPace {
 public:
  /// `heartbeat_time`: as the node has been told (1017h).
  explicit HeartbeatPace(Duration heartbeat_time) noexcept : time_(heartbeat_time) {}

  /// The node has been set up: from here on it counts.
  void start() noexcept {
    last_.reset();
    last_but_one_.reset();
    in_turn_ = 0;
    conclusive_ = true;
  }
  /// Another master asks this node by SDO, and may have told it another time: nothing can be concluded any more.
  void giveUp() noexcept { conclusive_ = false; }

  /// A heartbeat came. True: so many of them in a row came in turn. A frame may be received twice (ISO 11898-1: an error in
  /// its last bit but one), but not five in a row.
  bool handle(Instant now) noexcept {
    const bool in_turn =
        last_but_one_ && now - *last_but_one_ >= time_ * 3 / 4 && now - *last_but_one_ <= time_ * 5 / 4;
    if (!in_turn) in_turn_ = 0;
    if (in_turn && in_turn_ < kOfTwoNodes) ++in_turn_;
    last_but_one_ = last_;
    last_ = now;
    return conclusive_ && in_turn_ == kOfTwoNodes;
  }

 private:
  static constexpr std::uint8_t kOfTwoNodes = 10;

  Duration time_;
  std::optional<Instant> last_, last_but_one_;
  std::uint8_t in_turn_ = 0;
  bool conclusive_ = true;
};

}  // namespace nord_driver::canopen
