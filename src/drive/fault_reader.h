// Reads from an inverter which fault it has, when its fault bit rises, and on request why it cannot be switched on.
//
// Sans-IO, one access at a time. P700 [-01] is the fault, [-03] the reason of "switch-on disabled" (BU 0020 8,
// BU 2700 7.2). P700 is an array from firmware V1.9 on; the first element of an older one is read all the same, the
// third is not there.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"
#include "nord_driver/profile/parameter_request.h"
#include "profile/status_word.h"

namespace nord_driver::drive {

/// What is known of the reason of "switch-on disabled".
enum class ReasonState : std::uint8_t {
  kNotAsked,
  kReading,
  kKnown,
  kNotAvailable,  ///< until the inverter is lost: this firmware has no P700 [-03], or there is no parameter channel
};

/// Each cycle with a useful status word: handleStatus(), then pollRequest(), and handleResult() when the transport has
/// the answer.
class FaultReader {
 public:
  void handleStatus(profile::StatusWord status) noexcept;
  /// The inverter is gone; a fault it comes back with is read anew, and without one there is none any more.
  void handleOffline() noexcept;
  /// Asks for the reason of "switch-on disabled" as it is now.
  void requestReason() noexcept;
  /// "Switch-on disabled" has ended: what was its reason says nothing about the next one. Also of an answer under way.
  void forgetReason() noexcept;

  /// The next access, when none is under way; its id is for the caller to choose. What could not be read is asked for
  /// again every second.
  std::optional<profile::ParameterRequest> pollRequest(Instant now) noexcept;
  /// The result of the request handed out last.
  void handleResult(const profile::ParameterResult& result) noexcept;

  /// P700 [-01] as read (102 = 10.2); 0: no fault; 65535: there is one, its number is not known (yet). While offline:
  /// the last one.
  std::uint16_t number() const noexcept { return number_; }
  /// The number of the last fault, also after it has vanished; 0: none was seen yet.
  std::uint16_t lastNumber() const noexcept { return last_number_; }
  /// P700 [-01] is being read, or to be: of a fault that has gone again, an answer under way may still tell it.
  bool awaitsNumber() const noexcept;

  ReasonState reasonState() const noexcept { return reason_state_; }
  /// P700 [-03] as read, with kKnown.
  std::uint16_t reason() const noexcept { return reason_; }

 private:
  enum class Item : std::uint8_t { kNone, kFault, kReason };

  Item nextItem(Instant now) const noexcept;
  void handleNumber(const profile::ParameterResult& result) noexcept;
  void handleReason(const profile::ParameterResult& result) noexcept;

  Item under_way_ = Item::kNone;
  Instant retry_at_{};
  bool away_ = false;        // what the fault bit was counts no longer
  bool fault_ = false;       // the fault bit
  bool same_fault_ = false;  // ... has stood since the request that is under way
  bool same_hold_ = false;   // nobody has forgotten the reason since then
  std::uint16_t number_ = 0;
  std::uint16_t last_number_ = 0;
  ReasonState reason_state_ = ReasonState::kNotAsked;
  std::uint16_t reason_ = 0;
};

}  // namespace nord_driver::drive
