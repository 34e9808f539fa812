// The five kinds of PROFIBUS telegrams: bytes to telegram and back. Deterministic: no clock, no line, no memory of
// before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"

namespace nord_driver::profibus {

enum class TelegramKind : std::uint8_t {
  kSd1,  ///< 10 DA SA FC FCS 16: no data
  kSd2,  ///< 68 LE LEr 68 DA SA FC DU.. FCS 16: data of any length
  kSd3,  ///< A2 DA SA FC DU*8 FCS 16: exactly eight octets
  kSd4,  ///< DC DA SA: the token
  kSc    ///< E5: short acknowledge, no addresses
};

/// The longest telegram: SD2 with LE = 249.
constexpr std::size_t kMaxTelegramLength = 255;
/// DU of the longest telegram, service access points included.
constexpr std::size_t kMaxDataUnit = 246;
using Frame = FixedBytes<256>;

struct Telegram {
  TelegramKind kind = TelegramKind::kSc;
  std::uint8_t da = 0;  ///< destination, 0..127, without the extension bit
  std::uint8_t sa = 0;  ///< source, 0..126, without the extension bit
  std::uint8_t fc = 0;  ///< function code; 0 in SD4 and SC
  /// Service access points as sent (bit 7 would announce a further extension, bit 6 a segment; DP uses neither).
  std::optional<std::uint8_t> dsap;
  std::optional<std::uint8_t> ssap;
  ByteView data;  ///< DU behind the service access points; a parsed telegram looks into the bytes it was parsed from
};

/// Writes the telegram in its own kind. False (and `frame` is empty) when the kind cannot carry it: data or service
/// access points in SD1, SD4 or SC; other than eight octets in SD3; none or more than 246 in SD2; an address out of
/// range.
bool encode(const Telegram& telegram, Frame& frame) noexcept;

enum class Parse : std::uint8_t { kNeedMore, kMalformed, kOk };

/// What is wrong with malformed bytes.
enum class Defect : std::uint8_t { kNone, kStartDelimiter, kLength, kAddress, kChecksum, kEndDelimiter };

struct ParseResult {
  Parse kind = Parse::kNeedMore;
  Telegram telegram;      ///< only with Ok
  std::size_t eaten = 0;  ///< only with Ok: bytes of the telegram, from the front
  Defect defect = Defect::kNone;
};

/// Reads one telegram from the front. Stricter than most slaves: both 68, LE = LEr, 4 <= LE <= 249, FCS, ED, no source
/// 127, and a service access point byte present wherever bit 7 of an address announces one. Malformed as soon as it is
/// certain.
ParseResult parse(ByteView bytes) noexcept;

}  // namespace nord_driver::profibus
