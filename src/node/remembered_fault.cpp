#include "node/remembered_fault.h"

#include "profile/fault_number.h"

namespace nord_driver::node {

std::string rememberedFault(const cycle::DriveSnapshot& drive, std::uint16_t number,
                            const catalogue::FaultWords& words) {
  const cycle::FaultHistory& history = drive.fault_history;
  if (profile::isFaultNumber(number) || !history.asked || history.numbers.empty()) return {};
  const std::uint16_t newest = history.numbers[0];
  if (!profile::isFaultNumber(newest)) return {};
  return "; the newest of its last faults, P701[-01], is " + catalogue::FaultWords::label(newest) + ", " +
         words.name(newest);
}

}  // namespace nord_driver::node
