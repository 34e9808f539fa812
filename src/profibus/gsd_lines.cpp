#include "profibus/gsd_lines.h"

#include <cctype>

#include "core/text.h"

namespace nord_driver::profibus {

namespace {

/// Up to the comment, which begins with a semicolon outside quotes.
std::string withoutComment(const std::string& line) {
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote != '\0') {
      if (line[i] == quote) quote = '\0';
    } else if (line[i] == '"' || line[i] == '\'') {
      quote = line[i];
    } else if (line[i] == ';') {
      return line.substr(0, i);
    }
  }
  return line;
}

GsdStatement statement(std::size_t line, const std::string& text) {
  GsdStatement made;
  made.line = line;
  made.text = trimmed(text);
  const std::size_t equals = text.find('=');
  std::string key = trimmed(text.substr(0, equals));
  if (equals != std::string::npos) made.value = trimmed(text.substr(equals + 1));
  const std::size_t open = key.find('(');
  if (open != std::string::npos) {
    const std::size_t close = key.find(')', open);
    made.argument = trimmed(key.substr(open + 1, close == std::string::npos ? close : close - open - 1));
    key = trimmed(key.substr(0, open));
  }
  made.key = lowerCase(key);
  return made;
}

}  // namespace

std::vector<GsdStatement> splitGsd(const std::string& text) {
  std::vector<GsdStatement> statements;
  std::string joined;
  std::size_t first = 0, number = 0;
  bool continued = false;
  for (std::size_t begin = textBegin(text); begin < text.size();) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) end = text.size();
    ++number;
    if (!continued) {
      first = number;
      joined.clear();
    }
    std::string line = trimmed(withoutComment(text.substr(begin, end - begin)));
    continued = !line.empty() && line.back() == '\\';
    if (continued) line.pop_back();
    joined += line;
    begin = end + 1;
    if (!continued && !trimmed(joined).empty()) statements.push_back(statement(first, joined));
  }
  if (continued && !trimmed(joined).empty()) statements.push_back(statement(first, joined));
  return statements;
}

std::optional<unsigned> gsdNumber(const std::string& text, unsigned limit) {
  const std::string digits = trimmed(text);
  const bool hexadecimal = digits.size() > 2 && digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X');
  const unsigned base = hexadecimal ? 16 : 10;
  std::size_t i = hexadecimal ? 2 : 0;
  if (i == digits.size()) return std::nullopt;
  unsigned value = 0;
  for (; i < digits.size(); ++i) {
    const auto c = static_cast<unsigned char>(digits[i]);
    if (hexadecimal ? std::isxdigit(c) == 0 : std::isdigit(c) == 0) return std::nullopt;
    const auto digit = static_cast<unsigned>(std::isdigit(c) != 0 ? c - '0' : std::tolower(c) - 'a' + 10);
    value = value * base + digit;  // limits are small enough for one more digit
    if (value > limit) return std::nullopt;
  }
  return value;
}

bool gsdQuoted(const std::string& value, std::string& quoted, std::string& rest) {
  if (value.empty() || (value[0] != '"' && value[0] != '\'')) return false;
  const std::size_t close = value.find(value[0], 1);
  if (close == std::string::npos) return false;
  quoted = value.substr(1, close - 1);
  rest = trimmed(value.substr(close + 1));
  return true;
}

bool gsdBytes(const std::string& text, std::vector<std::uint8_t>& bytes) {
  for (std::size_t begin = 0; begin <= text.size();) {
    std::size_t end = text.find(',', begin);
    if (end == std::string::npos) end = text.size();
    const auto byte = gsdNumber(text.substr(begin, end - begin), 0xFF);
    if (!byte) return false;
    bytes.push_back(static_cast<std::uint8_t>(*byte));
    begin = end + 1;
  }
  return true;
}

}  // namespace nord_driver::profibus
