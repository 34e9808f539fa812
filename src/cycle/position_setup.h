// What the configuration says of a drive that positions.
#pragma once

#include <cstdint>
#include <optional>

#include "cycle/signal_setup.h"
#include "drive/position_axis.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/profile/series.h"
#include "nord_driver/transport/bus_report.h"
#include "profile/position_words.h"
#include "profile/scaling.h"
#include "robot/urdf_geometry.h"

namespace nord_driver::cycle {

enum class DriveMode : std::uint8_t { kVelocity, kPosition };

/// A bit that asks something of the position control: for a reference run, to be taught, for a new zero.
struct PositionBit {
  enum class Carrier : std::uint8_t { kBusBit, kControlBit, kPosicon };
  Carrier carrier = Carrier::kControlBit;
  std::uint8_t number = 8;      ///< bus I/O in bit 0..7, bit 8 or 9 of the control word
  std::uint16_t function = 22;  ///< what P480 has to say of it
};

/// The bits that choose an element of the position array (BU 0020 7.3.5).
constexpr unsigned kArrayBits = 6;

/// Bit `bit` (0 to kArrayBits - 1) of an element's number; `array` is bit 0, the others follow it with the functions that
/// follow.
constexpr PositionBit arrayBit(const PositionBit& array, unsigned bit) noexcept {
  PositionBit one = array;
  one.number = static_cast<std::uint8_t>(one.number + bit);
  one.function = static_cast<std::uint16_t>(one.function + bit);
  return one;
}

/// Every bit that a number from 1 to `most` has.
constexpr unsigned allBits(unsigned most) noexcept {
  unsigned all = 1;
  while (all < most) all = all << 1u | 1u;
  return all;
}

/// The bits that make the drive take its position into an element of its array.
struct TeachSetup {
  PositionBit teach_in;
  PositionBit quit;
  /// Bit 0 of the element's number, the others follow it with the functions that follow; none: none is sent.
  std::optional<PositionBit> array;
  std::uint8_t element = 1;  ///< of P613, as its bits say it
};

struct PositionSetup {
  drive::PositionConfig axis;
  std::uint8_t bits = 32;                                       ///< of the setpoint and of the actual position
  profile::FieldOrder order = profile::FieldOrder::kHighFirst;  ///< of SK 700E and 750E
  /// The bits that choose an element of the array, from that of value 1 on, the others follow; none: none are known.
  std::optional<PositionBit> array;
  std::uint8_t elements = 63;  ///< of the array, those users may choose
  /// What P610 has to be, -1: it is not looked at. Its values stand in none of the manuals at hand.
  std::int32_t setpoint_mode = -1;
  std::optional<PositionBit> home;         ///< none: it is never asked for a reference run
  std::optional<TeachSetup> teach;         ///< none: no position is ever taught
  std::optional<PositionBit> reset;        ///< none: its count is never set anew
  std::optional<SignalSetup> referenced;   ///< a bus I/O out bit or a bit of the status word; none: no bit says it
  std::uint16_t referenced_function = 20;  ///< what P481 has to say of that bit; 0: it is not looked at
};

DriveMode readDriveMode(const Settings& drive);

/// What the drive's own group does not say.
struct PositionContext {
  profile::Series series = profile::Series::kSk5xxe;
  profile::JointScaling scaling;
  std::optional<robot::JointRange> joint;  ///< what the robot's description says of it
};

/// Of a drive with `mode: position`. Throws ConfigError.
PositionSetup readPositionSetup(const Settings& drive, const PositionContext& context);

/// For a drive that follows velocities. Throws ConfigError naming the first of the keys above that is there.
void refusePositionKeys(const Settings& drive);

/// Throws ConfigError where the bus, or the profile of the drive, does not carry the words of the position.
void checkPositionCarried(const Settings& drive, const PositionSetup& setup, profile::Series series,
                          const DriveIdentity& identity);

}  // namespace nord_driver::cycle
