// The statements of a GSD file: comments gone, continued lines joined, each with the number of its first line.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "profibus/gsd_file.h"

namespace nord_driver::profibus {

struct GsdStatement {
  std::size_t line = 0;
  std::string key;       ///< in lower case: "ext_user_prm_data_const"
  std::string argument;  ///< in the brackets behind the key
  std::string value;     ///< behind '=', spaces at the ends gone
  std::string text;      ///< all of it as written, spaces at the ends gone
};

std::vector<GsdStatement> splitGsd(const std::string& text);

/// A number as GSD files write it, decimal or 0x; nothing when it is none or above `limit` (at most a million).
std::optional<unsigned> gsdNumber(const std::string& text, unsigned limit);
/// The text between quotes at the front, double or single ones; `rest` is what follows. Without quotes, or without the
/// second one: false.
bool gsdQuoted(const std::string& value, std::string& quoted, std::string& rest);
/// Bytes separated by commas. False when one of them is none; the good ones before it are kept.
bool gsdBytes(const std::string& text, std::vector<std::uint8_t>& bytes);

}  // namespace nord_driver::profibus
