// Reads the last faults an inverter remembers, when it has a new one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::cycle {

/// P701 [-01] to [-05] (BU 0020 8.1; BU 0220 5.1.4): the newest first.
constexpr std::size_t kRememberedFaults = 5;

struct FaultHistory {
  /// P701 raw (102 = 10.2; 0: none); as many as the inverter has told.
  FixedVector<std::uint16_t, kRememberedFaults> numbers;
  bool asked = false;  ///< all that can be known of the fault there was last
};

/// Once per fault, when its number is known: the inverter has filled in P700 and P701 by then. So it has when the fault
/// has gone again, with a number that nobody has read. An element that times out is asked for three times; one that is
/// refused is the end.
class FaultHistoryReader {
 public:
  /// Each cycle the drive is online. `fault`: its fault bit; `last_number`: of the last fault, as FaultReader has it;
  /// `number_awaited`: P700 may tell it still.
  void handleFault(bool fault, std::uint16_t last_number, bool number_awaited) noexcept;
  /// The drive went away; a fault it comes back with is a new one.
  void handleOffline() noexcept;
  /// The next access, when none is under way; its id is for the caller to choose.
  std::optional<profile::ParameterRequest> pollRequest() noexcept;
  /// The result of the request handed out last.
  void handleResult(const profile::ParameterResult& result) noexcept;

  const FaultHistory& history() const noexcept { return history_; }

 private:
  enum class State : std::uint8_t { kIdle, kNumberAwaited, kReading };

  void end() noexcept;

  State state_ = State::kIdle;
  bool fault_ = false;
  bool waiting_ = false;
  std::uint8_t attempts_ = 0;
  FaultHistory history_;
};

}  // namespace nord_driver::cycle
