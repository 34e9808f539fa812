// The 11 bit identifiers of DeviceNet that the simulated modules send and hear, and the bytes before a message.
//
// Group 1 is message, then MAC id of the sender; group 2 is MAC id, then message, with the MAC id of the slave but for
// the strobe command, which bears the scanner's.
#pragma once

#include <cstdint>

namespace nord_driver::sim::dn {

constexpr unsigned kMacs = 64;
constexpr std::uint8_t kNoMac = 0xFF;  ///< "nobody" in the allocation information

constexpr std::uint32_t kGroup2 = 0x400;
constexpr std::uint32_t kGroup3 = 0x600;
constexpr std::uint32_t kGroup4 = 0x7C0;
constexpr std::uint32_t kNotAllowed = 0x7F0;  ///< from here on

/// Messages of group 1: what a slave sends of its own process data.
constexpr unsigned kChangeOfState = 0xD;
constexpr unsigned kStrobeResponse = 0xE;
constexpr unsigned kPollResponse = 0xF;

/// Messages of group 2.
constexpr unsigned kStrobeCommand = 0;
constexpr unsigned kMulticastPoll = 1;
constexpr unsigned kAcknowledge = 2;  ///< the scanner's, of change of state and cyclic data
constexpr unsigned kSlaveExplicit = 3;
constexpr unsigned kMasterExplicit = 4;
constexpr unsigned kPoll = 5;         ///< also the scanner's change of state and cyclic data
constexpr unsigned kUnconnected = 6;  ///< allocate and release of a group 2 only server
constexpr unsigned kDuplicateMac = 7;

constexpr std::uint32_t group1(unsigned message, unsigned mac) noexcept {
  return message << 6 | mac;
}
constexpr std::uint32_t group2(unsigned message, unsigned mac) noexcept {
  return kGroup2 | mac << 3 | message;
}
constexpr unsigned macOfGroup2(std::uint32_t id) noexcept {
  return id >> 3 & 0x3Fu;
}
constexpr unsigned messageOfGroup2(std::uint32_t id) noexcept {
  return id & 0x7u;
}
constexpr bool isGroup2(std::uint32_t id) noexcept {
  return id >= kGroup2 && id < kGroup3;
}

/// First byte of an explicit message: fragmented, transaction, MAC id.
constexpr std::uint8_t kFragmented = 0x80;
constexpr std::uint8_t kTransaction = 0x40;
constexpr std::uint8_t kMacMask = 0x3F;

/// The byte of a fragment: kind and count.
enum class Fragment : std::uint8_t { kFirst = 0x00, kMiddle = 0x40, kLast = 0x80, kAcknowledgement = 0xC0 };
constexpr std::uint8_t kFragmentCount = 0x3F;
/// The count of a first fragment that is the only one.
constexpr std::uint8_t kOnlyFragment = 0x3F;

constexpr Fragment kindOf(std::uint8_t fragment) noexcept {
  return static_cast<Fragment>(fragment & 0xC0u);
}

/// Service codes; an answer has bit 7 set.
constexpr std::uint8_t kAnswer = 0x80;
constexpr std::uint8_t kGetSingle = 0x0E;
constexpr std::uint8_t kSetSingle = 0x10;
constexpr std::uint8_t kError = 0x14;
constexpr std::uint8_t kAllocate = 0x4B;
constexpr std::uint8_t kRelease = 0x4C;

/// Bits of the allocation choice.
constexpr std::uint8_t kChoiceExplicit = 0x01;
constexpr std::uint8_t kChoicePoll = 0x02;
constexpr std::uint8_t kChoiceStrobe = 0x04;
constexpr std::uint8_t kChoiceMulticast = 0x08;
constexpr std::uint8_t kChoiceChangeOfState = 0x10;
constexpr std::uint8_t kChoiceCyclic = 0x20;
constexpr std::uint8_t kChoiceNoAcknowledge = 0x40;
constexpr std::uint8_t kChoiceReserved = 0x80;

}  // namespace nord_driver::sim::dn
