// What a write has done when nobody waits for it any more.
#include "drive/parameter_session.h"
#include "profile/module_parameters.h"

namespace nord_driver::drive {

using profile::ParameterAction;
using profile::ParameterRequest;

ParameterSession::Withdrawn ParameterSession::withdraw(std::uint32_t id) noexcept {
  ParameterRequest* const request = requests_.find(id);
  if (request == nullptr || request->action == ParameterAction::kRead) return Withdrawn::kNothing;
  if (request != &requests_.front() || run_.recovery || step_ <= Step::kReadValue) {
    request->action = ParameterAction::kRead;
    return Withdrawn::kNothing;
  }
  run_.withdrawn = true;
  switch (step_) {
    case Step::kReadSwitch:
      return Withdrawn::kNothing;
    case Step::kWrite:
      if (isSaved() || owesEepromSwitch()) return Withdrawn::kMayBeSaved;
      break;
    case Step::kSwitchOff:
    case Step::kSwitchOn:
      return Withdrawn::kMayBeSaved;
    default:
      break;
  }
  return run_.result.eeprom_written ? Withdrawn::kMayBeSaved : Withdrawn::kRamOnly;
}

bool ParameterSession::isSaved() const noexcept {
  const std::uint16_t number = requests_.front().number;
  return number == kSaveInEeprom || profile::isOfModule(number) || (!owesEepromSwitch() && !run_.switch_was_off);
}

}  // namespace nord_driver::drive
