// One parameter access, the same for every bus and every layer: a user's question goes down to the transport as a
// ParameterRequest and comes back as a ParameterResult.
#pragma once

#include <cstdint>

#include "nord_driver/core/fixed_text.h"

namespace nord_driver::profile {

enum class ParameterAction : std::uint8_t {
  kRead,
  kWriteRam,         ///< lost at power off
  kWritePersistent,  ///< costs one of the EEPROM's 100 000 cycles (BU 0020 7.5 warning, BU 2700 6.5)
};

/// How the index of a parameter is built (BU 0020 7.5.2): from the parameter set, the array element, both or neither.
enum class ParameterShape : std::uint8_t { kPlain, kPerSet, kArray, kArrayPerSet };

struct ParameterRequest {
  std::uint32_t id = 0;      ///< chosen by the asker, comes back in the result
  std::uint16_t number = 0;  ///< the manual's: 102 for P102 (0..999)
  ParameterShape shape = ParameterShape::kPlain;
  /// 1..4, used by kPerSet and kArrayPerSet. Users may give 0, the set in force: no transport is asked with it.
  std::uint8_t parameter_set = 1;
  std::uint8_t index = 1;  ///< the manual's array index, [-01] = 1; used by kArray and kArrayPerSet
  ParameterAction action = ParameterAction::kRead;
  bool double_word = false;  ///< 32 bit value (writes only; an answer tells its own width)
  std::int32_t raw = 0;      ///< value to write
  /// A read of the drive layer itself, or of a guest that commands nothing: by this value it tells shares and speeds from
  /// each other from now on. A transport that carries speeds, not shares, tells them by the same one and by no other.
  bool scales = false;
  /// kWritePersistent, for the drive layer: also when the inverter has the value already. It may have it in its RAM
  /// only, from somebody the driver does not know of. A transport always writes.
  bool even_if_same = false;
};

enum class ParameterOutcome : std::uint8_t {
  kDone,
  kRefused,    ///< see ParameterReason
  kTimeout,    ///< no matching answer in time: whether a write was carried out is not known
  kOffline,    ///< the drive answers nothing at the moment
  kNoChannel,  ///< nothing carries parameters to this drive as it is configured; the text says what is missing
  kBusy,       ///< too many requests wait already
};

/// Why an access was refused, the same for every bus. The driver acts on it; what people read is the transport's text.
enum class ParameterReason : std::uint8_t {
  kNone,             ///< not refused
  kNoSuchParameter,  ///< the inverter has no parameter of this number
  kNoSuchElement,    ///< the parameter has no such array element or parameter set
  kNotIndexed,       ///< it was asked for with a set or an element, and has neither
  kOutOfLimits,      ///< the value
  kWrongType,        ///< the value's width
  kReadOnly,
  kWriteOnly,
  kNotNow,         ///< the present state of the device does not allow it
  kNoRight,        ///< somebody else has control of the device: P509, or its terminals
  kNotSupported,   ///< the device does not know this kind of access: a write that spares the EEPROM
  kUnreadable,     ///< there is an answer, but this way cannot carry it
  kNoInverter,     ///< behind a bus module: the inverter addressed does not exist, or is off
  kDeviceFailure,  ///< memory, hardware or software of the device
  kOther,          ///< only the text tells
  kDriver,         ///< no device was asked: the driver itself refuses, its note says why
};

/// The reason as a clause; empty for kNone and kDriver. For people where a transport has no text of its own.
const char* toString(ParameterReason reason) noexcept;
/// Whether the same access may be granted a moment later: the state of the device, or of what stands before it, is another
/// one then (another participant blocks it, BU 2700 6.5.1.1 error 103; the inverter behind the module is switched on again).
constexpr bool mayPass(ParameterReason reason) noexcept {
  return reason == ParameterReason::kNotNow || reason == ParameterReason::kNoInverter ||
         reason == ParameterReason::kDeviceFailure;
}

struct ParameterResult {
  std::uint32_t id = 0;
  ParameterOutcome outcome = ParameterOutcome::kTimeout;
  ParameterReason reason = ParameterReason::kNone;  ///< with kRefused
  std::int32_t raw = 0;                             ///< with kDone: the value read, or read back
  /// With kRefused, kTimeout and kNoChannel: what the transport has to say of it, a clause that begins with the bus's
  /// own name and code of the error: "SDO abort 0609 0030h, the value is out of range". May be empty.
  Sentence text;

  // What the drive layer adds; a transport leaves it as it is.
  std::uint16_t refused_number = 0;  ///< with kRefused: the parameter this is about, the one asked for or P560
  bool eeprom_written = false;       ///< the access cost EEPROM cycles, or may have
  const char* note = "";             ///< a clause for the user; empty when there is nothing to add
};

/// What the way to the parameters of a drive can do.
struct ParameterCapabilities {
  /// kWriteRam is carried out by an order that spares the EEPROM. An inverter may still refuse it with kNotSupported.
  /// False: the driver writes persistently while P560 = 0, and never asks for kWriteRam.
  bool ram_writes = true;
  /// A write that is refused because the bus has no control (P509, status bit 9 = 0) is refused with kNoRight. False:
  /// any reason may mean that, so people are told of it.
  bool tells_missing_right = false;
};

}  // namespace nord_driver::profile
