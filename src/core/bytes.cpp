#include "nord_driver/core/bytes.h"

#include <cctype>
#include <stdexcept>

namespace nord_driver {

namespace {

constexpr char kDigits[] = "0123456789ABCDEF";

void appendByte(std::string& text, std::uint8_t byte) {
  text += kDigits[byte >> 4];
  text += kDigits[byte & 0x0Fu];
}

int digitValue(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

}  // namespace

std::string toHex(ByteView bytes) {
  std::string text;
  text.reserve(bytes.size() * 3);
  for (const std::uint8_t byte : bytes) {
    if (!text.empty()) text += ' ';
    appendByte(text, byte);
  }
  return text;
}

std::vector<std::uint8_t> fromHex(const std::string& text) {
  std::vector<std::uint8_t> bytes;
  int high = -1;
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      if (high >= 0) throw std::invalid_argument("hexadecimal text \"" + text + "\": a digit stands alone");
      continue;
    }
    const int value = digitValue(c);
    if (value < 0)
      throw std::invalid_argument("hexadecimal text \"" + text + "\": '" + c + "' is no hexadecimal digit");
    if (high < 0) {
      high = value;
    } else {
      bytes.push_back(static_cast<std::uint8_t>(high << 4 | value));
      high = -1;
    }
  }
  if (high >= 0) throw std::invalid_argument("hexadecimal text \"" + text + "\": a digit stands alone");
  return bytes;
}

std::string toHexWord(Word word) {
  std::string text;
  appendByte(text, static_cast<std::uint8_t>(word >> 8));
  appendByte(text, static_cast<std::uint8_t>(word & 0xFFu));
  return text;
}

}  // namespace nord_driver
