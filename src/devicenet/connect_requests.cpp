#include "devicenet/connect_requests.h"

#include <array>

#include "devicenet/error_codes.h"

namespace nord_driver::devicenet {
namespace {

constexpr std::uint16_t kOneInstance = 1;
constexpr std::uint8_t kAllocationInformation = 5;

ConnectRequest deviceNetService(std::uint8_t code) noexcept {
  ConnectRequest made;
  made.port = ExplicitPort::kUnconnected;
  made.request.service = code;
  made.request.class_id = object_class::kDeviceNet;
  made.request.instance = kOneInstance;
  return made;
}

}  // namespace

ConnectRequest allocateRequest(std::uint8_t allocation, std::uint8_t own_mac) noexcept {
  ConnectRequest made = deviceNetService(service::kAllocate);
  made.request.data.push_back(allocation);
  made.request.data.push_back(own_mac);
  return made;
}

ConnectRequest releaseRequest(std::uint8_t allocation) noexcept {
  ConnectRequest made = deviceNetService(service::kRelease);
  made.request.data.push_back(allocation);
  return made;
}

ConnectRequest ownerRequest(ExplicitPort port) noexcept {
  return {getAttribute(0, object_class::kDeviceNet, kOneInstance, kAllocationInformation), port};
}

ConnectRequest identityRequest(std::uint8_t attribute) noexcept {
  return {getAttribute(0, object_class::kIdentity, kOneInstance, attribute), ExplicitPort::kConnected};
}

ConnectRequest connectionRequest(std::uint8_t instance, std::uint8_t attribute) noexcept {
  return {getAttribute(0, object_class::kConnection, instance, attribute), ExplicitPort::kConnected};
}

ConnectRequest supervisorRequest(std::uint8_t instance) noexcept {
  return {getAttribute(0, object_class::kControlSupervisor, instance, supervisor_attribute::kState),
          ExplicitPort::kConnected};
}

ConnectRequest rateRequest(std::uint8_t instance, std::uint16_t milliseconds) noexcept {
  const std::array<std::uint8_t, 2> data{static_cast<std::uint8_t>(milliseconds & 0xFFu),
                                         static_cast<std::uint8_t>(milliseconds >> 8u)};
  return {setAttribute(0, object_class::kConnection, instance, connection_attribute::kExpectedPacketRate, data),
          ExplicitPort::kConnected};
}

bool saysAllocated(const ExplicitAnswer& answer) noexcept {
  if (answer.end != ExplicitEnd::kRefused) return false;
  return answer.additional == allocate_error::kConflict || answer.general == general_error::kAlreadyInState ||
         answer.general == general_error::kStateConflict;
}

const char* lostStateText(const ExplicitAnswer& answer) noexcept {
  if (answer.end == ExplicitEnd::kRefused && answer.general == general_error::kNoObject) return "gone";
  const bool tells = answer.ok() && answer.data.size() == 1 && answer.data[0] < kConnectionStates;
  return tells && answer.data[0] != kEstablished ? connectionStateText(answer.data[0]) : nullptr;
}

const char* connectionStateText(std::uint8_t state) noexcept {
  constexpr std::array<const char*, kConnectionStates> kTexts{
      "nonexistent", "configuring", "waiting for its identifier", "established", "timed out", "deferred for deletion"};
  return state < kTexts.size() ? kTexts[state] : "unknown";
}

}  // namespace nord_driver::devicenet
