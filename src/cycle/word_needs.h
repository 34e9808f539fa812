// Which functions the words of a drive must have for what is configured, and which one is missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "cycle/device_data.h"
#include "cycle/word_setup.h"
#include "drive/drive_report.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/profile/series.h"
#include "profile/word_function.h"

namespace nord_driver::cycle {

struct WordNeed {
  bool actual_value;
  profile::WordUse use;
};

struct WordNeeds {
  FixedVector<WordNeed, 16> list;
  std::size_t words = 1;  ///< setpoints and actual values the bus carries, the first included

  bool bits = false;  ///< bits whose function is in P480 are in use

  bool empty() const noexcept { return list.empty() && !bits; }
};

/// Each use once.
WordNeeds wordNeeds(const WordSetup& setup, std::size_t carried) noexcept;

/// The word in `place` (2 or 3) has this use, by what the drive has told. Word 1 is the frequency.
bool carries(std::size_t place, const WordNeed& need, const WordFunctions& functions, profile::Series series) noexcept;

/// The first need that no word of the set meets, with the parameter that would best be set: of a word that is off, else
/// of one nobody needs. None when all are met.
std::optional<drive::UnexpectedFunction> missingWord(const WordNeeds& needs, const WordFunctions& functions,
                                                     profile::Series series) noexcept;

}  // namespace nord_driver::cycle
