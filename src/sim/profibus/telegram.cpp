#include "sim/profibus/telegram.h"

namespace nord_driver::sim {

namespace {

constexpr std::uint8_t kSd1 = 0x10;
constexpr std::uint8_t kSd2 = 0x68;
constexpr std::uint8_t kSd3 = 0xA2;
constexpr std::uint8_t kSd4 = 0xDC;
constexpr std::uint8_t kSc = 0xE5;
constexpr std::uint8_t kEnd = 0x16;
constexpr std::uint8_t kExtension = 0x80;  // address byte: a SAP follows

constexpr std::size_t kFixedUnit = 8;
constexpr std::size_t kMinimumLength = 4;
constexpr std::size_t kMaximumLength = 249;

std::uint8_t checksum(ByteView bytes) noexcept {
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  return static_cast<std::uint8_t>(sum & 0xFFu);
}

/// DA, SA, FC and the data unit, checked and split.
bool readBody(ByteView body, TelegramKind kind, Telegram& telegram) noexcept {
  telegram.kind = kind;
  telegram.destination_sap.reset();
  telegram.source_sap.reset();
  telegram.data.clear();
  telegram.destination = body[0] & 0x7Fu;
  telegram.source = body[1] & 0x7Fu;
  telegram.function = body[2];
  if ((telegram.function & 0x80u) != 0) return false;  // bit 7 is always 0
  ByteView unit = body.sub(3);
  if ((body[0] & kExtension) != 0) {
    if (unit.empty()) return false;
    telegram.destination_sap = unit[0];
    unit = unit.sub(1);
  }
  if ((body[1] & kExtension) != 0) {
    if (unit.empty()) return false;
    telegram.source_sap = unit[0];
    unit = unit.sub(1);
  }
  for (const std::uint8_t byte : unit) telegram.data.push_back(byte);
  return true;
}

/// `body` is followed by FCS and 16.
ParseResult finish(ByteView bytes, std::size_t header, std::size_t body_length, TelegramKind kind,
                   Telegram& telegram) noexcept {
  const std::size_t total = header + body_length + 2;
  if (bytes.size() < total) return {ParseKind::kNeedMore, 0};
  const ByteView body = bytes.sub(header, body_length);
  if (bytes[total - 2] != checksum(body) || bytes[total - 1] != kEnd) return {ParseKind::kMalformed, 0};
  if (!readBody(body, kind, telegram)) return {ParseKind::kMalformed, 0};
  return {ParseKind::kTelegram, total};
}

}  // namespace

ParseResult parseTelegram(ByteView bytes, Telegram& telegram) noexcept {
  if (bytes.empty()) return {ParseKind::kNeedMore, 0};
  switch (bytes[0]) {
    case kSd1:
      return finish(bytes, 1, 3, TelegramKind::kWithoutData, telegram);
    case kSd3:
      return finish(bytes, 1, 3 + kFixedUnit, TelegramKind::kFixed, telegram);
    case kSd2: {
      if (bytes.size() >= 2 && (bytes[1] < kMinimumLength || bytes[1] > kMaximumLength)) {
        return {ParseKind::kMalformed, 0};
      }
      if (bytes.size() >= 3 && bytes[2] != bytes[1]) return {ParseKind::kMalformed, 0};
      if (bytes.size() >= 4 && bytes[3] != kSd2) return {ParseKind::kMalformed, 0};
      if (bytes.size() < 4) return {ParseKind::kNeedMore, 0};
      return finish(bytes, 4, bytes[1], TelegramKind::kVariable, telegram);
    }
    case kSd4:
      if (bytes.size() < 3) return {ParseKind::kNeedMore, 0};
      if ((bytes[1] & kExtension) != 0 || (bytes[2] & kExtension) != 0) return {ParseKind::kMalformed, 0};
      telegram.kind = TelegramKind::kToken;
      telegram.destination = bytes[1];
      telegram.source = bytes[2];
      telegram.function = 0;
      telegram.destination_sap.reset();
      telegram.source_sap.reset();
      telegram.data.clear();
      return {ParseKind::kTelegram, 3};
    case kSc:
      telegram.kind = TelegramKind::kShortAcknowledge;
      telegram.function = 0;
      telegram.destination_sap.reset();
      telegram.source_sap.reset();
      telegram.data.clear();
      return {ParseKind::kTelegram, 1};
    default:
      return {ParseKind::kMalformed, 0};
  }
}

WireBytes encodeTelegram(const Telegram& telegram) noexcept {
  FixedBytes<249> body;
  const auto address = [](std::uint8_t station, bool extended) {
    return static_cast<std::uint8_t>(extended ? station | kExtension : station);
  };
  body.push_back(address(telegram.destination, telegram.destination_sap.has_value()));
  body.push_back(address(telegram.source, telegram.source_sap.has_value()));
  body.push_back(telegram.function);
  if (telegram.destination_sap) body.push_back(*telegram.destination_sap);
  if (telegram.source_sap) body.push_back(*telegram.source_sap);
  for (const std::uint8_t byte : telegram.data) body.push_back(byte);

  WireBytes bytes;
  ByteWriter<255> writer{bytes};
  if (body.size() == 3) {
    writer.u8(kSd1);
  } else {
    const auto length = static_cast<std::uint8_t>(body.size());
    writer.u8(kSd2);
    writer.u8(length);
    writer.u8(length);
    writer.u8(kSd2);
  }
  writer.append(body);
  writer.u8(checksum(body));
  writer.u8(kEnd);
  return bytes;
}

WireBytes shortAcknowledge() noexcept {
  return WireBytes{kSc};
}

}  // namespace nord_driver::sim
