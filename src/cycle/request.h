// What callers ask of the bus cycle, and what it answers: passed through rings, so that neither waits for the other.
#pragma once

#include <cstdint>

#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/parameter_request.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::cycle {

enum class RequestKind : std::uint8_t {
  kEnable,
  kDisable,    ///< ramp to zero, then OFF1 until "ready to switch on"
  kQuickStop,  ///< OFF3
  kResetOdometry,
  kHome,                ///< a reference run of one drive that positions
  kTeach,               ///< one drive that positions takes its position into its array, disabled and at standstill
  kResetPosition,       ///< one drive that positions sets its count anew, disabled and at standstill
  kAcknowledge,         ///< faults; refused while their cause stands
  kSelectParameterSet,  ///< one drive, disabled and at standstill
  kReadParameter,
  kWriteParameter,
  kShutDown,  ///< as kDisable for all drives, and no enable after it
};

/// All drives of the node.
constexpr DriveIndex kAllDrives = static_cast<DriveIndex>(-1);

struct Request {
  std::uint32_t id = 0;  ///< comes back in the completion; 0: nobody waits for one
  RequestKind kind = RequestKind::kDisable;
  DriveIndex drive = kAllDrives;
  Duration patience{};  ///< the longest the asker waits
  Instant asked{};      ///< when, by the clock of the bus; the patience counts from then. {}: from when it is taken
  profile::ParameterRequest parameter;  ///< its set 0: the one in force, whichever that is
  std::uint8_t parameter_set = 0;       ///< for kSelectParameterSet, 1..4
};

struct Completion {
  std::uint32_t id = 0;
  bool success = false;
  bool unanswered = false;  ///< the cycle has not told what became of it: it may be carried out all the same
  Sentence message;
  profile::ParameterResult parameter;  ///< of an access; `message` says in a sentence what it says in clauses
};

}  // namespace nord_driver::cycle
