#include "canopen/receive_pdo_slot.h"

namespace nord_driver::canopen {

std::size_t mappedLength(const PdoConfig& config) noexcept {
  std::size_t bits = 0;
  for (const PdoMapping& entry : config.mapping) bits += entry.bits;
  return bits / 8;
}

void ReceivePdoSlot::set(ByteView bytes) noexcept {
  bytes_.clear();
  for (const std::uint8_t byte : bytes.sub(0, length_ != 0 ? length_ : kCanDataLength)) bytes_.push_back(byte);
  if (length_ != 0) bytes_.resize(length_);
  known_ = true;
}

}  // namespace nord_driver::canopen
