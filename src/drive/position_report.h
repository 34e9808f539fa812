// What a drive that positions tells of its position and of its target: plain values.
#pragma once

#include <cstdint>
#include <optional>

#include "drive/teach_run.h"

namespace nord_driver::drive {

/// Why a target was not taken.
enum class TargetRefusal : std::uint8_t {
  kNone,
  kNotFinite,
  kNotEnabled,    ///< it is not kept for later: whoever enables does not know what somebody once wanted
  kHoming,        ///< a reference run is under way
  kElementsOnly,  ///< it goes to the elements of its array
  kBelowLimit,    ///< of the joint
  kAboveLimit,    ///< of the joint
  kBeyondRange,   ///< of the words that carry it, or of the drive
};

struct PositionReport {
  std::optional<double> position;  ///< rad or m of the joint; none while not known (offline, not carried, just back)
  std::optional<double> target;    ///< rad or m, as sent while enabled
  bool reached = false;            ///< enabled, the drive says so (status bit 8), and the position is near the target
  bool following = false;          ///< enabled, and on its way to a target that was asked for
  bool at_limit = false;           ///< at, or beyond, the lower or upper limit of its joint
  bool homed = false;              ///< its reference is known, as far as that can be told
  bool homing = false;             ///< a reference run is under way: its bit is high
  TeachBits teach;                 ///< what is high while its position is taught
  bool reset = false;              ///< the bit that sets its count anew is high
  std::uint8_t element = 0;        ///< of its array, the one it is told to go to by bits; 0: none
  bool held_back = false;          ///< the newest position cannot be: the one before is told
  TargetRefusal refused = TargetRefusal::kNone;  ///< of the newest target
  double refused_target = 0.0;                   ///< rad or m
};

/// A clause: "it is above the joint's upper limit".
const char* toString(TargetRefusal refusal) noexcept;

}  // namespace nord_driver::drive
