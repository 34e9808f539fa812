// Before the node ends: a parameter write that is under way comes to its end, and P560, which spares the EEPROM in one,
// goes back to 1.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cycle/request.h"
#include "cycle/snapshot.h"

namespace nord_driver::node {

/// What settleEepromSwitches() needs of the node. The bus cycle still runs.
struct EndingNode {
  /// Writes that wait for their answers; no new one comes (RequestBroker::refuseWrites()).
  std::function<std::size_t()> writes_under_way;
  std::function<const cycle::CycleSnapshot&()> snapshot;
  /// RequestBroker::call.
  std::function<cycle::Completion(const cycle::Request&)> carry_out;
  std::function<Instant()> now;
  std::function<void(Duration)> sleep;
};

/// Waits for what is under way, at most kWritesPatience; then asks each drive that answers and still has P560 = 0 because
/// of this node to have it put back, at most kPutBackPatience. Returns the drives where that has not succeeded.
std::vector<DriveIndex> settleEepromSwitches(const EndingNode& node);

/// One write takes about eight accesses, tenths of a second; a drive has eight at most that wait.
constexpr Duration kWritesPatience = std::chrono::seconds{3};
constexpr Duration kPutBackPatience = std::chrono::seconds{2};

}  // namespace nord_driver::node
