#include "profibus/class2_pdu.h"

#include <algorithm>

namespace nord_driver::profibus {

namespace {

// Function numbers (ABB FPBA-01 p. 154).
constexpr std::uint8_t kIdle = 0x48;
constexpr std::uint8_t kResourceManager = 0x56;
constexpr std::uint8_t kInitiate = 0x57;
constexpr std::uint8_t kAbort = 0x58;
constexpr std::uint8_t kNegativeBit = 0x80;

constexpr Duration kTimeUnit = std::chrono::milliseconds{10};
constexpr std::uint16_t kReadAndWrite = 0x0100;  // Features_Supported
constexpr std::uint8_t kNoAddressType = 0;       // behind it API and SCL, two bytes
constexpr std::uint8_t kAddressLength = 2;

constexpr std::uint8_t kSubnetLocal = 1;
constexpr unsigned kInstanceFdl = 0x00, kInstanceClass2 = 0x10, kInstanceUser = 0x20, kInstanceMask = 0x30;

std::uint16_t inUnits(Duration time) noexcept {
  const auto units = (std::clamp(time, kTimeUnit, kMaxSendTimeout) + kTimeUnit - Duration{1}) / kTimeUnit;
  return static_cast<std::uint16_t>(units);
}

// ProSoft MVI69-PDPMV1 p. 123.
const char* reasonText(unsigned reason) noexcept {
  switch (static_cast<Class2Reason>(reason)) {
    case Class2Reason::kSequence:
      return "ABT_SE: sequence error, the service is not allowed in this state";
    case Class2Reason::kInvalidRequest:
      return "ABT_FE: it received an invalid request";
    case Class2Reason::kTimeOut:
      return "ABT_TO: time-out of the connection";
    case Class2Reason::kInvalidResponse:
      return "ABT_RE: it received an invalid response";
    case Class2Reason::kInvalidService:
      return "ABT_IV: invalid service from its user";
    case Class2Reason::kSendTimeout:
      return "ABT_STO: the Send_Timeout asked for is too short";
    case Class2Reason::kAdditionalAddress:
      return "ABT_IA: invalid additional address";
    case Class2Reason::kWaiting:
      return "ABT_OC: it waits for its data link layer (FDL_DATA_REPLY.con)";
    case Class2Reason::kResource:
      return "ABT_RES: resource error";
  }
  return "of no known reason";
}

const char* fdlText(unsigned reason) noexcept {
  switch (reason) {
    case 0x1:
      return "UE, user error";
    case 0x2:
      return "RR, no resource";
    case 0x3:
      return "RS, access point not active";
    case 0x9:
      return "NR, no response data";
    case 0xE:
      return "DS, the master is not in the ring";
    case 0xF:
      return "NA, no response";
    default:
      return "of its data link layer";
  }
}

}  // namespace

Sentence describe(const Class2Abort& abort) noexcept {
  Sentence text;
  const unsigned reason = abort.reason & 0x0Fu;
  switch (abort.reason & kInstanceMask) {
    case kInstanceFdl:
      text.format("abort %02Xh, data link layer: %s", unsigned{abort.reason}, fdlText(reason));
      break;
    case kInstanceClass2:
      text.format("abort %02Xh, %s", unsigned{abort.reason}, reasonText(reason));
      break;
    case kInstanceUser:
      text.format("abort %02Xh, by the device itself, reason %u", unsigned{abort.reason}, reason);
      break;
    default:
      text.format("abort %02Xh, of a reserved instance", unsigned{abort.reason});
      break;
  }
  return text;
}

RecordPdu initiatePdu(Duration send_timeout) noexcept {
  RecordPdu pdu;
  ByteWriter<RecordPdu::capacity()> writer{pdu};
  writer.u8(kInitiate);
  for (int i = 0; i < 3; ++i) writer.u8(0);  // reserved
  writer.u16be(inUnits(send_timeout));
  writer.u16be(kReadAndWrite);
  writer.u16be(0);  // Profile_Features_Supported
  writer.u16be(0);  // Profile_Ident_Number
  for (int end = 0; end < 2; ++end) {
    writer.u8(kNoAddressType);
    writer.u8(kAddressLength);
  }
  for (int end = 0; end < 2; ++end) writer.u16be(0);  // API and SCL
  return pdu;
}

RecordPdu idlePdu() noexcept {
  return {kIdle};
}

RecordPdu abortPdu(Class2Reason reason) noexcept {
  return {kAbort, kSubnetLocal, static_cast<std::uint8_t>(kInstanceClass2 | static_cast<unsigned>(reason))};
}

RecordPdu userAbortPdu() noexcept {
  return {kAbort, kSubnetLocal, static_cast<std::uint8_t>(kInstanceUser)};
}

bool isIdle(ByteView pdu) noexcept {
  return pdu.size() == 1 && pdu[0] == kIdle;
}

std::optional<Class2Abort> parseAbort(ByteView pdu) noexcept {
  if (pdu.size() < 3 || pdu[0] != kAbort) return std::nullopt;
  return Class2Abort{pdu[1], pdu[2]};
}

std::optional<Class2Grant> parseGrant(ByteView pdu) noexcept {
  ByteReader reader{pdu};
  if (reader.u8() != kResourceManager) return std::nullopt;
  Class2Grant grant;
  grant.server_sap = reader.u8();
  grant.min_send_timeout = reader.u16be() * kTimeUnit;
  if (!reader.ok() || grant.server_sap > kLastClass2Sap) return std::nullopt;
  return grant;
}

InitiateAnswer parseInitiateAnswer(ByteView pdu, Class2Peer& peer, RecordError& error) noexcept {
  ByteReader reader{pdu};
  const std::uint8_t function = reader.u8();
  if (function == (kInitiate | kNegativeBit)) {
    const RecordError read{reader.u8(), reader.u8(), reader.u8()};
    if (!reader.ok()) return InitiateAnswer::kOther;
    error = read;
    return InitiateAnswer::kRefused;
  }
  if (function != kInitiate) return InitiateAnswer::kOther;
  Class2Peer read;
  read.max_length = reader.u8();
  read.features = reader.u16be();
  read.profile_features = reader.u16be();
  read.profile_ident = reader.u16be();
  if (!reader.ok()) return InitiateAnswer::kOther;
  peer = read;
  return InitiateAnswer::kAccepted;
}

}  // namespace nord_driver::profibus
