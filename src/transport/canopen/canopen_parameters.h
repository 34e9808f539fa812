// One inverter's parameters by SDO: takes requests, asks for their objects one at a time.
//
// SDO has no access that spares the EEPROM: whether a write wears it is P560's to say (BU 0280 P560). So a write to the
// RAM only is none of its capabilities, and is refused without asking.
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/sdo_request.h"
#include "nord_driver/profile/parameter_request.h"
#include "profile/parameter_queue.h"
#include "transport/canopen/canopen_map.h"

namespace nord_driver {

/// Sans-IO; the SDO client watches the time.
class CanopenParameters {
 public:
  /// The most requests waiting, running, or finished and not fetched.
  static constexpr std::size_t kCapacity = profile::ParameterQueue::kCapacity;

  /// `tag`: in the upper half of the ids of the SDO requests, so that the answers of several drives are told apart.
  CanopenParameters(const CanopenDrive& drive, std::uint16_t tag) noexcept : drive_(drive), tag_(tag) {}

  static constexpr profile::ParameterCapabilities capabilities() noexcept { return {false, true}; }

  /// As ParameterQueue::submit().
  bool submit(const profile::ParameterRequest& request) noexcept;
  /// The access to start next, when none is under way; `handleStarted()` when a server has taken it.
  std::optional<canopen::SdoRequest> pendingAccess() const noexcept;
  void handleStarted() noexcept { under_way_ = true; }
  /// Answers to accesses given up before are left out.
  void handleAnswer(const canopen::SdoAnswer& answer) noexcept;
  /// Ends all pending requests as offline.
  void handleOffline() noexcept;
  std::optional<profile::ParameterResult> pollResult() noexcept { return requests_.pollResult(); }

  /// Of the tag given to the constructor.
  static std::uint16_t tagOf(std::uint32_t id) noexcept { return static_cast<std::uint16_t>(id >> 16); }

 private:
  std::uint32_t accessId() const noexcept { return std::uint32_t{tag_} << 16 | sequence_; }
  bool fallBack(std::uint32_t abort_code) noexcept;
  void takeValue(const canopen::SdoAnswer& answer) noexcept;
  void next() noexcept;

  CanopenDrive drive_;
  std::uint16_t tag_;
  std::uint16_t sequence_ = 0;
  bool under_way_ = false;
  bool plain_ = false;  // the running request is asked for with sub-index 0
  profile::ParameterQueue requests_;
};

}  // namespace nord_driver
