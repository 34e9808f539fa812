// Days by UTC: counted, and as people and files write them.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace nord_driver::state {

using WallTime = std::chrono::system_clock::time_point;

/// Days since 1970-01-01.
std::int64_t utcDay(WallTime time) noexcept;
/// "2026-11-23"; of years from 1 to 9999.
std::string dayText(std::int64_t day);
/// The other way round; nothing when it is no such day.
std::optional<std::int64_t> dayFrom(const std::string& text) noexcept;

}  // namespace nord_driver::state
