#include "profibus/diagnosis_blocks.h"

#include <array>

namespace nord_driver::profibus {

namespace {

constexpr std::uint8_t kLengthMask = 0x3F;
constexpr std::size_t kChannelLength = 3;

constexpr std::array<const char*, 10> kChannelErrors{
    "unknown error", "short circuit", "undervoltage",         "overvoltage",          "overload",
    "overheating",   "wire break",    "upper limit exceeded", "lower limit exceeded", "error",
};
constexpr std::uint8_t kFirstOfMaker = 16;

DiagnosisBlockKind kindOf(std::uint8_t header) noexcept {
  switch (header >> 6) {
    case 0:
      return DiagnosisBlockKind::kDevice;
    case 1:
      return DiagnosisBlockKind::kIdentifier;
    case 2:
      return DiagnosisBlockKind::kChannel;
    default:
      return DiagnosisBlockKind::kRevision;
  }
}

std::size_t lengthOf(DiagnosisBlockKind kind, std::uint8_t header) noexcept {
  if (kind == DiagnosisBlockKind::kChannel) return kChannelLength;
  if (kind == DiagnosisBlockKind::kRevision) return 1;
  return header & kLengthMask;
}

/// At most 24 bytes as hexadecimal pairs, without taking memory.
FixedText<80> shortHex(ByteView bytes) noexcept {
  constexpr std::size_t kShown = 24;
  char text[3 * kShown + 4] = {};
  std::size_t end = 0;
  for (std::size_t i = 0; i < bytes.size() && i < kShown; ++i) {
    end += static_cast<std::size_t>(std::snprintf(text + end, sizeof text - end, i == 0 ? "%02X" : " %02X", bytes[i]));
  }
  FixedText<80> shown;
  shown.format("%s%s", text, bytes.size() > kShown ? " .." : "");
  return shown;
}

}  // namespace

bool DiagnosisBlock::isInverterLinkBroken() const noexcept {
  return kind == DiagnosisBlockKind::kDevice && bytes.size() == 2 && bytes[1] == 0x04;
}

std::optional<DiagnosisBlock> DiagnosisBlocks::next() noexcept {
  if (rest_.empty()) return std::nullopt;
  DiagnosisBlock block;
  block.kind = kindOf(rest_[0]);
  std::size_t length = lengthOf(block.kind, rest_[0]);
  if (length == 0 || length > rest_.size()) {
    block.kind = DiagnosisBlockKind::kInvalid;
    length = rest_.size();
  }
  block.bytes = rest_.sub(0, length);
  rest_ = rest_.sub(length);
  return block;
}

const char* channelErrorName(std::uint8_t error_type) noexcept {
  if (error_type < kChannelErrors.size()) return kChannelErrors[error_type];
  return error_type >= kFirstOfMaker ? "an error of the device" : "a reserved error number";
}

Sentence describe(const DiagnosisBlock& block) noexcept {
  Sentence text;
  switch (block.kind) {
    case DiagnosisBlockKind::kDevice:
      if (block.isInverterLinkBroken()) {
        text.format("has no connection to its inverter: the inverter is off, or the link to it is broken (02 04)");
      } else {
        text.format("reports of its device: %s", shortHex(block.bytes).c_str());
      }
      break;
    case DiagnosisBlockKind::kIdentifier:
      text.format("reports a diagnosis of its modules (one bit each): %s", shortHex(block.content()).c_str());
      break;
    case DiagnosisBlockKind::kChannel: {
      const char* const direction = block.isInput() ? (block.isOutput() ? "input and output" : "input") : "output";
      text.format("reports of module %u, %s %u: %s", block.module(), direction, block.channel(),
                  channelErrorName(block.errorType()));
      break;
    }
    case DiagnosisBlockKind::kRevision:
      text.format("reports revision %u", block.revision());
      break;
    case DiagnosisBlockKind::kInvalid:
      text.format("reports a diagnosis block that is none: %s", shortHex(block.bytes).c_str());
      break;
  }
  return text;
}

}  // namespace nord_driver::profibus
