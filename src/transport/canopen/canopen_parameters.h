// One inverter's parameters by SDO: takes requests, asks for their objects one at a time, tells the answers as PKW
// would.
//
// SDO knows no order that spares the EEPROM, as AK 11 to 14 do on PKW: whether a write wears it is P560's to say. A RAM
// write is therefore answered "invalid order" (201) without asking, which makes the parameter session set P560 = 0 for
// the write (BU 0280 P560).
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/sdo_request.h"
#include "core/request_queue.h"
#include "nord_driver/profile/parameter_request.h"
#include "transport/canopen/canopen_map.h"

namespace nord_driver {

/// Sans-IO; the SDO client watches the time.
class CanopenParameters {
 public:
  /// The most requests waiting, running, or finished and not fetched.
  static constexpr std::size_t kCapacity = 8;

  /// `tag`: in the upper half of the ids of the SDO requests, so that the answers of several drives are told apart.
  CanopenParameters(const CanopenDrive& drive, std::uint16_t tag) noexcept : drive_(drive), tag_(tag) {}

  /// False: full.
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
  void handleValue(const canopen::SdoAnswer& answer) noexcept;
  void finish(profile::ParameterOutcome outcome, std::int32_t raw = 0) noexcept;
  void refuse(std::uint16_t error_number, std::uint32_t abort_code) noexcept;
  void next() noexcept;

  CanopenDrive drive_;
  std::uint16_t tag_;
  std::uint16_t sequence_ = 0;
  bool under_way_ = false;
  bool plain_ = false;  // the running request is asked for with sub-index 0
  RequestQueue<profile::ParameterRequest, profile::ParameterResult, kCapacity> requests_;
};

}  // namespace nord_driver
