// How many bytes an exchange carries, read from the configuration bytes of Chk_Cfg.
#pragma once

#include <cstddef>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::profibus {

struct IoLengths {
  std::size_t outputs = 0;
  std::size_t inputs = 0;
};

/// The sum over all identifiers, compact and special format (EN 50170-8, Chk_Cfg). Nothing when the bytes end in the
/// middle of an identifier.
std::optional<IoLengths> ioLengths(ByteView configuration) noexcept;

/// A sentence for a technician, subject left out: both byte lists, and how many bytes they stand for.
Sentence compareConfigurations(ByteView configured, ByteView reported) noexcept;

}  // namespace nord_driver::profibus
