#include "profibus/telegram.h"

#include "profibus/station_address.h"

namespace nord_driver::profibus {

namespace {

constexpr std::uint8_t kStart1 = 0x10;
constexpr std::uint8_t kStart2 = 0x68;
constexpr std::uint8_t kStart3 = 0xA2;
constexpr std::uint8_t kStart4 = 0xDC;
constexpr std::uint8_t kShortAcknowledge = 0xE5;
constexpr std::uint8_t kEnd = 0x16;

constexpr std::uint8_t kExtensionBit = 0x80;
constexpr std::uint8_t kAddressMask = 0x7F;

constexpr std::size_t kAddressesAndFunction = 3;  // DA SA FC
constexpr std::size_t kMinLe = 4;                 // shorter ones are SD1
constexpr std::size_t kMaxLe = 249;
constexpr std::size_t kSd3Octets = 8;

/// FCS: the sum of DA to the end of DU, modulo 256.
std::uint8_t checksum(ByteView bytes) noexcept {
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  return static_cast<std::uint8_t>(sum & 0xFFu);
}

ParseResult malformed(Defect defect) noexcept {
  ParseResult result;
  result.kind = Parse::kMalformed;
  result.defect = defect;
  return result;
}

ParseResult done(const Telegram& telegram, std::size_t eaten) noexcept {
  ParseResult result;
  result.kind = Parse::kOk;
  result.telegram = telegram;
  result.eaten = eaten;
  return result;
}

/// DA SA FC DU.. FCS ED, `body` octets of them before FCS, after `head` octets of start and length.
ParseResult parseBody(ByteView bytes, TelegramKind kind, std::size_t head, std::size_t body) noexcept {
  if (bytes.size() < head + body + 2) return {};
  const ByteView content = bytes.sub(head, body);
  if (checksum(content) != bytes[head + body]) return malformed(Defect::kChecksum);
  if (bytes[head + body + 1] != kEnd) return malformed(Defect::kEndDelimiter);

  Telegram telegram;
  telegram.kind = kind;
  telegram.da = content[0] & kAddressMask;
  telegram.sa = content[1] & kAddressMask;
  telegram.fc = content[2];
  if (telegram.sa == kBroadcastAddress) return malformed(Defect::kAddress);
  std::size_t position = kAddressesAndFunction;
  if ((content[0] & kExtensionBit) != 0) {
    if (position >= body) return malformed(Defect::kAddress);
    telegram.dsap = content[position++];
  }
  if ((content[1] & kExtensionBit) != 0) {
    if (position >= body) return malformed(Defect::kAddress);
    telegram.ssap = content[position++];
  }
  telegram.data = content.sub(position);
  return done(telegram, head + body + 2);
}

ParseResult parseSd2(ByteView bytes) noexcept {
  if (bytes.size() < 2) return {};
  const std::size_t le = bytes[1];
  if (le < kMinLe || le > kMaxLe) return malformed(Defect::kLength);
  if (bytes.size() < 3) return {};
  if (bytes[2] != bytes[1]) return malformed(Defect::kLength);
  if (bytes.size() < 4) return {};
  if (bytes[3] != kStart2) return malformed(Defect::kStartDelimiter);
  return parseBody(bytes, TelegramKind::kSd2, 4, le);
}

ParseResult parseToken(ByteView bytes) noexcept {
  // The token has neither FCS nor end delimiter: the addresses are all there is to check.
  for (std::size_t i = 1; i < 3; ++i) {
    if (bytes.size() <= i) return {};
    if (bytes[i] >= kBroadcastAddress) return malformed(Defect::kAddress);
  }
  Telegram telegram;
  telegram.kind = TelegramKind::kSd4;
  telegram.da = bytes[1];
  telegram.sa = bytes[2];
  return done(telegram, 3);
}

/// DA SA FC DU, FCS and ED behind what `writer` holds already.
void writeBody(const Telegram& telegram, ByteWriter<256>& writer, Frame& frame) noexcept {
  const std::size_t begin = frame.size();
  writer.u8(static_cast<std::uint8_t>(telegram.da | (telegram.dsap ? kExtensionBit : 0u)));
  writer.u8(static_cast<std::uint8_t>(telegram.sa | (telegram.ssap ? kExtensionBit : 0u)));
  writer.u8(telegram.fc);
  if (telegram.dsap) writer.u8(*telegram.dsap);
  if (telegram.ssap) writer.u8(*telegram.ssap);
  writer.append(telegram.data);
  writer.u8(checksum(ByteView{frame}.sub(begin)));
  writer.u8(kEnd);
}

}  // namespace

bool encode(const Telegram& telegram, Frame& frame) noexcept {
  frame.clear();
  const std::size_t octets = (telegram.dsap ? 1u : 0u) + (telegram.ssap ? 1u : 0u) + telegram.data.size();
  if (telegram.da > kBroadcastAddress || telegram.sa >= kBroadcastAddress) return false;
  ByteWriter<256> writer{frame};
  switch (telegram.kind) {
    case TelegramKind::kSd1:
      if (octets != 0) return false;
      writer.u8(kStart1);
      writeBody(telegram, writer, frame);
      return true;
    case TelegramKind::kSd2: {
      if (octets == 0 || octets > kMaxDataUnit) return false;
      const auto le = static_cast<std::uint8_t>(kAddressesAndFunction + octets);
      writer.u8(kStart2);
      writer.u8(le);
      writer.u8(le);
      writer.u8(kStart2);
      writeBody(telegram, writer, frame);
      return true;
    }
    case TelegramKind::kSd3:
      if (octets != kSd3Octets) return false;
      writer.u8(kStart3);
      writeBody(telegram, writer, frame);
      return true;
    case TelegramKind::kSd4:
      if (octets != 0 || telegram.da == kBroadcastAddress) return false;
      writer.u8(kStart4);
      writer.u8(telegram.da);
      writer.u8(telegram.sa);
      return true;
    case TelegramKind::kSc:
      if (octets != 0) return false;
      writer.u8(kShortAcknowledge);
      return true;
  }
  return false;
}

ParseResult parse(ByteView bytes) noexcept {
  if (bytes.empty()) return {};
  switch (bytes[0]) {
    case kShortAcknowledge:
      return done(Telegram{}, 1);
    case kStart1:
      return parseBody(bytes, TelegramKind::kSd1, 1, kAddressesAndFunction);
    case kStart2:
      return parseSd2(bytes);
    case kStart3:
      return parseBody(bytes, TelegramKind::kSd3, 1, kAddressesAndFunction + kSd3Octets);
    case kStart4:
      return parseToken(bytes);
    default:
      return malformed(Defect::kStartDelimiter);
  }
}

}  // namespace nord_driver::profibus
