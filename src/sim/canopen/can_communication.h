// What the communication profile area of a simulated node holds: COB-IDs, PDOs, guarding, identity (CiA 301 7.5).
#pragma once

#include <array>
#include <cstdint>

#include "nord_driver/core/fixed_vector.h"
#include "sim/canopen/can_object.h"

namespace nord_driver::sim {

/// The four situations "NORD on CAN".
enum class CanConnection : std::uint8_t {
  kOption,     ///< SK TU1/TU2/TU3-CAO: one node, one inverter (BU 0060)
  kOnboard,    ///< the CAN port of an SK 511E and above: the same objects, no DS402 (BU 0060 p. 57)
  kGateway,    ///< SK CU4/TU4-CAO: one node, up to four inverters on the system bus (BU 0260)
  kSystemBus,  ///< the inverter's own node on the NORD system bus; no source prints its objects: as kOnboard
};

const char* toString(CanConnection connection) noexcept;

/// CiA 301 7.3.2.2; the values are those of heartbeat and guarding answers.
enum class NmtState : std::uint8_t { kInitialising = 0, kStopped = 4, kOperational = 5, kPreOperational = 127 };

/// No source prints NORD's vendor id or product codes: these numbers are the simulator's.
struct CanIdentity {
  std::uint32_t vendor = 0x0000004E;
  std::uint32_t product = 1;
  std::uint32_t revision = 0x00010000;
  std::uint32_t serial = 1;
};

constexpr std::uint32_t kCobIdOff = 0x80000000;    ///< bit 31: switched off
constexpr std::uint32_t kCobIdNoRtr = 0x40000000;  ///< bit 30: no remote frames; always 1 (BU 0060 p. 63)
constexpr std::uint32_t kCobIdMask = 0x000007FF;

/// One entry of a PDO mapping: index, sub-index, length in bits.
constexpr std::uint32_t mappingEntry(std::uint16_t index, std::uint8_t sub, unsigned bits) noexcept {
  return std::uint32_t{index} << 16 | std::uint32_t{sub} << 8 | bits;
}

struct PdoSettings {
  static constexpr std::size_t kEntries = 4;  ///< BU 0060 p. 65: four entries each

  std::uint32_t cob_id = kCobIdOff | kCobIdNoRtr;
  std::uint8_t type = 255;    ///< transmission type; 255 is NORD's standard setting (BU 0060 p. 58)
  std::uint16_t inhibit = 0;  ///< 100 us
  std::uint16_t event = 0;    ///< ms, 0 = off
  std::uint8_t count = 0;     ///< valid entries
  std::array<std::uint32_t, kEntries> mapping{};

  bool enabled() const noexcept { return (cob_id & kCobIdOff) == 0; }
  std::uint32_t id() const noexcept { return cob_id & kCobIdMask; }
  /// Bytes of the mapped objects.
  std::size_t length() const noexcept;
};

/// Where one SDO server listens and answers; bit 31 = off.
struct SdoCobIds {
  std::uint32_t request = kCobIdOff;
  std::uint32_t answer = kCobIdOff;
};

struct CanCommunication {
  static constexpr std::size_t kPdos = 5;       ///< of a gateway: four inverters and the module's own
  static constexpr std::size_t kServers = 4;    ///< of a gateway
  static constexpr std::size_t kConsumers = 2;  ///< the simulator's choice

  std::uint32_t sync_cob_id = 0x80;
  std::uint32_t emergency_cob_id = 0;
  std::uint16_t emergency_inhibit = 0;  ///< 100 us
  std::uint16_t guard_time = 0;         ///< ms
  std::uint8_t life_factor = 0;
  std::uint16_t heartbeat = 0;                        ///< ms, 0 = guarding instead
  std::array<std::uint32_t, kConsumers> consumers{};  ///< node << 16 | ms
  FixedVector<SdoCobIds, kServers> servers;
  FixedVector<PdoSettings, kPdos> rpdos;
  FixedVector<PdoSettings, kPdos> tpdos;
};

}  // namespace nord_driver::sim
