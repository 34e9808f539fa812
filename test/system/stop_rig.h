// What the table "What stops what" asks of a simulated robot of two drives, whatever bus it is on.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "sim/drive_unit.h"
#include "system/driven_robot.h"

namespace nord_driver::test {

/// What went over the bus for one drive, as somebody beside the driver sees it.
struct WireWords {
  bool sent = false;  ///< in the last cycle, to this drive
  Word control = 0;
  std::int16_t setpoint = 0;
  Instant status_at{};               ///< when the last status word came
  std::optional<Word> fresh_status;  ///< the status word that came in the last cycle
};

/// Another bus is one more of these, and a line that instantiates the table for it. Drive 0 is the left wheel, drive 1
/// the right one, mounted the other way round; both with the time-outs of a user who sets none.
class StopRig {
 public:
  static constexpr std::size_t kDrives = 2;

  virtual ~StopRig() = default;

  virtual DrivenRobot& robot() = 0;
  virtual sim::DriveUnit& unit(DriveIndex drive) = 0;
  virtual std::string referee() = 0;

  /// One bus cycle and the pause after it; `wire()` tells of it.
  virtual void step() = 0;
  const WireWords& wire(DriveIndex drive) const { return words_[drive]; }
  /// Nobody runs the driver any more.
  virtual void passWithoutTheDriver(Duration span) = 0;

  virtual void setBusPresent(bool present) = 0;
  /// The last cycle carried a report of a node's state that the driver did not ask for.
  virtual bool sawUnaskedState() const { return false; }

  /// How old the last status word may be before the bus takes it for missing; drive_timeout counts from there.
  virtual Duration silenceCounts() const = 0;
  /// When the bus itself notices that the right drive is silent, by other messages than its status words.
  virtual Instant noticesSilenceAt() const { return Instant::max(); }
  /// How the base names a drive that has fallen silent.
  static const char* silenceIsNamed() { return "drive right stopped: the inverter fell silent"; }
  /// The longest time from the last word of a master to the trip of the inverter.
  virtual Duration driveSideTimeout() const = 0;
  /// The smallest step of a setpoint the bus carries, of 16384.
  virtual double setpointStep() const { return 1.0; }

 protected:
  StopRig() = default;

  void sawSent(DriveIndex drive, Word control, Word setpoint) {
    WireWords& words = words_[drive];
    words.sent = true;
    words.control = control;
    words.setpoint = static_cast<std::int16_t>(setpoint);
  }
  void sawStatus(DriveIndex drive, Word status, Instant at) {
    WireWords& words = words_[drive];
    words.fresh_status = status;
    words.status_at = at;
  }
  void beginCycle() {
    for (WireWords& words : words_) {
      words.sent = false;
      words.fresh_status.reset();
    }
  }

 private:
  std::array<WireWords, kDrives> words_;
};

/// A robot the table is held on; the name tells what is special about it.
struct StopBus {
  const char* name;
  std::unique_ptr<StopRig> (*make)();
};

}  // namespace nord_driver::test
