// acknowledge_at_start: bus_timeouts. Takes away the time-outs of the bus that stood before this node came.
//
// Where an exchange simply ends, and be it after a clean exit, the drives trip by the lost master (E10.2, BU 2700
// 8.1.1). A node that is started again would find faults nobody needs to look at. Acknowledging moves nothing;
// what still could go wrong is narrowed down all the same: only a fault the drive was met with, and has not been away
// since, only with a number that was read as E10.x, only at rest and without commands, and once.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/event_ring.h"
#include "drive/drive.h"
#include "nord_driver/core/time.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::cycle {

/// Each cycle after the exchange: `update` for every drive, then `pollEvent`.
class StartAcknowledge {
 public:
  /// How long P700 is waited for, and how long the rest of all drives concerned.
  static constexpr Duration kNumberAwaited = std::chrono::seconds{10};
  static constexpr Duration kRestAwaited = std::chrono::seconds{60};

  /// `drives` must outlive the object and not move. `groups`: one per drive; drives with the same number wait for
  /// each other to be there and at rest. Not `wanted`: nothing is ever done.
  StartAcknowledge(bool wanted, std::vector<drive::Drive>& drives, std::vector<std::string> names,
                   std::vector<DriveIndex> groups);

  /// `number`: P700 of the last fault, as FaultReader has it. `quiet`: no command but zero was heard for long enough.
  void update(DriveIndex drive, std::uint16_t number, bool quiet, Instant now) noexcept;
  /// A fault of this drive may still be acknowledged: it is not the end of auto_enable yet.
  bool mayAcknowledge(DriveIndex drive) const noexcept { return states_[drive].step != Step::kDone; }
  /// What was done or given up, in words.
  std::optional<BusEvent> pollEvent() noexcept { return events_.pop(); }

 private:
  enum class Step : std::uint8_t {
    kAwaited,  ///< the drive has not answered yet, or was lost again before its number was read
    kJudging,  ///< it was met with a fault
    kAsked,
    kDone,
  };
  struct State {
    Step step = Step::kAwaited;
    Instant since{};  ///< it was met
    /// Since when its number is known, and every drive concerned is there.
    std::optional<Instant> rest_due = std::nullopt;
    std::uint16_t number = 0;
    std::optional<Instant> lost = std::nullopt;  ///< since when it is away again
  };

  void lose(DriveIndex drive, Instant now) noexcept;
  void judge(DriveIndex drive, std::uint16_t number, bool quiet, Instant now) noexcept;
  void follow(DriveIndex drive) noexcept;
  bool concerned(DriveIndex drive, DriveIndex other) const noexcept;
  bool allOnline(DriveIndex drive) const noexcept;
  /// Whose actual speed cannot be told yet.
  std::optional<DriveIndex> firstUnscaled(DriveIndex drive) const noexcept;
  bool allAtRest(DriveIndex drive) const noexcept;
  void giveUp(DriveIndex drive, const char* why) noexcept;

  std::vector<drive::Drive>& drives_;
  std::vector<std::string> names_;
  std::vector<DriveIndex> groups_;
  std::vector<State> states_;
  EventRing<BusEvent, 32> events_;
};

}  // namespace nord_driver::cycle
