// The parameter channel's four words: order and answer labels, index, value, error numbers (BU 2700 6.5, BU 0020 7.5).
#pragma once

#include <array>
#include <cstdint>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::profile {

/// PKE, IND, PWE1 (high word), PWE2 (low word).
using PkwWords = std::array<Word, 4>;

/// What the master asks for: AK of an order (BU 2700 6.5.1.1).
enum class OrderLabel : std::uint8_t {
  kNone = 0,
  kRead = 1,  ///< ignores the index (BU 0020 7.5.2)
  kWriteWord = 2,
  kWriteDouble = 3,
  kReadArray = 6,
  kWriteArrayWord = 7,
  kWriteArrayDouble = 8,
  kReadArrayLength = 9,
  kWriteArrayDoubleRam = 11,  ///< not into the EEPROM, as 12..14
  kWriteArrayWordRam = 12,    ///< BU 2700 6.5.1.1 says "double word": the manual errs, BU 0020 7.5.1
  kWriteDoubleRam = 13,
  kWriteWordRam = 14,
};

/// What the inverter answers: AK of an answer.
enum class AnswerLabel : std::uint8_t {
  kNone = 0,
  kWord = 1,
  kDouble = 2,
  kArrayWord = 4,
  kArrayDouble = 5,
  kArrayLength = 6,
  kError = 7,
};

/// An error number in an answer 7 as a clause: "PKW error 3, the sub-index is wrong".
Sentence pkwErrorText(std::uint16_t number) noexcept;
/// What it means to the driver.
ParameterReason pkwReason(std::uint16_t number) noexcept;

struct PkwOrder {
  OrderLabel label = OrderLabel::kNone;
  std::uint16_t number = 0;  ///< the manual's, 0..999
  Word index = 0;            ///< IND as on the wire
  std::int32_t value = 0;
};

struct PkwAnswer {
  std::uint8_t label = 0;  ///< raw: an inverter may send a reserved one
  std::uint16_t pnu = 0;   ///< parameter number as on the wire, 0..2047
  Word index = 0;
  /// Two words when the label says double word. Else PWE2, negative when PWE1 says so (FFFFh); whether another word is
  /// signed only the parameter's own description knows.
  std::int32_t value = 0;
  std::uint16_t error_number = 0;  ///< PWE2, with label 7
};

/// IND for a set (1..4) and an element (the manual's [-01] = 1): 0-based on the wire, in the high byte. In arrays of
/// set-dependent parameters 4 * (element - 1) + (set - 1), in others element - 1 (BU 0020 7.5.2; its table calls the
/// raw value 5 "element 5": the manual errs).
Word pkwIndex(ParameterShape shape, std::uint8_t set, std::uint8_t element) noexcept;

/// PNU = number + 1000 (BU 2700 6.5.1.1). Negative values fill PWE1 with FFFFh (6.5.1.3).
PkwWords toWords(const PkwOrder& order) noexcept;
PkwAnswer toAnswer(const PkwWords& words) noexcept;

bool isWrite(OrderLabel label) noexcept;
bool isDoubleWord(OrderLabel label) noexcept;

/// True when the answer can be the one to the order: label, number, index, and for writes the value, or an error naming
/// the parameter. The inverter repeats its previous answer until it has executed the order (BU 2700 6.5.1.1).
bool answers(const PkwOrder& order, const PkwAnswer& answer) noexcept;

}  // namespace nord_driver::profile
