#include "link/can/can_settings.h"

#include <algorithm>

namespace nord_driver::link {

namespace {

constexpr std::size_t kPrefixLength = sizeof kVirtualCanPrefix - 1;

bool isPlain(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
}

/// As the kernel's dev_valid_name(): neither a slash, a colon nor white space.
bool mayBeInInterfaceName(char c) noexcept {
  return c > ' ' && c != '/' && c != ':' && c != 0x7F;
}

bool checkVirtualName(const std::string& interface, Sentence& reason) noexcept {
  const std::size_t length = interface.size() - kPrefixLength;
  const auto name = interface.begin() + kPrefixLength;
  if (length > 0 && length <= kLongestVirtualName && std::all_of(name, interface.end(), isPlain)) return true;
  reason.format("interface '%.80s': the name of a virtual bus is 1 to %zu letters, digits, '_', '-' or '.'",
                interface.c_str(), kLongestVirtualName);
  return false;
}

bool checkInterfaceName(const std::string& name, Sentence& reason) noexcept {
  if (!name.empty() && name.size() <= kLongestInterfaceName && name != "." && name != ".." &&
      std::all_of(name.begin(), name.end(), mayBeInInterfaceName)) {
    return true;
  }
  reason.format("interface '%.80s': the name of a network interface is 1 to %zu characters without spaces, '/' or ':'",
                name.c_str(), kLongestInterfaceName);
  return false;
}

bool checkIdentifiers(const std::vector<std::uint32_t>& ids, const std::string& name, Sentence& reason) noexcept {
  for (const std::uint32_t id : ids) {
    if (id <= kHighestStandardId) continue;
    reason.format("%s: identifier %Xh has more than 11 bits", name.c_str(), static_cast<unsigned>(id));
    return false;
  }
  return true;
}

}  // namespace

bool isVirtualCan(const std::string& interface) noexcept {
  return interface.compare(0, kPrefixLength, kVirtualCanPrefix) == 0;
}

bool checkCanSettings(const CanSettings& settings, Sentence& reason) noexcept {
  const std::string& name = settings.interface;
  if (!(isVirtualCan(name) ? checkVirtualName(name, reason) : checkInterfaceName(name, reason))) return false;
  const std::size_t count = settings.ids.size() + settings.remote_ids.size();
  if (count > kMostCanIds) {
    reason.format("%s: %zu identifiers to receive, the kernel filters %zu at most", name.c_str(), count, kMostCanIds);
    return false;
  }
  return checkIdentifiers(settings.ids, name, reason) && checkIdentifiers(settings.remote_ids, name, reason);
}

}  // namespace nord_driver::link
