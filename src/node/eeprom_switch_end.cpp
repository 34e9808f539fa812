#include "node/eeprom_switch_end.h"

#include <optional>

namespace nord_driver::node {

namespace {

constexpr std::uint16_t kSaveInEeprom = 560;
constexpr Duration kPause = std::chrono::milliseconds{5};

// One that is silent cannot be told.
std::optional<DriveIndex> firstThatCanBeAsked(const cycle::CycleSnapshot& snapshot) {
  for (DriveIndex i = 0; i < snapshot.drives.size(); ++i) {
    if (snapshot.drives[i].owes_eeprom_switch && snapshot.drives[i].online) return i;
  }
  return std::nullopt;
}

}  // namespace

std::vector<DriveIndex> settleEepromSwitches(const EndingNode& node) {
  const Instant begin = node.now();
  while (node.writes_under_way() > 0 && node.now() - begin < kWritesPatience) node.sleep(kPause);
  const Instant deadline = node.now() + kPutBackPatience;
  while (const auto drive = firstThatCanBeAsked(node.snapshot())) {
    const Duration left = deadline - node.now();
    if (left <= Duration::zero()) break;
    // Any access lets the drive's session try again; it comes after a write whose caller waits no more.
    cycle::Request read;
    read.kind = cycle::RequestKind::kReadParameter;
    read.drive = *drive;
    read.patience = left;
    read.parameter.number = kSaveInEeprom;
    node.carry_out(read);
    node.sleep(kPause);
  }
  std::vector<DriveIndex> owing;
  const cycle::CycleSnapshot& last = node.snapshot();
  for (DriveIndex i = 0; i < last.drives.size(); ++i) {
    if (last.drives[i].owes_eeprom_switch) owing.push_back(i);
  }
  return owing;
}

}  // namespace nord_driver::node
