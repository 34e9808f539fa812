#include "nord_driver/profibus/diagnosis.h"

namespace nord_driver::profibus {

std::optional<Diagnosis> Diagnosis::from(ByteView bytes) noexcept {
  if (bytes.size() < kStandardLength || bytes.size() > kMaxLength) return std::nullopt;
  Diagnosis diagnosis;
  for (const std::uint8_t byte : bytes) diagnosis.bytes_.push_back(byte);
  return diagnosis;
}

}  // namespace nord_driver::profibus
