// The inverter series this driver knows.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace nord_driver::profile {

enum class Series : std::uint8_t { kSk1x0e, kSk2xxe, kSk300e, kSk5xxe, kSk54xe, kSk700e, kSk750e };

constexpr std::array<Series, 7> kAllSeries{Series::kSk1x0e, Series::kSk2xxe, Series::kSk300e, Series::kSk5xxe,
                                           Series::kSk54xe, Series::kSk700e, Series::kSk750e};

/// "sk5xxe", as configurations write it.
const char* toString(Series series) noexcept;

/// The series of a configuration's word: "sk5xxe", "SK5XXE", or what the nameplate says, "SK 535E-750-340-A". None when
/// the word is unknown, or could mean two series.
std::optional<Series> seriesFrom(const std::string& name);

}  // namespace nord_driver::profile
