// P480 and P481 of a drive that positions: do its bits do what the configuration takes them for?
#include "commissioning/rules.h"

namespace nord_driver::commissioning {

void positionBitsFit(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  for (const cycle::AskedBit& bit : drive.asked().position_bits) {
    const ParameterKey key = drive.key(bit.number, 0, bit.element);
    const auto raw = drive.raw(key);
    if (!raw || *raw == bit.function) continue;
    Finding finding =
        drive.finding(key, Severity::kWarning,
                      std::string("the configuration takes this bit for ") + bit.key +
                          ", and what is asked by it, or told by it, is refused while it does something else");
    finding.remedy = drive.remedy(key, bit.function);
    to.push_back(finding);
  }
}

}  // namespace nord_driver::commissioning
