// What is known of one drive: of its inverter, and of the bus module in front of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "catalogue/catalogues.h"
#include "catalogue/fault_words.h"

namespace nord_driver::catalogue {

/// P150 to P199 are those of the bus module where there is one in front of the inverter (BU 2700 7.1, BU 0280 5.2),
/// whichever of its inverters is asked.
class DriveCatalogue {
 public:
  /// `module`: none where the inverter's own numbers go to the inverter alone. `catalogues` must outlive the object and
  /// its copies.
  DriveCatalogue(const Catalogues& catalogues, profile::Series series, std::optional<Module> module);

  profile::Series series() const noexcept { return series_; }
  const FaultWords& faults() const noexcept { return faults_; }

  /// nullptr: not described.
  const ParameterEntry* find(std::uint16_t number) const;
  /// By what somebody typed, as Catalogue::look().
  Lookup look(const std::string& text) const;
  /// Inverter and module, in the order of the numbers.
  std::vector<const ParameterEntry*> all() const;

  /// "10.00 s", "4 PROFIBUS"; "10.2 bus timeout of the option" of P700 and P701. The raw value alone where `entry` is
  /// nullptr.
  std::string valueText(const ParameterEntry* entry, std::int32_t raw, unsigned index = 1) const;

 private:
  const Catalogue* parameters_;
  profile::Series series_;
  std::optional<Module> module_;
  FaultWords faults_;
};

/// That of a drive of this series behind a transport; `transport` is its name without prefix. `module_in_front`: the
/// time-outs are those of a bus module, which is where one has parameters of its own.
DriveCatalogue driveCatalogue(const Catalogues& catalogues, profile::Series series, const std::string& transport,
                              bool module_in_front);

}  // namespace nord_driver::catalogue
