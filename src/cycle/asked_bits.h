// What P480 and P481 have to say of the single bits a drive that positions is asked by, and says by.
#pragma once

#include <cstdint>
#include <vector>

#include "cycle/position_setup.h"
#include "nord_driver/profile/series.h"

namespace nord_driver::cycle {

struct AskedBit {
  std::uint16_t number = 480;  ///< or 481
  std::uint8_t element = 1;    ///< of that parameter, as the manual counts
  std::uint16_t function = 0;  ///< what it has to be
  const char* key = "";        ///< of the configuration: "position/home"
};

/// Each bit that is configured and has its meaning from one of these parameters. Of the array those that are ever high.
std::vector<AskedBit> askedBits(const PositionSetup& setup, profile::Series series);

}  // namespace nord_driver::cycle
