// The electronic type plate of a simulated module: the I&M records behind index 255.
//
// BU 0220 8.3.4.8 gives the manufacturer number and that I&M is supported "to a certain extent": I&M0 only here. The
// layout is that of the PROFIBUS profile guideline, part 1, as ABB prints it (FPBA-01 user manual, "I&M records").
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"

namespace nord_driver::sim {

/// No source prints NORD's order numbers and versions: all but the manufacturer are the simulator's.
struct IdentificationSettings {
  bool active = true;
  std::uint16_t manufacturer = 393;
  const char* order_number = "SK CU4-PBR";
  const char* serial_number = "SIMULATED-0001";
  std::uint16_t hardware = 2;
  std::uint8_t software[3] = {1, 3, 0};
};

class IdentificationRecords {
 public:
  using Data = FixedBytes<68>;
  static constexpr std::uint8_t kIndex = 255;

  explicit IdentificationRecords(const IdentificationSettings& settings) noexcept : settings_(settings) {}

  /// A call: 08 00 and the index of the record. Otherwise nothing can be read, and the code of DP-V1 that says why.
  std::optional<std::uint8_t> write(ByteView data) noexcept;
  /// What was called: the call's header and 64 bytes. Nothing: no call came before.
  std::optional<Data> read() noexcept;
  void reset() noexcept { called_ = false; }

 private:
  IdentificationSettings settings_;
  bool called_ = false;
};

}  // namespace nord_driver::sim
