#include "tools/json_text.h"

#include <cmath>
#include <cstdio>

namespace nord_driver::tools {

namespace {

std::string quoted(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') {
      text += std::string("\\") + c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
      text += code;
    } else {
      text += c;
    }
  }
  return text + "\"";
}

}  // namespace

void JsonText::separate() {
  if (!first_ && !after_key_) text_ += ", ";
  first_ = false;
  after_key_ = false;
}

JsonText& JsonText::begin(char bracket) {
  separate();
  text_ += bracket;
  first_ = true;
  return *this;
}

JsonText& JsonText::end(char bracket) {
  text_ += bracket;
  first_ = false;
  return *this;
}

JsonText& JsonText::key(const std::string& name) {
  separate();
  text_ += quoted(name) + ": ";
  after_key_ = true;
  return *this;
}

JsonText& JsonText::text(const std::string& value) {
  separate();
  text_ += quoted(value);
  return *this;
}

JsonText& JsonText::number(double value) {
  separate();
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.9g", value);
  text_ += std::isfinite(value) ? digits : "null";
  return *this;
}

JsonText& JsonText::whole(std::int64_t value) {
  separate();
  text_ += std::to_string(value);
  return *this;
}

JsonText& JsonText::boolean(bool value) {
  separate();
  text_ += value ? "true" : "false";
  return *this;
}

}  // namespace nord_driver::tools
