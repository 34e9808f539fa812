// What the newest inputs of a gateway are worth: whether they are new, whether they are young enough, and whether the
// ring they come from runs.
#pragma once

#include <cstdint>

#include "link/modbus/register_link.h"
#include "nord_driver/transport/cyclic_exchange.h"

namespace nord_driver {

enum class InputWorth : std::uint8_t {
  kNone,        ///< none have come yet
  kGood,        ///< of a ring that runs, and younger than the time-out
  kOld,         ///< the gateway does not answer, or answers too late
  kRingStands,  ///< the gateway answers, and says that its ring does not run
};

/// The age of inputs counts from the moment they were asked for, not from the one they came: a gateway that answers late
/// tells of the past. Where they are too old the drive's time-out is over, however lately they came.
class InputWatch {
 public:
  /// Inputs of this age are still good. Before it is told: 50 ms.
  void setTimeout(Duration timeout) noexcept { timeout_ = timeout; }
  Duration timeout() const noexcept { return timeout_; }

  /// Once per cycle, with the newest there are.
  void handle(const link::RegisterInputs& newest, Instant now) noexcept;

  InputWorth worth() const noexcept { return worth_; }
  bool isGood() const noexcept { return worth_ == InputWorth::kGood; }
  /// Good, and not those of the cycle before.
  bool isFresh() const noexcept { return fresh_; }
  /// In the cycle in which good inputs ended: kUnasked when the ring stands, kSilent when they became too old.
  Interruption interruption() const noexcept { return interruption_; }
  /// Of the inputs of the last handle(); 0 before any have come.
  Duration age() const noexcept { return age_; }

 private:
  Duration timeout_{std::chrono::milliseconds{50}};
  std::uint64_t number_ = 0;
  InputWorth worth_ = InputWorth::kNone;
  bool fresh_ = false;
  Interruption interruption_ = Interruption::kNone;
  Duration age_{};
};

}  // namespace nord_driver
