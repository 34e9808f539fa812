// Sentences about object dictionary entries that were refused or hold something else.
#pragma once

#include <cstdint>

#include "canopen/sdo_request.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::canopen {

/// How far a piece of the start-up has come.
enum class Progress : std::uint8_t { kGoOn, kDone, kFailed };

/// The number of an answer, cut to the `size` bytes the entry has: an answer need not tell its size. Nothing when it
/// failed or is no number.
std::optional<std::uint32_t> numberOf(const SdoAnswer& answer, std::size_t size) noexcept;

/// "mapping of TPDO 2 (1A01h:1) cannot be written: abort 0601 0002h (the object is read-only)".
Sentence refusalText(const char* what, const SdoRequest& request, const SdoAnswer& answer) noexcept;

}  // namespace nord_driver::canopen
