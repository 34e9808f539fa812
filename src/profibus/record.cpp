#include "profibus/record.h"

namespace nord_driver::profibus {

namespace {

// Function numbers of the PDU; the negative response has bit 7 set.
constexpr std::uint8_t kRead = 0x5E;
constexpr std::uint8_t kWrite = 0x5F;
constexpr std::uint8_t kNegativeBit = 0x80;
constexpr std::size_t kHeader = 4;
constexpr std::uint8_t kMaxSlot = 254;  // 255 is reserved; index 255 is the call of I&M (see identification.h)

std::uint8_t function(const RecordRequest& request) noexcept {
  return request.write ? kWrite : kRead;
}

bool isOutOfRange(const RecordRequest& request) noexcept {
  if (request.slot > kMaxSlot) return true;
  const std::size_t length = request.write ? request.data.size() : request.length;
  return length == 0 || length > kMaxRecordLength;
}

RecordAnswer positive(ByteView pdu, const RecordRequest& request, RecordResult& result) noexcept {
  if (pdu.size() < kHeader || pdu[1] != request.slot || pdu[2] != request.index) return RecordAnswer::kOther;
  const ByteView data = pdu.sub(kHeader);
  if (request.write) {
    // The length written is repeated, without data.
    return pdu[3] == request.data.size() && data.empty() ? RecordAnswer::kPositive : RecordAnswer::kOther;
  }
  if (pdu[3] != data.size() || data.size() > request.length) return RecordAnswer::kOther;
  result.data.clear();
  for (const std::uint8_t byte : data) result.data.push_back(byte);
  return RecordAnswer::kPositive;
}

}  // namespace

const char* meaningOf(const RecordError& error) noexcept {
  if (!error.isOfDpv1()) return "an error of another protocol than DP-V1";
  switch (error.code1) {
    case 0xA0:
      return "read error";
    case 0xA1:
      return "write error";
    case 0xA2:
      return "module failure";
    case 0xA8:
      return "version conflict";
    case 0xA9:
      return "feature not supported";
    case 0xB0:
      return "invalid index";
    case 0xB1:
      return "wrong length";
    case 0xB2:
      return "invalid slot";
    case 0xB3:
      return "type conflict";
    case 0xB4:
      return "invalid area";
    case 0xB5:
      return "state conflict, or busy";
    case 0xB6:
      return "access denied";
    case 0xB7:
      return "invalid range";
    case 0xB8:
      return "invalid parameter";
    case 0xB9:
      return "invalid type";
    case 0xC0:
      return "read constraint conflict";
    case 0xC1:
      return "write constraint conflict";
    case 0xC2:
      return "resource busy";
    case 0xC3:
      return "resource unavailable";
    default:
      break;
  }
  switch (error.code1 >> 4) {
    case 0xA:
      return "application error";
    case 0xB:
      return "access error";
    case 0xC:
      return "resource error";
    default:
      return "an error of the device";
  }
}

bool encodeRecord(const RecordRequest& request, RecordPdu& pdu) noexcept {
  pdu.clear();
  if (isOutOfRange(request)) return false;
  ByteWriter<RecordPdu::capacity()> writer{pdu};
  writer.u8(function(request));
  writer.u8(request.slot);
  writer.u8(request.index);
  writer.u8(request.write ? static_cast<std::uint8_t>(request.data.size()) : request.length);
  if (request.write) writer.append(request.data);
  return writer.ok();
}

RecordAnswer parseRecordAnswer(ByteView pdu, const RecordRequest& request, RecordResult& result) noexcept {
  if (pdu.empty()) return RecordAnswer::kOther;
  if (pdu[0] == function(request)) return positive(pdu, request, result);
  if (pdu[0] != (function(request) | kNegativeBit) || pdu.size() != kHeader) return RecordAnswer::kOther;
  result.error = {pdu[1], pdu[2], pdu[3]};
  return RecordAnswer::kNegative;
}

}  // namespace nord_driver::profibus
