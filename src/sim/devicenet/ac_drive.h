// The AC drive profile of one inverter: run, reset and rpm in place of control word and share. BU 0280 4.2.3, 4.3.6.
//
// How the module leads NORD's state machine by these bits is printed nowhere: here an edge of "run" at a drive that is
// not faulty begins, OFF1 is said until then, and a fault ends it.
#pragma once

#include <cstdint>

#include "nord_driver/core/bytes.h"
#include "sim/devicenet/dn_layout.h"
#include "sim/drive_unit.h"

namespace nord_driver::sim {

/// Attribute 6 of class 41.
enum class AcDriveState : std::uint8_t {
  kStartUp = 1,
  kNotReady = 2,
  kReady = 3,
  kEnabled = 4,
  kStopping = 5,
  kFaultStop = 6,
  kFaulted = 7,
};

class AcDrive {
 public:
  /// What the master says, by assembly 20 or 21 or attribute by attribute.
  struct Command {
    bool run_forward = false;
    bool run_reverse = false;
    bool fault_reset = false;
    bool net_control = false;
    bool net_reference = false;
    std::int16_t rpm = 0;
  };
  Command command;

  /// Four bytes of instance 20 or 21; what a shorter area does not have is 0.
  void take(ByteView bytes, DnProfile profile) noexcept;
  /// The words for the inverter by `command`, once for each message. Without "net control" bit 10 is 0.
  ProcessData words(const DriveUnit& drive) noexcept;
  /// Four bytes of instance 70 or 71.
  FixedBytes<4> status(const DriveUnit& drive, DnProfile profile) const noexcept;
  AcDriveState state(const DriveUnit& drive) const noexcept;
  void forget() noexcept { *this = AcDrive{}; }

 private:
  bool ran_ = false;  // "run" of the last message
  bool started_ = false;
  Word reference_ = 0;  // the last one with "net reference"
};

/// Speed of the field in rpm at a frequency in Hz, and back.
double dnRpmOf(double frequency, const DriveUnit& drive) noexcept;
double dnFrequencyOf(double rpm, const DriveUnit& drive) noexcept;
/// Of the shaft, rpm.
std::int16_t dnActualRpm(const DriveUnit& drive) noexcept;

}  // namespace nord_driver::sim
