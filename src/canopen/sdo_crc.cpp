#include "canopen/sdo_crc.h"

namespace nord_driver::canopen {

std::uint16_t sdoCrc(ByteView bytes) noexcept {
  constexpr unsigned kPolynomial = 0x1021;
  unsigned crc = 0;
  for (const std::uint8_t byte : bytes) {
    crc ^= static_cast<unsigned>(byte) << 8;
    for (int bit = 0; bit < 8; ++bit) crc = ((crc & 0x8000u) != 0 ? (crc << 1) ^ kPolynomial : crc << 1) & 0xFFFFu;
  }
  return static_cast<std::uint16_t>(crc);
}

}  // namespace nord_driver::canopen
