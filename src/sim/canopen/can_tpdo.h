// When a transmit PDO is due: on change, on its event timer, or on SYNC, never within the inhibit time (BU 0060 p. 58).
#pragma once

#include "nord_driver/core/time.h"
#include "sim/canopen/can_communication.h"

namespace nord_driver::sim {

using PdoData = FixedBytes<8>;

class CanTpdo {
 public:
  /// On entering operational: nothing was sent yet.
  void start() noexcept { *this = CanTpdo{}; }
  void advance(Duration span) noexcept { since_sent_ += span; }

  /// Types 254 and 255: on change, when the event timer is over, and once after the start.
  bool due(const PdoSettings& pdo, const PdoData& now) const noexcept;
  /// A SYNC has come. Type 0: due if changed; 1-240: every n-th.
  bool dueOnSync(const PdoSettings& pdo, const PdoData& now) noexcept;
  void sent(const PdoData& data) noexcept;

 private:
  bool sent_once_ = false;
  PdoData last_;
  Duration since_sent_{0};
  unsigned syncs_ = 0;
};

}  // namespace nord_driver::sim
