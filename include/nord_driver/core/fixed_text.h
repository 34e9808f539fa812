// A short text with a fixed capacity, for sentences made in the cycle thread: never allocates, cut when too long.
#pragma once

#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <string>

namespace nord_driver {

template <std::size_t Capacity>
class FixedText {
 public:
  FixedText() = default;
  FixedText(const char* text) noexcept { format("%s", text); }

  /// Replaces the text, printf-like. What does not fit is cut off.
  __attribute__((format(printf, 2, 3))) void format(const char* pattern, ...) noexcept {
    va_list arguments;
    va_start(arguments, pattern);
    std::vsnprintf(text_, sizeof text_, pattern, arguments);
    va_end(arguments);
  }
  void clear() noexcept { text_[0] = '\0'; }

  bool empty() const noexcept { return text_[0] == '\0'; }
  const char* c_str() const noexcept { return text_; }
  std::string str() const { return text_; }

 private:
  char text_[Capacity + 1] = {};
};

using Sentence = FixedText<250>;

}  // namespace nord_driver
