// One inverter's parameters by explicit messages: takes requests, asks for their objects one at a time.
//
//   numbered objects (BU 0280 4.3.9): class 100 + number / 100 + 10 * (inverter - 1), attribute number mod 100,
//     instance sub-index + 1;
//   index object (BU 0280 4.3.10): class 199, instance the inverter's number: attributes 1 (number) and 2 (index), then 3
//     (16 bit) or 4 (32 bit) the value.
// The fault number (P700) that cannot be read so is asked of the control supervisor, class 41, attribute 13 (BU 0280 4.3.6).
// P150 to P199 are the module's, in class 181 either way. DeviceNet has no access that spares the EEPROM: whether a write
// wears it is P560's to say. So a write to the RAM only is none of its capabilities, and is refused without asking.
#pragma once

#include <cstdint>
#include <optional>

#include "devicenet/explicit_message.h"
#include "nord_driver/profile/parameter_request.h"
#include "profile/parameter_queue.h"
#include "transport/devicenet/devicenet_config.h"

namespace nord_driver {

struct ParameterObject {
  std::uint8_t class_id = 0;
  std::uint8_t instance = 0;
  std::uint8_t attribute = 0;
};

/// Of the module itself, and not of an inverter.
bool isOfModule(std::uint16_t number) noexcept;
/// The object of a parameter; none when it needs an instance beyond 255.
std::optional<ParameterObject> parameterObject(const DevicenetDrive& drive,
                                               const profile::ParameterRequest& request) noexcept;

/// Sans-IO; the explicit client watches the time.
class DevicenetParameters {
 public:
  /// The most requests waiting, running, or finished and not fetched.
  static constexpr std::size_t kCapacity = profile::ParameterQueue::kCapacity;

  /// `tag`: in the upper half of the ids of the explicit requests, so that the answers of several drives are told apart.
  DevicenetParameters(const DevicenetDrive& drive, std::uint16_t tag) noexcept : drive_(drive), tag_(tag) {}

  /// No manual says by which code a write without control of the device is refused.
  static constexpr profile::ParameterCapabilities capabilities() noexcept { return {false, false}; }

  /// As ParameterQueue::submit().
  bool submit(const profile::ParameterRequest& request) noexcept;
  /// The access to start next, when none is under way; `handleStarted()` when the scanner has taken it.
  std::optional<devicenet::ExplicitRequest> pendingAccess() const noexcept;
  void handleStarted() noexcept { under_way_ = true; }
  /// Answers to accesses given up before are left out. True: the inverter was said not to be there.
  bool handleAnswer(const devicenet::ExplicitAnswer& answer) noexcept;
  /// Ends all pending requests as offline.
  void handleOffline() noexcept;
  std::optional<profile::ParameterResult> pollResult() noexcept { return requests_.pollResult(); }

  /// Of the tag given to the constructor.
  static std::uint16_t tagOf(std::uint32_t id) noexcept { return static_cast<std::uint16_t>(id >> 16); }

 private:
  /// kNumber, kIndex and kDoubleValue are of the index object.
  enum class Step : std::uint8_t { kNumber, kIndex, kValue, kDoubleValue, kSupervisor };

  struct Refusal {
    std::uint8_t general = 0, additional = 0;
  };

  std::uint32_t accessId() const noexcept { return std::uint32_t{tag_} << 16 | sequence_; }
  bool byIndexObject() const noexcept;
  devicenet::ExplicitRequest indexAccess() const noexcept;
  devicenet::ExplicitRequest valueAccess(const ParameterObject& object) const noexcept;
  bool tryOtherWidth(std::uint8_t general) noexcept;
  bool fallBack(std::uint8_t general) noexcept;
  bool askSupervisor(const devicenet::ExplicitAnswer& answer) noexcept;
  void refuse(const Refusal& refusal) noexcept;
  void takeValue(const devicenet::ExplicitAnswer& answer) noexcept;
  void again(Step step) noexcept;
  void next() noexcept;

  DevicenetDrive drive_;
  std::uint16_t tag_;
  std::uint16_t sequence_ = 0;
  bool under_way_ = false;
  bool other_width_ = false;  // of a write
  bool plain_ = false;        // the running request is asked for with instance 1
  Step step_ = Step::kValue;
  Refusal refusal_;  // of the parameter itself, while the supervisor is asked
  profile::ParameterQueue requests_;
};

}  // namespace nord_driver
