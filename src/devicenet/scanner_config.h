// What a DeviceNet scanner is told, and the check of the whole before the bus is opened.
#pragma once

#include <cstdint>
#include <vector>

#include "devicenet/duplicate_mac.h"
#include "devicenet/node_config.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

struct ScannerConfig {
  std::vector<NodeConfig> nodes;                        ///< 1..63
  std::uint8_t mac = 0;                                 ///< ours
  DeviceSignature own{0xFFFF, 0};                       ///< ours, in the duplicate-MAC check
  std::uint32_t bit_rate = 500'000;                     ///< 125000, 250000, 500000
  Duration cycle_time = std::chrono::milliseconds{10};  ///< between two `Scanner::startCycle()`
  /// Of silence after a communication fault, before the duplicate-MAC check begins again.
  Duration fault_pause = std::chrono::seconds{1};
  Duration first_retry = std::chrono::milliseconds{250};  ///< between two tries to connect; doubled each time
  Duration longest_retry = std::chrono::seconds{1};
};

/// Throws std::invalid_argument with a sentence that names device, value and what was expected: a MAC id twice, ours or
/// out of range, a bit rate DeviceNet does not have, sizes out of range, a bit strobe with more than 8 bytes, a cycle
/// shorter than the bus needs for it.
void checkConfig(const ScannerConfig& config);

/// The configuration with every expected packet rate filled in that was left to the cycle.
ScannerConfig completed(ScannerConfig config);

/// Bits of a frame with `bytes` of data and the pause behind it: at most, with the worst stuffing (ISO 11898-1).
constexpr std::uint32_t worstFrameBits(std::size_t bytes) noexcept {
  return static_cast<std::uint32_t>(55 + 10 * bytes);
}

/// Time on the wire of one cycle with every device, every frame stuffed worst; explicit messages come on top of it.
Duration cycleOnWire(const ScannerConfig& config) noexcept;

}  // namespace nord_driver::devicenet
