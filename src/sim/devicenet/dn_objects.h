// Attributes of the simulated module's objects as explicit messages read and write them.
#pragma once

#include <cstdint>

#include "nord_driver/core/bytes.h"

namespace nord_driver::sim {

/// General code of an error answer.
enum class CipStatus : std::uint8_t {
  kOk = 0x00,
  kResourceUnavailable = 0x02,  ///< also an inverter that is not there (BU 0280 4.1.2)
  kServiceNotSupported = 0x08,
  kInvalidValue = 0x09,
  kAlreadyInState = 0x0B,
  kStateConflict = 0x0C,
  kNotSettable = 0x0E,
  kReplyTooLarge = 0x11,
  kNotEnoughData = 0x13,
  kNoAttribute = 0x14,
  kTooMuchData = 0x15,
  kNoObject = 0x16,
  kVendorSpecific = 0x1F,
};

/// Longest value: an assembly of 33 bytes, a product name.
using CipBytes = FixedBytes<64>;
using CipWriter = ByteWriter<64>;

struct CipAddress {
  std::uint8_t class_id = 0;
  std::uint8_t instance = 0;
  std::uint8_t attribute = 0;
};

class DnObjects {
 public:
  virtual ~DnObjects() = default;
  virtual bool hasClass(std::uint8_t class_id) const noexcept = 0;
  /// The value, little endian; kNoObject, kNoAttribute, kResourceUnavailable.
  virtual CipStatus get(const CipAddress& at, CipBytes& value) noexcept = 0;
  /// `answer`: what the answer tells beside "done"; most objects tell nothing.
  virtual CipStatus set(const CipAddress& at, ByteView value, CipBytes& answer) noexcept = 0;

 protected:
  /// Little endian of `size` bytes.
  static void put(CipBytes& value, std::uint32_t number, std::size_t size) noexcept {
    for (std::size_t i = 0; i < size; ++i) value.push_back(static_cast<std::uint8_t>(number >> 8 * i & 0xFFu));
  }
  static std::uint32_t number(ByteView value) noexcept {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < value.size() && i < 4; ++i) bits |= std::uint32_t{value[i]} << 8 * i;
    return bits;
  }
  static CipStatus checkSize(ByteView value, std::size_t expected) noexcept {
    if (value.size() < expected) return CipStatus::kNotEnoughData;
    return value.size() > expected ? CipStatus::kTooMuchData : CipStatus::kOk;
  }
};

}  // namespace nord_driver::sim
