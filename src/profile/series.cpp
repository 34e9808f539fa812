#include "nord_driver/profile/series.h"

namespace nord_driver::profile {

const char* toString(Series series) noexcept {
  switch (series) {
    case Series::kSk1x0e:
      return "sk1x0e";
    case Series::kSk2xxe:
      return "sk2xxe";
    case Series::kSk300e:
      return "sk300e";
    case Series::kSk5xxe:
      return "sk5xxe";
    case Series::kSk54xe:
      return "sk54xe";
    case Series::kSk700e:
      return "sk700e";
    case Series::kSk750e:
      return "sk750e";
  }
  return "";
}

std::optional<Series> seriesFrom(const std::string& name) {
  for (const Series series : kAllSeries) {
    if (name == toString(series)) return series;
  }
  return std::nullopt;
}

}  // namespace nord_driver::profile
