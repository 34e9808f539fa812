// What is known of a parameter that is read again and again for people to look at.
#pragma once

#include <cstdint>

#include "nord_driver/core/fixed_text.h"

namespace nord_driver::cycle {

struct MonitoredValue {
  enum class State : std::uint8_t {
    kNotRead,  ///< since the drive is back
    kKnown,
    kRefused,   ///< by the drive, or nothing carries it there
    kNoAnswer,  ///< the last question has timed out
  };

  State state = State::kNotRead;
  std::int32_t raw = 0;  ///< with kKnown
  FixedText<160> why;    ///< a sentence, with kRefused and kNoAnswer
};

}  // namespace nord_driver::cycle
