#include "canopen/emergency.h"

#include <cassert>

#include "nord_driver/core/bytes.h"

namespace nord_driver::canopen {

bool EmergencyHistory::handle(const CanFrame& frame, Instant now) noexcept {
  if (frame.bytes().size() != kCanDataLength) return false;
  ByteReader reader{frame.bytes()};
  Emergency& emergency = items_[count_ % kLength];
  emergency.code = reader.u16le();
  emergency.error_register = reader.u8();
  for (std::uint8_t& byte : emergency.manufacturer) byte = reader.u8();
  emergency.at = now;
  ++count_;
  return true;
}

const Emergency& EmergencyHistory::back(std::size_t i) const noexcept {
  assert(i < size());
  return items_[(count_ - 1 - i) % kLength];
}

}  // namespace nord_driver::canopen
