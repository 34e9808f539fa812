#include "sim/devicenet/dn_connections.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

constexpr std::uint8_t kConflict = 0x01;  // additional codes of a refused allocation
constexpr std::uint8_t kInvalidChoice = 0x02;
constexpr std::uint8_t kNoResource = 0x04;

constexpr std::uint8_t kProducesItself = dn::kChoiceChangeOfState | dn::kChoiceCyclic;
constexpr std::size_t kMostOfStrobe = 8;
constexpr unsigned kLongestPacketRate = 0xFFFF;

constexpr DnConnectionKind kIoKinds[]{DnConnectionKind::kPoll, DnConnectionKind::kStrobe,
                                      DnConnectionKind::kChangeOfState};

}  // namespace

std::uint8_t DnConnections::bitsOf(DnConnectionKind kind) const noexcept {
  switch (kind) {
    case DnConnectionKind::kExplicit:
      return dn::kChoiceExplicit;
    case DnConnectionKind::kPoll:
      return change_of_state_alone_ ? dn::kChoicePoll : dn::kChoicePoll | kProducesItself;
    case DnConnectionKind::kStrobe:
      return dn::kChoiceStrobe;
    case DnConnectionKind::kChangeOfState:
      break;
  }
  return kProducesItself;
}

DnConnectionKind DnConnections::taking() const noexcept {
  return change_of_state_alone_ && !has(dn::kChoicePoll) ? DnConnectionKind::kChangeOfState : DnConnectionKind::kPoll;
}

DnAllocation DnConnections::allocate(std::uint8_t choice, std::uint8_t master, std::size_t produced,
                                     std::size_t consumed) noexcept {
  const bool both = (choice & kProducesItself) == kProducesItself;
  const bool suppresses_nothing = (choice & dn::kChoiceNoAcknowledge) != 0 && (choice & kProducesItself) == 0;
  const bool unknown = (choice & (dn::kChoiceMulticast | dn::kChoiceReserved)) != 0;
  if (choice == 0 || both || suppresses_nothing || unknown || master >= dn::kMacs) {
    return {CipStatus::kInvalidValue, kInvalidChoice};
  }
  if (owner_ != dn::kNoMac && owner_ != master) return {CipStatus::kStateConflict, kConflict};
  // Of a group 2 only server the explicit connection comes first, or together with the others.
  if (((choice_ | choice) & dn::kChoiceExplicit) == 0) return {CipStatus::kStateConflict, kInvalidChoice};
  const bool again = (choice_ & choice) != 0 || ((choice_ & kProducesItself) != 0 && (choice & kProducesItself) != 0);
  if (again) return {CipStatus::kAlreadyInState, kInvalidChoice};
  if ((choice & dn::kChoiceStrobe) != 0 && produced > kMostOfStrobe) {
    return {CipStatus::kResourceUnavailable, kNoResource};
  }
  owner_ = master;
  choice_ = static_cast<std::uint8_t>(choice_ | choice);
  if ((choice & dn::kChoiceExplicit) != 0) {
    at(DnConnectionKind::kExplicit) = {DnConnectionState::kEstablished, kExplicitPacketRate,
                                       static_cast<std::uint16_t>(CipBytes::capacity()),
                                       static_cast<std::uint16_t>(CipBytes::capacity()), Duration::zero()};
  }
  for (const DnConnectionKind kind : kIoKinds) {
    if ((choice & bitsOf(kind)) == 0) continue;
    DnConnection& connection = at(kind);
    // One that a poll and change of state share may run already.
    if (connection.state == DnConnectionState::kNone) connection.state = DnConnectionState::kConfiguring;
    const bool acknowledges = kind == DnConnectionKind::kPoll && !has(dn::kChoicePoll);
    const bool is_acknowledged = kind == DnConnectionKind::kChangeOfState && taking() != kind;
    const bool strobe = kind == DnConnectionKind::kStrobe;
    connection.produced = static_cast<std::uint16_t>(acknowledges ? 0 : produced);
    connection.consumed = static_cast<std::uint16_t>(strobe ? kMostOfStrobe : is_acknowledged ? 0 : consumed);
  }
  return {};
}

DnAllocation DnConnections::release(std::uint8_t choice) noexcept {
  if (choice == 0 || (choice & (dn::kChoiceMulticast | dn::kChoiceReserved)) != 0) {
    return {CipStatus::kInvalidValue, kInvalidChoice};
  }
  if ((choice & choice_) == 0) return {CipStatus::kAlreadyInState, kInvalidChoice};
  drop(choice);
  if (choice_ == 0) forget();
  return {};
}

void DnConnections::drop(std::uint8_t choice) noexcept {
  unsigned kept = choice_ & ~unsigned{choice};
  if ((kept & kProducesItself) == 0) kept &= ~unsigned{dn::kChoiceNoAcknowledge};
  choice_ = static_cast<std::uint8_t>(kept);
  for (std::size_t i = 0; i < kDnConnections; ++i) {
    if ((choice_ & bitsOf(static_cast<DnConnectionKind>(i))) == 0) connections_[i] = DnConnection{};
  }
}

void DnConnections::forget() noexcept {
  owner_ = dn::kNoMac;
  choice_ = 0;
  connections_ = {};
}

bool DnConnections::setPacketRate(DnConnectionKind kind, std::uint16_t milliseconds) noexcept {
  DnConnection& connection = at(kind);
  if (connection.state == DnConnectionState::kNone || connection.state == DnConnectionState::kTimedOut) return false;
  const unsigned steps = (milliseconds + resolution_ - 1) / resolution_;
  connection.packet_rate = static_cast<std::uint16_t>(std::min(steps * resolution_, kLongestPacketRate));
  connection.idle = Duration::zero();
  connection.state = DnConnectionState::kEstablished;
  return true;
}

bool DnConnections::anyIoEstablished() const noexcept {
  return std::any_of(std::begin(kIoKinds), std::end(kIoKinds),
                     [&](DnConnectionKind kind) { return (*this)[kind].established(); });
}

// Neither data nor, being suppressed, acknowledges: then nothing is missed.
bool DnConnections::hearsNothing(DnConnectionKind kind) const noexcept {
  return kind == DnConnectionKind::kChangeOfState && taking() != kind && has(dn::kChoiceNoAcknowledge);
}

// An I/O connection that is over stays allocated until it is released; the explicit one is deleted (attribute 12), and
// with it everything when no I/O runs any more.
bool DnConnections::advance(Duration span) noexcept {
  bool io_over = false;
  for (std::size_t i = 0; i < kDnConnections; ++i) {
    DnConnection& connection = connections_[i];
    const auto kind = static_cast<DnConnectionKind>(i);
    if (!connection.established() || connection.packet_rate == 0 || hearsNothing(kind)) continue;
    connection.idle += span;
    if (connection.idle < std::chrono::milliseconds{kTimeoutMultiplier * connection.packet_rate}) continue;
    if (kind == DnConnectionKind::kExplicit) {
      drop(dn::kChoiceExplicit);
    } else {
      connection.state = DnConnectionState::kTimedOut;
      io_over = true;
    }
  }
  if (choice_ != 0 && !has(dn::kChoiceExplicit) && !anyIoEstablished()) forget();
  return io_over;
}

}  // namespace nord_driver::sim
