// Which functions the words of a drive must have for what is configured, and which one is missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "cycle/device_data.h"
#include "cycle/position_setup.h"
#include "cycle/word_setup.h"
#include "drive/drive_report.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/profile/series.h"
#include "profile/word_function.h"

namespace nord_driver::cycle {

struct WordNeed {
  bool actual_value;
  profile::WordUse use;
  /// The words that may have this use, from 1. Of most word 1 is none, because it is the frequency.
  std::uint8_t first = 2;
  std::uint8_t last = 3;
};

struct WordNeeds {
  FixedVector<WordNeed, 16> list;
  std::size_t words = 1;  ///< setpoints and actual values the bus carries, the first included

  bool bits = false;  ///< bits whose function is in P480 are in use
  /// It positions: word 1 may be a position, and is set to be one where the others do not suffice.
  bool positions = false;
  bool first_setpoint_is_free = false;      ///< it need not be the frequency
  bool first_actual_value_is_free = false;  ///< likewise
  /// The element of P481 that has to show its reference; 0: none.
  std::uint8_t out_bit = 0;
  /// P610 as it has to be; -1: it is not looked at.
  std::int32_t setpoint_mode = -1;

  bool firstIsFree(bool actual_value) const noexcept {
    return actual_value ? first_actual_value_is_free : first_setpoint_is_free;
  }
  bool empty() const noexcept { return list.empty() && !bits; }
};

/// Each use once.
WordNeeds wordNeeds(const WordSetup& setup, std::size_t carried) noexcept;

/// Those of a node that only looks on: what it sends nobody needs.
WordNeeds onlyInputs(const WordNeeds& needs) noexcept;

/// And those of a drive that positions.
void addPositionNeeds(const PositionSetup& setup, profile::Series series, WordNeeds& needs) noexcept;

/// The word that carries this bit; of a bit of the control word nobody asks.
WordNeed needOf(const PositionBit& bit) noexcept;
/// The element of P480 that says what this bit does; none: it has its meaning from its word.
std::optional<std::uint8_t> elementOf(const PositionBit& bit) noexcept;

/// The element of P481 that says what `referenced` shows; 0: no bit says it, or nobody asks what it shows, or it is a bit of
/// the status word of SK 700E and 750E, which P481 does not assign (BU 0020 6.1.1, 7.3.4).
std::uint8_t referencedElement(const PositionSetup& setup, profile::Series series) noexcept;

/// What word 1 carries need not be the frequency: it is a position of a drive that positions.
bool isPosition(profile::WordUse use) noexcept;

/// Word 1 is what it has to be: the frequency or, of a drive that positions, a position.
bool firstWordFits(const WordNeeds& needs, bool actual_value, std::uint16_t code, profile::Series series) noexcept;

/// The word in `place` (1 to 3) has this use, by what the drive has told.
bool carries(std::size_t place, const WordNeed& need, const WordFunctions& functions, profile::Series series) noexcept;

/// The first need that no word of the set meets, with the parameter that would best be set: of a word that is off, else
/// of one nobody needs. Then what stands in a word and must not: half a position, or one that another word has, too.
/// None when all is as it has to be.
std::optional<drive::UnexpectedFunction> missingWord(const WordNeeds& needs, const WordFunctions& functions,
                                                     profile::Series series) noexcept;

}  // namespace nord_driver::cycle
