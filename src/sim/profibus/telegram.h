// PROFIBUS telegrams as the simulated bus reads and writes them: strict, and shared with no master.
//
// EN 50170 frames: SD1 without data, SD2 with LE, SD3 with eight bytes, SD4 the token, SC the short acknowledgement.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"

namespace nord_driver::sim {

/// The longest telegram: 68 LE LEr 68, 249 bytes, FCS, 16.
using WireBytes = FixedBytes<255>;

enum class TelegramKind : std::uint8_t { kWithoutData, kVariable, kFixed, kToken, kShortAcknowledge };

struct Telegram {
  TelegramKind kind = TelegramKind::kWithoutData;
  std::uint8_t destination = 0;  ///< DA without its extension bit
  std::uint8_t source = 0;       ///< SA without its extension bit
  std::uint8_t function = 0;     ///< FC
  std::optional<std::uint8_t> destination_sap;
  std::optional<std::uint8_t> source_sap;
  FixedBytes<246> data;  ///< without the SAP bytes

  bool isRequest() const noexcept { return (function & 0x40u) != 0; }
  bool fcb() const noexcept { return (function & 0x20u) != 0; }
  bool fcv() const noexcept { return (function & 0x10u) != 0; }
  unsigned code() const noexcept { return function & 0x0Fu; }
};

enum class ParseKind : std::uint8_t { kNeedMore, kMalformed, kTelegram };

struct ParseResult {
  ParseKind kind = ParseKind::kNeedMore;
  std::size_t length = 0;  ///< bytes of the telegram, when it is one
};

/// Reads one telegram from the front of `bytes`.
ParseResult parseTelegram(ByteView bytes, Telegram& telegram) noexcept;

/// SD1 when there are neither data nor SAPs, else SD2 (as every captured slave answers, eight bytes included).
WireBytes encodeTelegram(const Telegram& telegram) noexcept;

/// E5.
WireBytes shortAcknowledge() noexcept;

}  // namespace nord_driver::sim
