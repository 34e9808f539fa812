// A few registers of the server that are part of no image, read or written once, by one request.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/register_image.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::link {

struct RegisterOrder {
  static constexpr std::size_t kMostWords = 32;

  bool write = false;                     ///< function 16; otherwise they are read
  bool input_registers = false;           ///< read by function 4 instead of 3
  WordRange registers;                    ///< at most kMostWords
  std::array<Word, kMostWords> values{};  ///< to write
};

struct RegisterAnswer {
  std::uint64_t number = 0;  ///< of the order
  bool good = false;
  /// It was not carried out, and may be asked again: it never left, or was refused with exception 6, server device busy.
  bool not_taken = false;
  std::array<Word, RegisterOrder::kMostWords> values{};  ///< read
  Sentence text;                                         ///< why not, a sentence that begins with the server
};

}  // namespace nord_driver::link
