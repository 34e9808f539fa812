// The codes of an error response (service 94h), and their texts.
#pragma once

#include <cstdint>

#include "nord_driver/core/fixed_text.h"

namespace nord_driver::devicenet {

/// General codes this engine decides by.
namespace general_error {
constexpr std::uint8_t kResourceUnavailable = 0x02;
constexpr std::uint8_t kAlreadyInState = 0x0B;
constexpr std::uint8_t kStateConflict = 0x0C;
constexpr std::uint8_t kNotEnoughData = 0x13;
constexpr std::uint8_t kTooMuchData = 0x15;
constexpr std::uint8_t kNoObject = 0x16;
}  // namespace general_error

/// Additional codes of allocate and release (DeviceNet object, class 3).
namespace allocate_error {
constexpr std::uint8_t kConflict = 0x01;
}  // namespace allocate_error

/// What the code means, without a full stop; null for a reserved one.
const char* generalErrorMeaning(std::uint8_t code) noexcept;
/// Of allocate (4Bh) and release (4Ch); null for a code or service that has none.
const char* additionalErrorMeaning(std::uint8_t service, std::uint8_t code) noexcept;

/// "refuses: the attribute is not supported (14h)", "refuses: ... (02h): it is allocated to another master (additional
/// code 01h)"; codes without a meaning as their numbers.
Sentence errorText(std::uint8_t service, std::uint8_t general, std::uint8_t additional) noexcept;

}  // namespace nord_driver::devicenet
