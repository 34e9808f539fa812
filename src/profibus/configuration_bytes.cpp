#include "profibus/configuration_bytes.h"

namespace nord_driver::profibus {

namespace {

// Compact identifier: bits 0-3 length - 1, bits 4-5 direction, bit 6 words instead of bytes, bit 7 consistency over
// all. Direction 00 announces the special format: bits 6-7 say which length bytes follow, bits 0-3 how many bytes of
// the maker.
constexpr unsigned kInputBit = 0x10;
constexpr unsigned kOutputBit = 0x20;
constexpr unsigned kWordsBit = 0x40;
constexpr unsigned kSpecialInputBit = 0x40;
constexpr unsigned kSpecialOutputBit = 0x80;
constexpr unsigned kNoMakerBytes = 0x0F;  // "not verified": none follow

std::size_t inBytes(unsigned format, unsigned length_mask) noexcept {
  const std::size_t units = (format & length_mask) + 1;
  return (format & kWordsBit) != 0 ? 2 * units : units;
}

std::size_t specialLength(ByteReader& reader) noexcept {
  return inBytes(reader.u8(), 0x3F);
}

/// "F3 F1 (12 bytes out, 12 in)", at most 16 of the bytes.
FixedText<110> inWords(ByteView configuration) noexcept {
  constexpr std::size_t kShown = 16;
  char hex[3 * kShown + 1] = {};
  std::size_t end = 0;
  for (std::size_t i = 0; i < configuration.size() && i < kShown; ++i) {
    end += static_cast<std::size_t>(
        std::snprintf(hex + end, sizeof hex - end, i == 0 ? "%02X" : " %02X", configuration[i]));
  }
  const auto lengths = ioLengths(configuration);
  FixedText<110> text;
  const char* const more = configuration.size() > kShown ? " .." : "";
  if (lengths) {
    text.format("%s%s (%zu bytes out, %zu in)", hex, more, lengths->outputs, lengths->inputs);
  } else {
    text.format("%s%s (which end in the middle of an identifier)", hex, more);
  }
  return text;
}

}  // namespace

Sentence compareConfigurations(ByteView configured, ByteView reported) noexcept {
  Sentence text;
  const char* const verdict = configured == reported ? "has the configured" : "has another than the configured";
  text.format("%s configuration: configured are %s, it reports %s", verdict, inWords(configured).c_str(),
              inWords(reported).c_str());
  return text;
}

std::optional<IoLengths> ioLengths(ByteView configuration) noexcept {
  IoLengths lengths;
  ByteReader reader{configuration};
  while (reader.remaining() > 0) {
    const unsigned identifier = reader.u8();
    if ((identifier & (kInputBit | kOutputBit)) != 0) {
      const std::size_t length = inBytes(identifier, 0x0F);
      if ((identifier & kOutputBit) != 0) lengths.outputs += length;
      if ((identifier & kInputBit) != 0) lengths.inputs += length;
      continue;
    }
    if ((identifier & kSpecialOutputBit) != 0) lengths.outputs += specialLength(reader);
    if ((identifier & kSpecialInputBit) != 0) lengths.inputs += specialLength(reader);
    const unsigned maker_bytes = identifier & 0x0Fu;
    for (unsigned i = 0; maker_bytes != kNoMakerBytes && i < maker_bytes; ++i) reader.u8();
  }
  if (!reader.ok()) return std::nullopt;
  return lengths;
}

}  // namespace nord_driver::profibus
