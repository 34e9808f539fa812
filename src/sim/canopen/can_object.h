// What an SDO reads and writes: objects by index and sub-index, and the abort codes of a refusal.
#pragma once

#include <cstdint>

#include "nord_driver/core/bytes.h"

namespace nord_driver::sim {

struct ObjectId {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
};

/// SDO abort codes as BU 0060 p. 62 and BU 0260 p. 56 list them.
enum class SdoAbort : std::uint32_t {
  kNone = 0,
  kToggle = 0x05030000,
  kTimeout = 0x05040000,
  kCommand = 0x05040001,
  kMemory = 0x05040005,
  kUnsupported = 0x06010000,
  kWriteOnly = 0x06010001,
  kReadOnly = 0x06010002,
  kNoObject = 0x06020000,
  kNotMappable = 0x06040041,
  kPdoLength = 0x06040042,
  kHardware = 0x06060000,
  kTypeOrLength = 0x06070010,
  kTooLong = 0x06070012,
  kTooShort = 0x06070013,
  kNoSubIndex = 0x06090011,
  kValueRange = 0x06090030,
  kTooHigh = 0x06090031,
  kTooLow = 0x06090032,
  kNotStored = 0x08000020,
  kLocalControl = 0x08000021,
};

/// An object's bytes as they go over the bus, little endian.
using ObjectBytes = FixedBytes<64>;

/// The object dictionary as one SDO server sees it.
class CanObjects {
 public:
  virtual ~CanObjects() = default;
  virtual SdoAbort read(ObjectId id, ObjectBytes& bytes) noexcept = 0;
  virtual SdoAbort write(ObjectId id, ByteView bytes) noexcept = 0;
};

/// The low `length` bytes of `value`.
inline ObjectBytes objectBytes(std::uint32_t value, std::size_t length) noexcept {
  ObjectBytes bytes;
  for (std::size_t i = 0; i < length; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i) & 0xFFu));
  return bytes;
}

/// The number in up to four bytes.
inline std::uint32_t objectNumber(ByteView bytes) noexcept {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes.size() && i < 4; ++i) value |= std::uint32_t{bytes[i]} << (8 * i);
  return value;
}

}  // namespace nord_driver::sim
