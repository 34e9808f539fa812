// The blocks behind the six standard bytes of a Slave_Diag answer: of the device, of its modules, of single channels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::profibus {

enum class DiagnosisBlockKind : std::uint8_t {
  kDevice,      ///< header 00......: bytes of the maker
  kIdentifier,  ///< header 01......: one bit per module
  kChannel,     ///< header 10......: three bytes
  kRevision,    ///< header 11......: one byte
  kInvalid      ///< a length of 0, or a block that ends behind the telegram: everything from here on
};

/// One block, header included (EN 50170-8, extended diagnosis).
struct DiagnosisBlock {
  DiagnosisBlockKind kind = DiagnosisBlockKind::kInvalid;
  ByteView bytes;

  ByteView content() const noexcept { return bytes.sub(1); }

  /// kDevice: the connection from the module to its inverter is broken (02 04: BU 0020 8.2).
  bool isInverterLinkBroken() const noexcept;
  /// kIdentifier: module `module` (from 0) has a diagnosis.
  bool isModuleAffected(std::size_t module) const noexcept;
  // kChannel.
  std::uint8_t module() const noexcept { return at(0) & 0x3Fu; }
  std::uint8_t channel() const noexcept { return at(1) & 0x3Fu; }
  bool isInput() const noexcept { return (at(1) & 0x40u) != 0; }
  bool isOutput() const noexcept { return (at(1) & 0x80u) != 0; }
  std::uint8_t errorType() const noexcept { return at(2) & 0x1Fu; }
  /// kRevision.
  std::uint8_t revision() const noexcept { return at(0) & 0x3Fu; }

 private:
  std::uint8_t at(std::size_t i) const noexcept { return i < bytes.size() ? bytes[i] : std::uint8_t{0}; }
};

/// Hands out block after block. Whatever the bytes are, every byte is in exactly one block.
class DiagnosisBlocks {
 public:
  explicit DiagnosisBlocks(ByteView extended) noexcept : rest_(extended) {}
  std::optional<DiagnosisBlock> next() noexcept;

 private:
  ByteView rest_;
};

/// "short circuit", "wire break" ...: the error type of a channel block.
const char* channelErrorName(std::uint8_t error_type) noexcept;

/// A sentence for a technician, subject left out.
Sentence describe(const DiagnosisBlock& block) noexcept;

}  // namespace nord_driver::profibus
