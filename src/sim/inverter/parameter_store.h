// The parameter values of a simulated inverter: RAM, EEPROM and the counter of EEPROM writes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/inverter/parameter_definitions.h"

namespace nord_driver::sim {

/// Error numbers of a parameter answer: BU 0020 7.5.1, BU 2700 6.5.1.1.
enum class ParameterError : std::uint16_t {
  kInvalidNumber = 0,
  kNotChangeable = 1,
  kLimits = 2,
  kSubIndex = 3,
  kNoArray = 4,
  kDataType = 5,
  kInvalidOrder = 201,
  kAnswerNotPossible = 202,
};

/// Where a write goes: P560 and the order labels 11-14 decide (BU 2700 6.5).
enum class Storage : std::uint8_t { kRam, kEeprom };

class ParameterStore {
 public:
  static constexpr unsigned kSets = 4;

  explicit ParameterStore(const Device& device = Device{});
  /// Of something that is no inverter.
  explicit ParameterStore(std::vector<ParameterDefinition> definitions);

  const Device& device() const noexcept { return device_; }

  const ParameterDefinition* find(unsigned number) const noexcept;

  /// The raw value in RAM; `set` 0-3 (taken as 0 when not set-dependent), `element` from 0. 0 when there is none.
  std::int32_t value(unsigned number, unsigned set = 0, unsigned element = 0) const noexcept;
  /// In the parameter's unit.
  double scaled(unsigned number, unsigned set = 0) const noexcept;

  /// As an order over the bus does it: checks limits and rights, counts EEPROM writes. No value: done.
  std::optional<ParameterError> write(unsigned number, unsigned set, unsigned element, std::int32_t raw,
                                      Storage storage) noexcept;
  /// As commissioning at the device does it, RAM and EEPROM, uncounted, limits unchecked. False: no such parameter.
  bool preset(unsigned number, unsigned set, unsigned element, std::int32_t raw) noexcept;
  /// A value the inverter itself shows (P700, P740 ...): RAM only. Without such an element nothing happens.
  void show(unsigned number, unsigned element, std::int32_t raw) noexcept;

  /// Everything to its factory setting, RAM and EEPROM.
  void resetToFactory() noexcept;
  /// Mains back: what was only in RAM is gone.
  void restoreFromEeprom() noexcept { ram_ = eeprom_; }

  std::uint64_t eepromWrites() const noexcept { return eeprom_writes_; }

 private:
  std::optional<std::size_t> slot(unsigned number, unsigned set, unsigned element) const noexcept;

  void lay();

  Device device_;
  std::vector<ParameterDefinition> definitions_;
  std::array<std::int16_t, 1000> index_{};  // parameter number -> definition, -1 = none
  std::vector<std::size_t> first_;          // definition -> first slot
  std::vector<std::int32_t> ram_;
  std::vector<std::int32_t> eeprom_;
  std::uint64_t eeprom_writes_ = 0;
};

}  // namespace nord_driver::sim
