// The explicit requests by which a device is allocated, checked and connected.
#pragma once

#include <cstdint>
#include <optional>

#include "devicenet/explicit_client.h"
#include "devicenet/explicit_message.h"

namespace nord_driver::devicenet {

struct ConnectRequest {
  ExplicitRequest request;
  ExplicitPort port = ExplicitPort::kConnected;
};

namespace identity_attribute {
constexpr std::uint8_t kVendorId = 1;
constexpr std::uint8_t kDeviceType = 2;
constexpr std::uint8_t kProductCode = 3;
constexpr std::uint8_t kRevision = 4;
}  // namespace identity_attribute

/// Of a connection object (class 5); BU 0280 4.3.4.
namespace connection_attribute {
constexpr std::uint8_t kState = 1;
constexpr std::uint8_t kProducedSize = 7;
constexpr std::uint8_t kConsumedSize = 8;
constexpr std::uint8_t kExpectedPacketRate = 9;
}  // namespace connection_attribute

constexpr std::uint8_t kExplicitInstance = 1;
constexpr std::uint8_t kFirstIoInstance = 2, kLastIoInstance = 4;
/// ms: the expected packet rate that process data of before are left to run on with.
constexpr std::uint16_t kShortRateOfBefore = 100;
// Of connection_attribute::kState.
constexpr std::uint8_t kNonexistent = 0;
constexpr std::uint8_t kEstablished = 3;
constexpr std::uint8_t kConnectionStates = 6;

/// Services 4Bh and 4Ch of the DeviceNet object, on the unconnected port.
ConnectRequest allocateRequest(std::uint8_t choice, std::uint8_t own_mac) noexcept;
ConnectRequest releaseRequest(std::uint8_t choice) noexcept;
/// Class 3 attribute 5: allocation choice and the master's MAC id.
ConnectRequest ownerRequest(ExplicitPort port) noexcept;
ConnectRequest identityRequest(std::uint8_t attribute) noexcept;
ConnectRequest connectionRequest(std::uint8_t instance, std::uint8_t attribute) noexcept;
/// The state of a control supervisor (class 41, attribute 6; BU 0280 4.3.6).
ConnectRequest supervisorRequest(std::uint8_t instance) noexcept;
/// `milliseconds`: the expected packet rate of the connection.
ConnectRequest rateRequest(std::uint8_t instance, std::uint16_t milliseconds) noexcept;

/// Whether a refused allocation says that the connections are allocated already, to whomever.
bool saysAllocated(const ExplicitAnswer& answer) noexcept;
/// What an answer to the question for the state of a connection says of it, where that is not "established": "timed out",
/// "gone", ... nullptr where it is, and of what is no state.
const char* lostStateText(const ExplicitAnswer& answer) noexcept;
/// "configuring", "timed out", ...
const char* connectionStateText(std::uint8_t state) noexcept;

}  // namespace nord_driver::devicenet
