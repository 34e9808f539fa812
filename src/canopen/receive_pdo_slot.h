// The newest value of one RPDO of a node, which is what we send.
#pragma once

#include <cstdint>
#include <utility>

#include "canopen/node_config.h"
#include "core/can_frame.h"
#include "nord_driver/core/bytes.h"

namespace nord_driver::canopen {

/// Bytes a mapping takes; 0 for an empty one: not known.
std::size_t mappedLength(const PdoConfig& config) noexcept;

/// There is one place for the value: an old one can never be sent after a newer one.
class ReceivePdoSlot {
 public:
  explicit ReceivePdoSlot(const PdoConfig& config) noexcept
      : cob_id_(config.cob_id), enabled_(config.enabled), length_(mappedLength(config)) {}

  /// Cut or filled with zeros to the mapped length.
  void set(ByteView bytes) noexcept;
  /// Nothing is sent until the next `set()`.
  void forget() noexcept { known_ = false; }
  /// The value stops a drive: in the next cycle it goes to a node that fell silent, too.
  void tellUnheard() noexcept { tell_unheard_ = true; }
  /// For this cycle.
  bool takeTellUnheard() noexcept { return std::exchange(tell_unheard_, false); }
  bool ready() const noexcept { return known_ && enabled_; }
  CanFrame frame() const noexcept { return dataFrame(cob_id_, bytes_); }

 private:
  std::uint32_t cob_id_;
  bool enabled_;
  std::size_t length_;
  FixedBytes<kCanDataLength> bytes_;
  bool known_ = false;
  bool tell_unheard_ = false;
};

}  // namespace nord_driver::canopen
