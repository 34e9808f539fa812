#include "sim/canopen/can_pdo_objects.h"

namespace nord_driver::sim {

namespace {

constexpr unsigned kMostBits = 64;
constexpr std::uint8_t kLongestSynchronous = 240;
constexpr std::uint8_t kFirstImmediate = 254;  // 252 and 253 are reserved (BU 0060 p. 58)

bool isReceive(std::uint16_t index) noexcept {
  return index < 0x1800;
}
bool isMapping(std::uint16_t index) noexcept {
  return (index & 0x0200u) != 0;
}

/// CiA 301, table of restricted CAN-IDs: NMT, SYNC and EMCY, SDO, error control and what is reserved.
bool isRestricted(std::uint32_t id) noexcept {
  return id <= 0x180 || (id >= 0x581 && id <= 0x5FF) || (id >= 0x601 && id <= 0x67F) || id >= 0x6E0;
}

/// The length of sub-index `sub` of a communication object in bytes; 0 = no such sub-index.
std::size_t communicationLength(std::uint8_t sub, bool receive) noexcept {
  if (sub == 1) return 4;
  if (sub == 0 || sub == 2) return 1;
  return !receive && (sub == 3 || sub == 5) ? 2 : 0;
}

std::uint32_t communicationValue(const PdoSettings& pdo, std::uint8_t sub, bool receive) noexcept {
  switch (sub) {
    case 0:
      return receive ? 2 : 5;
    case 1:
      return pdo.cob_id;
    case 2:
      return pdo.type;
    case 3:
      return pdo.inhibit;
    default:
      return pdo.event;
  }
}

std::size_t lengthOf(ObjectId id) noexcept {
  if (!isMapping(id.index)) return communicationLength(id.sub, isReceive(id.index));
  if (id.sub == 0) return 1;
  return id.sub <= PdoSettings::kEntries ? 4 : 0;
}

unsigned bitsOf(std::uint32_t entry) noexcept {
  return entry & 0xFFu;
}

}  // namespace

std::size_t PdoSettings::length() const noexcept {
  std::size_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) bits += bitsOf(mapping[i]);
  return bits / 8;
}

PdoSettings* CanPdoObjects::find(std::uint16_t index) noexcept {
  auto& pdos = isReceive(index) ? communication_.rpdos : communication_.tpdos;
  const std::size_t number = index & 0x01FFu;
  return number < pdos.size() ? &pdos[number] : nullptr;
}

SdoAbort CanPdoObjects::read(ObjectId id, ObjectBytes& bytes) noexcept {
  const PdoSettings* pdo = find(id.index);
  if (pdo == nullptr) return SdoAbort::kNoObject;
  const std::size_t length = lengthOf(id);
  if (length == 0) return SdoAbort::kNoSubIndex;
  const std::uint32_t value = !isMapping(id.index) ? communicationValue(*pdo, id.sub, isReceive(id.index))
                              : id.sub == 0        ? pdo->count
                                                   : pdo->mapping[id.sub - 1u];
  bytes = objectBytes(value, length);
  return SdoAbort::kNone;
}

SdoAbort CanPdoObjects::write(ObjectId id, ByteView bytes) noexcept {
  PdoSettings* pdo = find(id.index);
  if (pdo == nullptr) return SdoAbort::kNoObject;
  const std::size_t length = lengthOf(id);
  if (length == 0) return SdoAbort::kNoSubIndex;
  if (!isMapping(id.index) && id.sub == 0) return SdoAbort::kReadOnly;
  if (isMapping(id.index) && fixed_mapping_) return SdoAbort::kReadOnly;
  if (bytes.size() != length) return SdoAbort::kTypeOrLength;
  const std::uint32_t value = objectNumber(bytes);
  if (!context_.mayConfigure()) return outOfOrder();
  return isMapping(id.index) ? writeMapping(*pdo, id, value) : writeCommunication(*pdo, id, value);
}

SdoAbort CanPdoObjects::outOfOrder() noexcept {
  context_.mappingOrderBroken();
  return refusal_;
}

SdoAbort CanPdoObjects::writeCommunication(PdoSettings& pdo, ObjectId id, std::uint32_t value) noexcept {
  switch (id.sub) {
    case 1:
      return writeCobId(pdo, isReceive(id.index), value);
    case 2:
      if (value > kLongestSynchronous && value < kFirstImmediate) return SdoAbort::kValueRange;
      pdo.type = static_cast<std::uint8_t>(value);
      return SdoAbort::kNone;
    case 3:
      if (pdo.enabled()) return outOfOrder();  // CiA 301 7.5.2.37: not while the PDO exists
      pdo.inhibit = static_cast<std::uint16_t>(value);
      return SdoAbort::kNone;
    default:
      pdo.event = static_cast<std::uint16_t>(value);
      return SdoAbort::kNone;
  }
}

SdoAbort CanPdoObjects::writeCobId(PdoSettings& pdo, bool receive, std::uint32_t value) noexcept {
  // Bit 30 "cannot be changed" (BU 0060 p. 63); it has a meaning for what is sent only.
  if (!receive && (value & kCobIdNoRtr) == 0) return SdoAbort::kValueRange;
  if ((value & ~(kCobIdOff | kCobIdNoRtr | kCobIdMask)) != 0) return SdoAbort::kValueRange;
  const bool on = (value & kCobIdOff) == 0;
  if (on && isRestricted(value & kCobIdMask)) return SdoAbort::kValueRange;
  if (on && pdo.enabled() && (value & kCobIdMask) != pdo.id()) return outOfOrder();
  pdo.cob_id = value | kCobIdNoRtr;
  return SdoAbort::kNone;
}

SdoAbort CanPdoObjects::writeMapping(PdoSettings& pdo, ObjectId id, std::uint32_t value) noexcept {
  if (pdo.enabled()) return outOfOrder();
  if (id.sub == 0) {
    if (value > PdoSettings::kEntries) return SdoAbort::kPdoLength;
    unsigned bits = 0;
    for (std::size_t i = 0; i < value; ++i) {
      if (bitsOf(pdo.mapping[i]) == 0) return SdoAbort::kNotMappable;
      bits += bitsOf(pdo.mapping[i]);
    }
    if (bits > kMostBits) return SdoAbort::kPdoLength;
    pdo.count = static_cast<std::uint8_t>(value);
    return SdoAbort::kNone;
  }
  if (pdo.count != 0) return outOfOrder();
  const ObjectId mapped{static_cast<std::uint16_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 0xFFu)};
  const unsigned bits = context_.mappableBits(mapped, isReceive(id.index));
  if (bits == 0 || bits != bitsOf(value)) return SdoAbort::kNotMappable;
  pdo.mapping[id.sub - 1u] = value;
  return SdoAbort::kNone;
}

}  // namespace nord_driver::sim
