// What a CAN link is told when it is made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nord_driver/core/fixed_text.h"

namespace nord_driver::link {

/// The kernel takes this many filters per socket (linux/can.h, CAN_RAW_FILTER_MAX).
constexpr std::size_t kMostCanIds = 512;
constexpr std::uint32_t kHighestStandardId = 0x7FF;
/// What is before the name of a bus between processes, which no kernel has to know.
constexpr char kVirtualCanPrefix[] = "virtual:";
constexpr std::size_t kLongestVirtualName = 64;
/// IFNAMSIZ without the closing zero.
constexpr std::size_t kLongestInterfaceName = 15;

struct CanSettings {
  std::string interface;             ///< "can0", or "virtual:NAME"
  std::vector<std::uint32_t> ids{};  ///< 11 bit identifiers of data frames to receive; empty: every frame there is
  std::uint32_t bit_rate = 0;        ///< bit/s the interface must run at, within 0.5 %; 0: whatever it runs at
  /// 11 bit identifiers of remote frames to receive beside `ids`; each takes a filter as well.
  std::vector<std::uint32_t> remote_ids{};
};

/// "virtual:NAME" and not an interface of the kernel.
bool isVirtualCan(const std::string& interface) noexcept;

/// False: `reason` names the setting and what it may be.
bool checkCanSettings(const CanSettings& settings, Sentence& reason) noexcept;

}  // namespace nord_driver::link
