// What is said on a connection of DP-V1 class 2 (MS2) besides reading and writing records: initiate, idle, abort.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"
#include "profibus/record.h"

namespace nord_driver::profibus {

// Service access points (felser.ch, "Liste der SAP"): the resource manager of the slave hands out one of 0 to 48.
constexpr std::uint8_t kResourceManagerSap = 49;
constexpr std::uint8_t kClass2MasterSap = 50;
constexpr std::uint8_t kLastClass2Sap = 48;

/// The longest Send_Timeout a PDU can carry: two bytes in units of 10 ms.
constexpr Duration kMaxSendTimeout = std::chrono::milliseconds{655'350};

/// Why a connection ends, when the instance is MSAC_C2: the low four bits of the reason byte (ProSoft MVI69-PDPMV1 user
/// manual p. 123).
enum class Class2Reason : std::uint8_t {
  kSequence = 1,           ///< ABT_SE
  kInvalidRequest = 2,     ///< ABT_FE
  kTimeOut = 3,            ///< ABT_TO
  kInvalidResponse = 4,    ///< ABT_RE
  kInvalidService = 5,     ///< ABT_IV
  kSendTimeout = 6,        ///< ABT_STO
  kAdditionalAddress = 7,  ///< ABT_IA
  kWaiting = 8,            ///< ABT_OC
  kResource = 15           ///< ABT_RES
};

/// Abort.req: where it comes from, and RRIICCCC: instance (0 FDL, 1 MSAC_C2, 2 user) and reason.
struct Class2Abort {
  std::uint8_t subnet = 0;  ///< 0 not told, 1 local, 2 remote
  std::uint8_t reason = 0;
};
/// As a clause: "abort 13h, ABT_TO: time-out of the connection".
Sentence describe(const Class2Abort& abort) noexcept;

/// What the resource manager answers: where the connection is served.
struct Class2Grant {
  std::uint8_t server_sap = 0;  ///< 0..48
  Duration min_send_timeout{};  ///< the slave refuses a shorter one
};

/// What the slave tells of itself when the connection is there.
struct Class2Peer {
  std::uint8_t max_length = 0;  ///< of a PDU
  std::uint16_t features = 0;
  std::uint16_t profile_features = 0;
  std::uint16_t profile_ident = 0;
};

/// Initiate.req without addresses behind the slave (API 0, SCL 0 on both sides): read and write of records.
/// `send_timeout` is rounded up to 10 ms, 10 ms..kMaxSendTimeout.
RecordPdu initiatePdu(Duration send_timeout) noexcept;
RecordPdu idlePdu() noexcept;
/// From here, on the same subnet, by the protocol.
RecordPdu abortPdu(Class2Reason reason) noexcept;
/// Likewise, by the program that used the connection and needs it no more.
RecordPdu userAbortPdu() noexcept;

bool isIdle(ByteView pdu) noexcept;
std::optional<Class2Abort> parseAbort(ByteView pdu) noexcept;
std::optional<Class2Grant> parseGrant(ByteView pdu) noexcept;

enum class InitiateAnswer : std::uint8_t {
  kAccepted,  ///< `peer` is set
  kRefused,   ///< `error` is set
  kOther
};
/// Initiate.res; the additional addresses are not looked at: some slaves print a shorter form of them (Balluff
/// BTL7-T500 p. 68).
InitiateAnswer parseInitiateAnswer(ByteView pdu, Class2Peer& peer, RecordError& error) noexcept;

}  // namespace nord_driver::profibus
