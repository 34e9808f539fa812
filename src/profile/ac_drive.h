// The AC drive profile of DeviceNet (assemblies 20/70 and 21/71, BU 0280 4.2.3) and NORD's own process data, one told
// as the other.
//
// The drive layer speaks NORD's words only. The profile has one byte of bits and a speed in rpm each way. What gets lost:
//  - bit 10, "data valid": there is no such bit, and the bytes go out in every poll. Where NORD's words ask to be
//    ignored the idle byte goes out, which brings the motor down its ramp, and takes the enable away, which acknowledges
//    a fault (BU 0020 8): whoever sends it first has asked for the state;
//  - OFF2 and OFF3: whatever is not "operation enabled" is the ramp of OFF1. There is no quick stop;
//  - status bit 9, "bus has control": "control from net" of assembly 71 is the bit the driver itself sends, and P509 and
//    P510 are not queried (BU 0280 4.2.3.1); assembly 70 has no such bit, and it is told as 1. An inverter
//    that obeys its terminals or keypad is not recognized by either;
//  - the bus bits 8 and 9, status bits 10 and 13 and the parameter set: read as 0 and set 1;
//  - setpoints and actual values 2 and 3; the resolution of value 1, which is 1 rpm, and never less of a
//    setpoint that is not 0.
// Assembly 20/70 (profile 1) also has no reverse, tells neither warnings nor "setpoint reached", and its status byte is
// zero at rest: whether there is an inverter it does not tell.
#pragma once

#include <cstdint>
#include <optional>

#include "core/units.h"
#include "nord_driver/profile/process_data.h"

namespace nord_driver::profile {

/// Bytes 0, 2 and 3 of assembly 20 or 21; byte 1 is 0.
struct AcDriveOutput {
  std::uint8_t control = 0;
  std::int16_t speed = 0;  ///< rpm, never below 0: the direction is in the bits
};

/// Bytes 0 to 3 of assembly 70 or 71.
struct AcDriveInput {
  std::uint8_t status = 0;
  std::uint8_t state = 0;  ///< assembly 71 only: class 41, attribute 6
  std::int16_t speed = 0;  ///< rpm
};

/// Which of the two.
enum class AcDriveKind : std::uint8_t {
  kBasic,    ///< 20/70, profile 1
  kExtended  ///< 21/71, profile 2: with reverse, net control and net reference
};

/// The bits of a status word that a state of the control supervisor (class 41, attribute 6; BU 0280 4.3.6) stands for,
/// with "bus has control"; 0 for a number that is no state.
Word statusOfSupervisor(std::uint8_t state) noexcept;

/// rpm are those of the field, 60 * frequency / pole pairs: no manual says whether the inverter counts slip in.
class AcDriveScaling {
 public:
  /// `pole_pairs` > 0: of the motor. Without `max_frequency` (P105 of set 1) every speed is 0.
  AcDriveScaling(AcDriveKind kind, int pole_pairs) noexcept : kind_(kind), pole_pairs_(pole_pairs) {}

  void setMaxFrequency(std::optional<Hertz> max_frequency) noexcept { max_frequency_ = max_frequency; }

  AcDriveOutput toAcDrive(const ProcessOutput& output) const noexcept;
  /// Profile 2 with nothing but zeros stays all zero: there is no inverter behind it.
  ProcessInput fromAcDrive(const AcDriveInput& input) const noexcept;

 private:
  double rpmOfHundredPercent() const noexcept;
  Word statusWord(const AcDriveInput& input) const noexcept;

  AcDriveKind kind_;
  int pole_pairs_;
  std::optional<Hertz> max_frequency_;
};

}  // namespace nord_driver::profile
