// Errors of the line since the start of the program, out of a UART's counters that begin anywhere and wrap.
#pragma once

#include <cstdint>

#include "link/serial/byte_link.h"
#include "link/serial/serial_system.h"

namespace nord_driver::link {

class LineErrors {
 public:
  /// The line was opened: what its UART has counted before is not ours.
  void begin(const RawLineCounters& now) noexcept { last_ = now; }

  void update(const RawLineCounters& now) noexcept {
    // Differences of 32-bit numbers without a sign are right across the wrap.
    total_.parity_errors += static_cast<std::uint32_t>(now.parity - last_.parity);
    total_.framing_errors += static_cast<std::uint32_t>(now.framing - last_.framing);
    total_.overruns += static_cast<std::uint32_t>(now.overrun - last_.overrun);
    total_.overruns += static_cast<std::uint32_t>(now.buffer_overrun - last_.buffer_overrun);
    last_ = now;
  }

  const LineCounters& total() const noexcept { return total_; }

 private:
  RawLineCounters last_;
  LineCounters total_;
};

}  // namespace nord_driver::link
