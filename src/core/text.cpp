#include "core/text.h"

namespace nord_driver {

std::string trimmed(const std::string& text) {
  constexpr const char* kWhiteSpace = " \t\r\n\v\f";
  const std::size_t begin = text.find_first_not_of(kWhiteSpace);
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(kWhiteSpace) - begin + 1);
}

std::string lowerCase(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::size_t textBegin(const std::string& file) noexcept {
  constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";
  return file.compare(0, 3, kByteOrderMark) == 0 ? 3 : 0;
}

}  // namespace nord_driver
