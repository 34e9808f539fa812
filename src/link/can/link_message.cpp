#include <linux/can/netlink.h>
#include <linux/if.h>
#include <linux/if_arp.h>
#include <linux/if_link.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "link/can/can_interface.h"

namespace nord_driver::link {

namespace {

/// The first bytes of `bytes` as one of the kernel's structures; zero where there are not enough.
template <typename T>
T as(ByteView bytes) noexcept {
  T value{};
  if (bytes.size() >= sizeof value) std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

InterfaceWord asWord(ByteView bytes) noexcept {
  InterfaceWord word;
  word.format("%.*s", static_cast<int>(bytes.size()), reinterpret_cast<const char*>(bytes.data()));
  return word;
}

/// Calls `take(type, value)` for each attribute. False when they do not fill `bytes`.
template <typename Take>
bool forEachAttribute(ByteView bytes, const Take& take) noexcept {
  while (!bytes.empty()) {
    if (bytes.size() < sizeof(rtattr)) return false;
    const rtattr header = as<rtattr>(bytes);
    if (header.rta_len < sizeof(rtattr) || header.rta_len > bytes.size()) return false;
    take(header.rta_type & NLA_TYPE_MASK, bytes.sub(sizeof(rtattr), header.rta_len - sizeof(rtattr)));
    bytes = bytes.sub(RTA_ALIGN(header.rta_len));
  }
  return true;
}

CanState asState(std::uint32_t state) noexcept {
  switch (state) {
    case CAN_STATE_ERROR_ACTIVE:
      return CanState::kActive;
    case CAN_STATE_ERROR_WARNING:
      return CanState::kWarning;
    case CAN_STATE_ERROR_PASSIVE:
      return CanState::kPassive;
    case CAN_STATE_BUS_OFF:
      return CanState::kBusOff;
    case CAN_STATE_STOPPED:
    case CAN_STATE_SLEEPING:
      return CanState::kDown;
    default:
      return CanState::kUnknown;
  }
}

void takeController(unsigned type, ByteView value, CanInterface& interface) noexcept {
  switch (type) {
    case IFLA_CAN_BITTIMING:
      interface.bit_rate = as<can_bittiming>(value).bitrate;
      break;
    case IFLA_CAN_STATE:
      interface.state = asState(as<std::uint32_t>(value));
      break;
    case IFLA_CAN_CTRLMODE:
      interface.listen_only = (as<can_ctrlmode>(value).flags & CAN_CTRLMODE_LISTENONLY) != 0;
      break;
    case IFLA_CAN_RESTART_MS:
      interface.restart_ms = as<std::uint32_t>(value);
      break;
    default:
      break;
  }
}

bool takeKind(ByteView nested, CanInterface& interface) noexcept {
  ByteView details;
  const bool whole = forEachAttribute(nested, [&](unsigned type, ByteView value) noexcept {
    if (type == IFLA_INFO_KIND) interface.kind = asWord(value);
    if (type == IFLA_INFO_DATA) details = value;
  });
  if (!whole || std::strcmp(interface.kind.c_str(), "can") != 0) return whole;
  interface.has_controller = true;
  return forEachAttribute(details,
                          [&](unsigned type, ByteView value) noexcept { takeController(type, value, interface); });
}

}  // namespace

bool parseLinkMessage(ByteView message, CanInterface& interface) noexcept {
  interface = CanInterface{};
  const auto header = as<nlmsghdr>(message);
  if (header.nlmsg_type != RTM_NEWLINK && header.nlmsg_type != RTM_DELLINK) return false;
  if (header.nlmsg_len > message.size() || header.nlmsg_len < NLMSG_LENGTH(sizeof(ifinfomsg))) return false;
  const ByteView body = message.sub(NLMSG_HDRLEN, header.nlmsg_len - NLMSG_HDRLEN);
  const auto info = as<ifinfomsg>(body);
  interface.index = info.ifi_index;
  interface.is_can = info.ifi_type == ARPHRD_CAN;
  interface.up = (info.ifi_flags & IFF_UP) != 0;
  interface.removed = header.nlmsg_type == RTM_DELLINK;
  bool whole = true;
  const ByteView attributes = body.sub(NLMSG_ALIGN(sizeof(ifinfomsg)));
  whole = forEachAttribute(attributes,
                           [&](unsigned type, ByteView value) noexcept {
                             if (type == IFLA_IFNAME) interface.name = asWord(value);
                             if (type == IFLA_QDISC) interface.queue = asWord(value);
                             if (type == IFLA_LINKINFO) whole = takeKind(value, interface) && whole;
                           }) &&
          whole;
  return whole;
}

}  // namespace nord_driver::link
