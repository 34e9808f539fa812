// The fault numbers of one inverter in words, for any number: what the catalogue does not list is said to be unknown.
#pragma once

#include <cstdint>
#include <string>

#include "catalogue/fault_catalogue.h"

namespace nord_driver::catalogue {

/// Of P700 and P701: numbers are raw, the printed one times ten (102 = 10.2).
class FaultWords {
 public:
  /// `catalogue` must outlive the object and its copies.
  FaultWords(const FaultCatalogue& catalogue, Device inverter) : catalogue_(&catalogue), inverter_(inverter) {}

  /// "E10.2", as the inverter's display groups it; "no fault" and "fault of unknown number" for 0 and
  /// kFaultNumberUnknown.
  static std::string label(std::uint16_t raw);

  /// "motor overtemperature (I2t)"; "no fault" for 0.
  const std::string& name(std::uint16_t raw) const { return find(raw).name; }
  /// What probably led to it, a clause; empty for 0 and where nobody says.
  const std::string& cause(std::uint16_t raw) const { return find(raw).cause; }
  /// What to look at, a clause; empty for 0 and where nobody says.
  const std::string& remedy(std::uint16_t raw) const { return find(raw).remedy; }

 private:
  struct Words {
    const std::string& name;
    const std::string& cause;
    const std::string& remedy;
  };
  Words find(std::uint16_t raw) const;

  const FaultCatalogue* catalogue_;
  Device inverter_;
};

}  // namespace nord_driver::catalogue
