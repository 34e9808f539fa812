// The part of a transport that the bus cycle drives: process data and time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nord_driver/core/time.h"
#include "nord_driver/profile/process_data.h"

namespace nord_driver {

/// A drive's place in the list that `configure()` was given.
using DriveIndex = std::size_t;

/// How the connection to an inverter ended, where the bus itself tells. A drive that turned gets what stops it.
enum class Interruption : std::uint8_t {
  kNone,
  kUnasked,    ///< it was reset, or left the exchange of data, without being asked; or two answer in its place
  kSilent,     ///< what watches it (guarding, heartbeat) has not heard it in time
  kContested,  ///< another master commands it, too: it answers, but does what the last word said, whoever sent it
};

/// What the last cycle brought from one inverter.
struct DriveExchange {
  profile::ProcessInput input;
  bool module_answers = false;    ///< the bus module took part in data exchange in this cycle
  bool inverter_answers = false;  ///< ... and the inverter behind it is on: `input` is fresh
  /// In this cycle, said once, also when data are exchanged again already.
  Interruption interruption = Interruption::kNone;
  std::uint8_t module_inputs = 0;  ///< digital inputs of its bus module, DI1 in bit 0; fresh with `module_answers`
  bool inverter_missing = false;   ///< the bus module answers, and the inverter behind it does not: it hears nothing
  bool given_way = false;          ///< another master leads the bus, and nothing is sent for as long
};

/// Called by the thread of the bus cycle alone. Nothing throws; after the first cycles nothing allocates.
class CyclicExchange {
 public:
  virtual ~CyclicExchange() = default;

  /// One bus cycle: sends every drive its output, collects the inputs; both have one element per drive, in the order of
  /// `configure()`, and are the caller's. Returns when all have answered, were given up, or the device is closed. A
  /// transport whose device is gone answers with drives that are silent, and tries to open it again by itself at least
  /// every 2 s; the first call opens it.
  virtual void exchange(const std::vector<profile::ProcessOutput>& outputs,
                        std::vector<DriveExchange>& inputs) noexcept = 0;

  /// Time of this bus. Default: the steady clock.
  virtual Instant now() const noexcept;
  /// Waits until `when`, the rest of a cycle. Default: sleeps.
  virtual void sleepUntil(Instant when) noexcept;

  /// Told once, after configure() and before the first exchange(): silence of a drive that is shorter stops nothing. A
  /// transport that can tries for as long to go on as if nothing had happened. Default: does nothing.
  virtual void setDriveTimeout(Duration /*timeout*/) noexcept {}
  /// Told as setDriveTimeout() is: a drive that fell silent is sent what stops it for as long, unanswered. A transport
  /// that would reset a silent one does not within it. Default: does nothing.
  virtual void setShutdownTimeout(Duration /*timeout*/) noexcept {}
};

}  // namespace nord_driver
