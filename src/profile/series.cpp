#include "nord_driver/profile/series.h"

#include <cctype>
#include <cstring>

namespace nord_driver::profile {

namespace {

bool isOneOf(char letter, const char* letters) noexcept {
  return std::strchr(letters, letter) != nullptr && letter != '\0';
}

// The three figures of "sk535e", an x standing for any of them.
std::optional<Series> seriesOf(const std::string& figures) {
  const char first = figures[0], second = figures[1], third = figures[2];
  if (figures == "300") return Series::kSk300e;
  if (figures == "700") return Series::kSk700e;
  if (figures == "750") return Series::kSk750e;
  if (first == '1' && isOneOf(second, "89x") && third == '0') return Series::kSk1x0e;
  if (first == '2' && isOneOf(second, "0123x")) return Series::kSk2xxe;
  if (first == '5' && second == '4') return Series::kSk54xe;
  if (first == '5' && isOneOf(second, "0123x")) return Series::kSk5xxe;
  return std::nullopt;
}

}  // namespace

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
  std::string word;
  for (const char letter : name) {
    if (letter != ' ') word += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  constexpr std::size_t kLength = 6;  // of "sk535e"; after it the nameplate has power and voltage
  const bool ends = word.size() == kLength || (word.size() > kLength && word[kLength] == '-');
  if (!ends || word.compare(0, 2, "sk") != 0 || word[kLength - 1] != 'e') return std::nullopt;
  const std::string figures = word.substr(2, 3);
  for (const char figure : figures) {
    if (!isOneOf(figure, "0123456789x")) return std::nullopt;
  }
  return seriesOf(figures);
}

}  // namespace nord_driver::profile
