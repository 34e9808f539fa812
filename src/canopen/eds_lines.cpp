#include "canopen/eds_lines.h"

#include <algorithm>
#include <limits>

#include "core/text.h"

namespace nord_driver::canopen {

namespace {

int digitOf(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return 99;
}

std::optional<std::uint64_t> digits(const std::string& text, std::size_t from, unsigned base) {
  if (from >= text.size()) return std::nullopt;
  std::uint64_t value = 0;
  for (std::size_t i = from; i < text.size(); ++i) {
    const int digit = digitOf(text[i]);
    if (digit >= static_cast<int>(base)) return std::nullopt;
    const auto add = static_cast<std::uint64_t>(digit);
    if (value > (std::numeric_limits<std::uint64_t>::max() - add) / base) return std::nullopt;
    value = value * base + add;
  }
  return value;
}

std::optional<std::uint64_t> unsignedNumber(const std::string& text) {
  if (text.size() > 1 && text[0] == '0' && text[1] == 'x') return digits(text, 2, 16);
  if (text.size() > 1 && text[0] == '0') {
    if (const auto octal = digits(text, 1, 8)) return octal;  // "08" and "09" are meant as decimal numbers
  }
  return digits(text, 0, 10);
}

std::optional<std::uint64_t> plainNumber(const std::string& text) {
  const bool negative = !text.empty() && text[0] == '-';
  const bool sign = negative || (!text.empty() && text[0] == '+');
  const auto magnitude = unsignedNumber(sign ? trimmed(text.substr(1)) : text);
  if (!magnitude || !negative) return magnitude;
  if (*magnitude > std::uint64_t{1} << 63) return std::nullopt;
  return ~*magnitude + 1;
}

}  // namespace

const EdsValue* EdsSection::find(const std::string& key) const noexcept {
  const auto found = values.find(key);
  return found == values.end() || found->second.text.empty() ? nullptr : &found->second;
}

EdsSections splitEds(const std::string& text, std::vector<EdsProblem>& problems) {
  EdsSections sections;
  EdsSection* section = nullptr;
  std::string section_name;
  std::size_t number = 0;
  for (std::size_t begin = textBegin(text); begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = trimmed(text.substr(begin, end - begin));
    begin = end + 1;
    ++number;
    if (line.empty() || line[0] == ';') continue;
    if (line[0] == '[') {
      const std::size_t close = line.find(']');
      if (close == std::string::npos) problems.push_back({number, "\"" + line + "\" has no closing bracket"});
      section_name = trimmed(line.substr(1, close == std::string::npos ? close : close - 1));
      const auto made = sections.try_emplace(lowerCase(section_name));
      section = &made.first->second;
      if (made.second) {
        section->line = number;
      } else {
        problems.push_back({number, "section [" + section_name + "] was there before (line " +
                                        std::to_string(section->line) + "); what it adds is taken"});
      }
      continue;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) {
      problems.push_back({number, "\"" + line + "\" is no section, no key with a value and no comment"});
    } else if (section == nullptr) {
      problems.push_back({number, "\"" + line + "\" stands before the first section"});
    } else {
      const std::string key = trimmed(line.substr(0, equals));
      const EdsValue value{number, trimmed(line.substr(equals + 1))};
      const auto made = section->values.try_emplace(lowerCase(key), value);
      if (!made.second) {
        problems.push_back({number, key + " stands twice in [" + section_name + "]; the first one (line " +
                                        std::to_string(made.first->second.line) + ") holds"});
      }
    }
  }
  return sections;
}

std::optional<EdsNumber> edsNumber(const std::string& text) {
  constexpr char kNodeId[] = "$nodeid";
  std::string rest = lowerCase(trimmed(text.substr(0, text.find(';'))));
  EdsNumber number;
  const std::size_t at = rest.find(kNodeId);
  if (at != std::string::npos) {
    number.plus_node_id = true;
    rest.erase(at, sizeof kNodeId - 1);
    rest = trimmed(rest);
    if (rest.empty()) return number;
    const std::size_t plus = at == 0 ? 0 : rest.size() - 1;
    if (rest[plus] != '+') return std::nullopt;
    rest = trimmed(rest.erase(plus, 1));
  }
  const auto value = plainNumber(rest);
  if (!value) return std::nullopt;
  number.value = *value;
  return number;
}

}  // namespace nord_driver::canopen
