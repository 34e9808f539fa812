#include "node/fault_board.h"

#include <utility>

#include "cycle/request.h"
#include "profile/fault_number.h"

namespace nord_driver::node {

FaultBoard::FaultBoard(std::vector<std::string> names, std::vector<catalogue::FaultWords> words)
    : names_(std::move(names)), words_(std::move(words)), numbers_(names_.size()) {}

void FaultBoard::post(const cycle::CycleSnapshot& snapshot) noexcept {
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const cycle::DriveSnapshot& drive = snapshot.drives[i];
    const std::uint16_t latched = drive.fault_latched ? drive.last_fault_number : std::uint16_t{0};
    numbers_[i] = drive.fault_number != 0 ? drive.fault_number : latched;
  }
}

std::string FaultBoard::text(DriveIndex drive) const {
  std::string text;
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const std::uint16_t number = numbers_[i];
    if ((drive != cycle::kAllDrives && drive != i) || !profile::isFaultNumber(number)) continue;
    text += (text.empty() ? "drive " : "; drive ") + names_[i] + ": " + catalogue::FaultWords::label(number) + ", " +
            words_[i].name(number);
    if (!words_[i].remedy(number).empty()) text += "; remedy: " + words_[i].remedy(number);
  }
  return text;
}

}  // namespace nord_driver::node
