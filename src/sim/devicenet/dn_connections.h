// The predefined connections of a simulated group 2 only server: who owns them, what state each is in, when one is
// over.
//
// BU 0280 4, 4.3.2 and 4.3.4, with the rules of the predefined master/slave connection set.
#pragma once

#include <array>
#include <cstdint>

#include "nord_driver/core/time.h"
#include "sim/devicenet/dn_identifiers.h"
#include "sim/devicenet/dn_objects.h"

namespace nord_driver::sim {

/// Instances of class 5, less one. That of the poll is that of the scanner's change of state and cyclic data, too ("poll or
/// COS/cyclic consuming"), unless the module takes these by the one that produces them.
enum class DnConnectionKind : std::uint8_t { kExplicit, kPoll, kStrobe, kChangeOfState };
constexpr std::size_t kDnConnections = 4;

/// Attribute 1 of class 5.
enum class DnConnectionState : std::uint8_t {
  kNone = 0,
  kConfiguring = 1,
  kWaiting = 2,
  kEstablished = 3,
  kTimedOut = 4,
  kDeferredDelete = 5,
};

struct DnConnection {
  DnConnectionState state = DnConnectionState::kNone;
  std::uint16_t packet_rate = 0;  ///< ms; 0: never over
  std::uint16_t produced = 0;     ///< bytes
  std::uint16_t consumed = 0;     ///< bytes
  Duration idle{0};               ///< since the last message of the master

  bool established() const noexcept { return state == DnConnectionState::kEstablished; }
};

/// How an allocation or a release ended.
struct DnAllocation {
  CipStatus status = CipStatus::kOk;
  std::uint8_t additional = 0xFF;
};

class DnConnections {
 public:
  static constexpr std::uint16_t kExplicitPacketRate = 2500;  ///< ms
  static constexpr unsigned kTimeoutMultiplier = 4;

  /// `resolution`: devices round the expected packet rate up to their steps, ms. `change_of_state_alone`: of change of state
  /// and cyclic, both ways.
  DnConnections(unsigned resolution, bool change_of_state_alone) noexcept
      : resolution_(resolution == 0 ? 1 : resolution), change_of_state_alone_(change_of_state_alone) {}

  /// `produced` and `consumed`: bytes of the assembly that counts now.
  DnAllocation allocate(std::uint8_t choice, std::uint8_t master, std::size_t produced, std::size_t consumed) noexcept;
  DnAllocation release(std::uint8_t choice) noexcept;
  void forget() noexcept;

  /// Attribute 9: rounds it, and lets an I/O connection begin. Nothing: it cannot be set now.
  bool setPacketRate(DnConnectionKind kind, std::uint16_t milliseconds) noexcept;
  /// A message of the master for it.
  void feed(DnConnectionKind kind) noexcept { at(kind).idle = Duration::zero(); }
  /// Lets time pass. True: an I/O connection is over just now.
  bool advance(Duration span) noexcept;

  const DnConnection& operator[](DnConnectionKind kind) const noexcept {
    return connections_[static_cast<std::size_t>(kind)];
  }
  std::uint8_t owner() const noexcept { return owner_; }  ///< dn::kNoMac: nobody
  std::uint8_t choice() const noexcept { return choice_; }
  bool has(std::uint8_t bits) const noexcept { return (choice_ & bits) == bits; }
  bool anyIoEstablished() const noexcept;
  /// The one that takes the scanner's poll, change of state or cyclic data: message 5 of group 2.
  DnConnectionKind taking() const noexcept;

 private:
  DnConnection& at(DnConnectionKind kind) noexcept { return connections_[static_cast<std::size_t>(kind)]; }
  /// Of the choice: there is this connection when one of them is allocated.
  std::uint8_t bitsOf(DnConnectionKind kind) const noexcept;
  bool hearsNothing(DnConnectionKind kind) const noexcept;
  void drop(std::uint8_t choice) noexcept;

  unsigned resolution_;
  bool change_of_state_alone_;
  std::uint8_t owner_ = dn::kNoMac;
  std::uint8_t choice_ = 0;
  std::array<DnConnection, kDnConnections> connections_{};
};

}  // namespace nord_driver::sim
