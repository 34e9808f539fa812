// What the readers of text files share, whatever the file is.
#pragma once

#include <cstddef>
#include <string>

namespace nord_driver {

/// Without white space at its ends.
std::string trimmed(const std::string& text);
/// ASCII letters only.
std::string lowerCase(std::string text);
/// Where the text of a file begins: behind the byte order mark of UTF-8, which editors on Windows put before it.
std::size_t textBegin(const std::string& file) noexcept;

}  // namespace nord_driver
