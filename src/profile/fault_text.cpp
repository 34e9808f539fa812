#include "profile/fault_text.h"

#include "profile/fault_table.h"

namespace nord_driver::profile {

namespace {

constexpr FaultInfo kNone = {0, "no fault", "", ""};
constexpr FaultInfo kUnknownNumber = {kFaultNumberUnknown, "fault; its number could not be read",
                                      "the fault bit is set, but P700 gave no number",
                                      "look at the inverter's display, or read P700 with NORD CON"};
constexpr FaultInfo kUnlisted = {0, "a fault number this driver does not list", "not known to this driver",
                                 "see the list of error messages in the inverter's manual"};

const FaultInfo& info(std::uint16_t raw) noexcept {
  if (raw == 0) return kNone;
  if (raw == kFaultNumberUnknown) return kUnknownNumber;
  const FaultInfo* row = findFault(raw);
  return row == nullptr ? kUnlisted : *row;
}

}  // namespace

const char* faultText(std::uint16_t raw) noexcept {
  return info(raw).text;
}

const char* faultCause(std::uint16_t raw) noexcept {
  return info(raw).cause;
}

const char* faultRemedy(std::uint16_t raw) noexcept {
  return info(raw).remedy;
}

std::string faultName(std::uint16_t raw) {
  if (raw == 0) return "no fault";
  if (raw == kFaultNumberUnknown) return "fault of unknown number";
  return "E" + std::to_string(raw / 10) + "." + std::to_string(raw % 10);
}

}  // namespace nord_driver::profile
