// Frames as candump prints them: "44E#0A4B0301070A", a remote frame "44E#R1".
#pragma once

#include <cstdio>
#include <string>

#include "core/can_frame.h"
#include "nord_driver/core/bytes.h"

namespace nord_driver::devicenet {

inline std::string text(const CanFrame& frame) {
  char id[16];
  std::snprintf(id, sizeof id, "%03X#", static_cast<unsigned>(frame.id));
  if (frame.remote) return std::string{id} + "R" + std::to_string(frame.size);
  std::string hex = toHex(frame.bytes());
  std::string packed;
  for (const char c : hex) {
    if (c != ' ') packed += c;
  }
  return id + packed;
}

inline CanFrame frame(const std::string& candump) {
  const std::size_t hash = candump.find('#');
  const auto id = static_cast<std::uint32_t>(std::stoul(candump.substr(0, hash), nullptr, 16));
  const std::string data = candump.substr(hash + 1);
  if (!data.empty() && data[0] == 'R') return remoteFrame(id, static_cast<std::uint8_t>(std::stoul(data.substr(1))));
  return dataFrame(id, fromHex(data));
}

}  // namespace nord_driver::devicenet
