// The answer to Slave_Diag.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"

namespace nord_driver::profibus {

/// No master has parameterised the slave.
constexpr std::uint8_t kNoOwner = 0xFF;

/// Six bytes of the standard, then blocks of the device (EN 50170-8, Slave_Diag).
class Diagnosis {
 public:
  /// Nothing when there are fewer than six bytes or more than 244.
  static std::optional<Diagnosis> from(ByteView bytes) noexcept;

  bool notReady() const noexcept { return bit(0, 0x02); }            ///< Station_not_ready
  bool configurationFault() const noexcept { return bit(0, 0x04); }  ///< Cfg_Fault
  bool extended() const noexcept { return bit(0, 0x08); }            ///< Ext_Diag
  bool notSupported() const noexcept { return bit(0, 0x10); }        ///< Not_Supported: Set_Prm asks for what it lacks
  bool parameterFault() const noexcept { return bit(0, 0x40); }      ///< Prm_Fault
  bool parameterRequest() const noexcept { return bit(1, 0x01); }    ///< Prm_Req: wants to be parameterised anew
  bool staticDiagnosis() const noexcept { return bit(1, 0x02); }     ///< Stat_Diag: has no valid data for the moment
  bool watchdogOn() const noexcept { return bit(1, 0x08); }          ///< WD_On
  std::uint8_t owner() const noexcept { return at(3); }              ///< address of the master that parameterised it
  std::uint16_t ident() const noexcept { return static_cast<std::uint16_t>(at(4) << 8 | at(5)); }

  ByteView bytes() const noexcept { return bytes_; }
  /// The blocks of the device, module or channel.
  ByteView extendedBytes() const noexcept { return ByteView{bytes_}.sub(kStandardLength); }
  /// A module whose inverter is off, or whose link to it is broken, while it exchanges data itself (BU 0020 8.2).
  bool inverterLinkBroken() const noexcept;
  bool empty() const noexcept { return bytes_.empty(); }

  static constexpr std::size_t kStandardLength = 6;
  static constexpr std::size_t kMaxLength = 244;

 private:
  std::uint8_t at(std::size_t i) const noexcept { return i < bytes_.size() ? bytes_[i] : std::uint8_t{0}; }
  bool bit(std::size_t i, std::uint8_t mask) const noexcept { return (at(i) & mask) != 0; }

  FixedBytes<kMaxLength> bytes_;
};

}  // namespace nord_driver::profibus
