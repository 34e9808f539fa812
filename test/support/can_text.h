// Frames as candump prints them: "632#4000100000000000", a remote frame "732#R1".
#pragma once

#include <string>

#include "core/can_frame.h"
#include "core/can_trace.h"
#include "nord_driver/core/bytes.h"

namespace nord_driver {

inline std::string text(const CanFrame& frame) {
  return candumpText(frame);
}

inline CanFrame frame(const std::string& candump) {
  const std::size_t hash = candump.find('#');
  const auto id = static_cast<std::uint32_t>(std::stoul(candump.substr(0, hash), nullptr, 16));
  const std::string data = candump.substr(hash + 1);
  if (!data.empty() && data[0] == 'R') return remoteFrame(id, static_cast<std::uint8_t>(std::stoul(data.substr(1))));
  return dataFrame(id, fromHex(data));
}

}  // namespace nord_driver
