// The kernel's word for an error, without taking memory.
#pragma once

#include <string.h>

namespace nord_driver::link {

class ErrorText {
 public:
  explicit ErrorText(int error) noexcept : text_(::strerror_r(error, buffer_, sizeof buffer_)) {}
  ErrorText(const ErrorText&) = delete;
  ErrorText& operator=(const ErrorText&) = delete;
  const char* c_str() const noexcept { return text_; }

 private:
  char buffer_[64] = {};
  const char* text_;  // the GNU strerror_r may give a text of its own instead of the buffer
};

}  // namespace nord_driver::link
