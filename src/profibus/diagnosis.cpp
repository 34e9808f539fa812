#include "profibus/diagnosis.h"

#include "profibus/diagnosis_blocks.h"

namespace nord_driver::profibus {

std::optional<Diagnosis> Diagnosis::from(ByteView bytes) noexcept {
  if (bytes.size() < kStandardLength || bytes.size() > kMaxLength) return std::nullopt;
  Diagnosis diagnosis;
  for (const std::uint8_t byte : bytes) diagnosis.bytes_.push_back(byte);
  return diagnosis;
}

bool Diagnosis::inverterLinkBroken() const noexcept {
  DiagnosisBlocks blocks{extendedBytes()};
  while (const auto block = blocks.next()) {
    if (block->isInverterLinkBroken()) return true;
  }
  return false;
}

}  // namespace nord_driver::profibus
