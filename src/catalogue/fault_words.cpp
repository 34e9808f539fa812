#include "catalogue/fault_words.h"

#include "profile/fault_number.h"

namespace nord_driver::catalogue {

std::string FaultWords::label(std::uint16_t raw) {
  if (raw == 0) return "no fault";
  if (raw == profile::kFaultNumberUnknown) return "fault of unknown number";
  return faultLabel(FaultCodes::kP700, raw);
}

FaultWords::Words FaultWords::find(std::uint16_t raw) const {
  static const std::string kNothing;
  static const std::string kNone{"no fault"};
  static const std::string kUnknown{"fault; its number could not be read"};
  static const std::string kUnknownCause{"the fault bit was seen, but P700 gave no number"};
  static const std::string kUnknownRemedy{"look at the inverter's display, or read P700 and the last faults, P701"};
  static const std::string kUnlisted{"a fault number this driver does not list"};
  static const std::string kUnlistedCause{"not known to this driver"};
  static const std::string kUnlistedRemedy{"see the list of error messages in the inverter's manual"};
  if (raw == 0) return {kNone, kNothing, kNothing};
  if (raw == profile::kFaultNumberUnknown) return {kUnknown, kUnknownCause, kUnknownRemedy};
  const FaultEntry* entry = catalogue_->find(FaultCodes::kP700, raw, inverter_);
  if (entry == nullptr) return {kUnlisted, kUnlistedCause, kUnlistedRemedy};
  return {*entry->name, entry->cause ? *entry->cause : kNothing, entry->remedy ? *entry->remedy : kNothing};
}

}  // namespace nord_driver::catalogue
