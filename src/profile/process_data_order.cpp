#include "profile/process_data_order.h"

namespace nord_driver::profile {

// BU 0020 7.2.2: STW SW1 SW3 SW2 on these; 7.2.3, BU 2700 6.2: STW SW1 SW2 SW3 on all others.
bool thirdBeforeSecond(Series series) noexcept {
  return series == Series::kSk300e || series == Series::kSk700e || series == Series::kSk750e;
}

}  // namespace nord_driver::profile
