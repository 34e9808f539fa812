// What the error frames of a controller and the kernel messages about its interface add up to: a state, counters, a sentence.
#pragma once

#include "link/can/can_interface.h"
#include "link/can/can_link.h"
#include "link/can/can_system.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

/// The classes of error frames that say something about the bus (linux/can/error.h). One class is left out: a bare
/// CAN_ERR_BUSERROR says no more than the class beside it.
extern const std::uint32_t kCanErrorClasses;

class CanHealth {
 public:
  /// So many frames received after the last error frame prove that the error counters have sunk below the warning
  /// limit again (ISO 11898-1: each good frame lowers them by one); some drivers never say so.
  static constexpr int kFramesToRecover = 256;
  /// A queue that stays full this often in a row is worth a sentence.
  static constexpr int kFullToTell = 3;

  /// The link was opened. Counters go on.
  void opened(const CanInterface& interface) noexcept;
  /// The interface changed.
  void handleInterface(const CanInterface& interface) noexcept;
  void handleDown() noexcept;
  void handleError(const CanErrorFrame& error, Instant now) noexcept;
  void handleFrame() noexcept;
  void handleSent() noexcept;
  void handleQueueFull() noexcept;
  /// So many more frames were lost on the receiving side.
  void addDropped(std::uint32_t count) noexcept { counters_.dropped += count; }
  /// A restart was asked for and is not permitted.
  void restartRefused() noexcept { restart_refused_ = true; }

  /// An interface without automatic restart is bus-off, and nobody has refused to restart it.
  bool wantsRestart() const noexcept;
  CanState state() const noexcept { return state_; }
  const CanCounters& counters() const noexcept { return counters_; }
  const CanInterface& interface() const noexcept { return interface_; }
  /// See CanLink::advice(). Lives until the next call.
  const char* advice() const noexcept;

 private:
  void enter(CanState state) noexcept;
  void handleController(std::uint8_t status) noexcept;
  void countBusError(Instant now) noexcept;
  void tellBusOff() const noexcept;

  CanInterface interface_;
  CanState state_ = CanState::kUnknown;
  CanCounters counters_;
  bool nobody_acknowledges_ = false;
  bool restart_refused_ = false;
  int full_in_a_row_ = 0;
  int good_frames_ = 0;
  Instant second_begins_{};
  std::uint32_t errors_this_second_ = 0;
  std::uint32_t error_rate_ = 0;  // protocol errors in the last second that had some
  mutable Sentence advice_;
};

}  // namespace nord_driver::link
