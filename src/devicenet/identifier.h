// The 11 bit identifiers of DeviceNet (IEC 62026-3): message groups, message numbers, MAC ids.
#pragma once

#include <cstdint>
#include <optional>

namespace nord_driver::devicenet {

/// MAC ids are 0..63.
constexpr std::uint8_t kMacIds = 64;
/// Identifiers above are not allowed.
constexpr std::uint32_t kLastIdentifier = 0x7EF;

/// Group 1, 000h..3FFh: message number, then the sender's MAC id. Those of the predefined connection set.
enum class Group1 : std::uint8_t {
  kMulticastPollResponse = 0xC,
  kChangeOfStateOrCyclic = 0xD,  ///< data of the slave
  kStrobeResponse = 0xE,
  kPollResponse = 0xF  ///< and the slave's acknowledge of the master's change-of-state or cyclic data
};

/// Group 2, 400h..5FFh: MAC id, then the message number. The MAC id is the slave's, except in the strobe command
/// (the master's) and in the duplicate-MAC check (that of the device that checks or is checked).
enum class Group2 : std::uint8_t {
  kStrobeCommand = 0,
  kMulticastPoll = 1,
  kMasterAcknowledge = 2,  ///< of the slave's change-of-state or cyclic data
  kSlaveExplicit = 3,      ///< explicit and unconnected responses, device heartbeat and shutdown
  kMasterExplicit = 4,
  kMasterIo = 5,     ///< poll command, or the master's change-of-state or cyclic data
  kUnconnected = 6,  ///< Group-2-only unconnected explicit request: allocate, release
  kDuplicateMac = 7
};

/// Group 3, 600h..7BFh: message number, then the sender's MAC id. Of devices that are not Group-2-only.
enum class Group3 : std::uint8_t {
  kUnconnectedResponse = 5  ///< and their heartbeat and shutdown
};

constexpr std::uint32_t identifier(Group1 message, std::uint8_t mac) noexcept {
  return static_cast<std::uint32_t>(message) << 6u | mac;
}
constexpr std::uint32_t identifier(Group2 message, std::uint8_t mac) noexcept {
  return 0x400u | static_cast<std::uint32_t>(mac) << 3u | static_cast<std::uint32_t>(message);
}

constexpr std::uint32_t identifier(Group3 message, std::uint8_t mac) noexcept {
  return 0x600u | static_cast<std::uint32_t>(message) << 6u | mac;
}

/// What an identifier says.
struct Identifier {
  std::uint8_t group = 0;    ///< 1..4
  std::uint8_t message = 0;  ///< group 4: the low 6 bits
  std::uint8_t mac = 0;      ///< group 4 has none: 0
};

/// Nothing for 7F0h and above.
constexpr std::optional<Identifier> readIdentifier(std::uint32_t id) noexcept {
  if (id > kLastIdentifier) return std::nullopt;
  const auto low = static_cast<std::uint8_t>(id & 0x3Fu);
  if (id < 0x400) return Identifier{1, static_cast<std::uint8_t>(id >> 6u), low};
  if (id < 0x600) {
    return Identifier{2, static_cast<std::uint8_t>(id & 7u), static_cast<std::uint8_t>(id >> 3u & 0x3Fu)};
  }
  if (id < 0x7C0) return Identifier{3, static_cast<std::uint8_t>(id >> 6u & 7u), low};
  return Identifier{4, low, 0};
}

}  // namespace nord_driver::devicenet
