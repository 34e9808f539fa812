// What is asked of a device by an explicit message, and what came of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/fixed_vector.h"

namespace nord_driver::devicenet {

/// Services this engine or a parameter access uses; any other number may be asked for too.
namespace service {
constexpr std::uint8_t kReset = 0x05;
constexpr std::uint8_t kGetAttributeSingle = 0x0E;
constexpr std::uint8_t kSetAttributeSingle = 0x10;
constexpr std::uint8_t kError = 0x14;
constexpr std::uint8_t kAllocate = 0x4B;
constexpr std::uint8_t kRelease = 0x4C;
constexpr std::uint8_t kHeartbeat = 0x4D;
constexpr std::uint8_t kShutdown = 0x4E;
constexpr std::uint8_t kResponse = 0x80;  ///< bit of a response
}  // namespace service

/// Bits of the first byte of an explicit message.
namespace explicit_header {
constexpr std::uint8_t kFragmented = 0x80;
constexpr std::uint8_t kTransaction = 0x40;  ///< XID: toggles with each request
constexpr std::uint8_t kMac = 0x3F;          ///< whose message it is: of the master, from it and to it
}  // namespace explicit_header

namespace object_class {
constexpr std::uint16_t kIdentity = 1;
constexpr std::uint16_t kDeviceNet = 3;
constexpr std::uint16_t kAssembly = 4;
constexpr std::uint16_t kConnection = 5;
constexpr std::uint16_t kControlSupervisor = 41;
}  // namespace object_class

/// Of a control supervisor (BU 0280 4.3.6).
namespace supervisor_attribute {
constexpr std::uint8_t kState = 6;
constexpr std::uint8_t kFaultCode = 13;
}  // namespace supervisor_attribute

/// Most bytes of data behind the service code, class and instance, each way.
constexpr std::size_t kExplicitData = 128;
using ExplicitData = FixedBytes<kExplicitData>;
/// A whole message from the service code on: code, class, instance, attribute and data.
using ExplicitBody = FixedBytes<kExplicitData + 6>;

struct ExplicitRequest {
  std::uint32_t id = 0;  ///< the asker's own; comes back in the answer
  std::uint8_t service = service::kGetAttributeSingle;
  std::uint16_t class_id = 0;
  std::uint16_t instance = 0;
  std::optional<std::uint8_t> attribute;
  ExplicitData data;  ///< least significant byte first
};

ExplicitRequest getAttribute(std::uint32_t id, std::uint16_t class_id, std::uint16_t instance,
                             std::uint8_t attribute) noexcept;
/// At most kExplicitData bytes; the rest is cut off.
ExplicitRequest setAttribute(std::uint32_t id, std::uint16_t class_id, std::uint16_t instance, std::uint8_t attribute,
                             ByteView data) noexcept;

/// Widths of class and instance on an explicit connection, as the device chose when it was allocated.
enum class BodyFormat : std::uint8_t { k8Over8 = 0, k8Over16 = 1, k16Over16 = 2, k16Over8 = 3 };
constexpr std::uint8_t kKnownBodyFormats = 4;  ///< 4 is a CIP path, which is not spoken here

/// False when class or instance do not fit the format.
bool encode(const ExplicitRequest& request, BodyFormat format, ExplicitBody& body) noexcept;

enum class ExplicitEnd : std::uint8_t {
  kDone,
  kRefused,      ///< the device answered with an error: `general`, `additional`
  kTimedOut,     ///< no answer, asked twice
  kTooLong,      ///< the message is longer than the device or this client takes
  kNotConnected  ///< the device has no explicit connection with us, or lost it
};

constexpr std::uint8_t kNoAdditionalCode = 0xFF;

struct ExplicitAnswer {
  std::uint32_t id = 0;
  ExplicitEnd end = ExplicitEnd::kDone;
  std::uint8_t general = 0;
  std::uint8_t additional = kNoAdditionalCode;
  bool may_be_late = false;  ///< it may be the answer to an earlier request, of the same transaction id
  ExplicitData data;         ///< of kDone: behind the service code

  bool ok() const noexcept { return end == ExplicitEnd::kDone; }
  /// The number in 1 to 4 bytes, least significant first, without sign. Nothing for other sizes or when not `ok()`.
  std::optional<std::uint32_t> number() const noexcept;
};

/// Why an access came to nothing, without a full stop: "refuses: the attribute is not supported (14h)". Of allocate and
/// release (`service`) the additional codes have meanings of their own.
Sentence explicitText(const ExplicitAnswer& answer, std::uint8_t asked_service) noexcept;

}  // namespace nord_driver::devicenet
