// What a CAN bus looks like to the transport above: SocketCAN, a virtual bus between processes, or a simulated one.
#pragma once

#include <cstdint>
#include <string>

#include "core/can_frame.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

/// The controller's fault confinement state (ISO 11898-1), as far as it is known.
enum class CanState : std::uint8_t {
  kUnknown,  ///< the interface does not tell (vcan, virtual bus)
  kActive,
  kWarning,  ///< an error counter above 96
  kPassive,  ///< an error counter above 127: it may no longer disturb others
  kBusOff,   ///< off the bus until restarted
  kDown,     ///< the interface is there, but not up
};

struct CanCounters {
  std::uint64_t dropped = 0;            ///< received, but lost because nobody took them in time
  std::uint64_t queue_full = 0;         ///< sends the interface had no room for
  std::uint64_t no_acknowledge = 0;     ///< error frames: no other node acknowledges
  std::uint64_t bus_errors = 0;         ///< error frames of protocol violations
  std::uint64_t controller_errors = 0;  ///< controller overflow, warning, passive
  std::uint64_t bus_off = 0;
  std::uint64_t restarts = 0;
};

enum class CanSend : std::uint8_t {
  kSent,       ///< handed to the interface
  kQueueFull,  ///< not sent: the caller keeps the newest value and tries again in the next cycle
  kFailed,     ///< not sent: the interface is down or gone; `isOpen()` tells whether the link closed itself
};

struct ReceivedCanFrame {
  CanFrame frame;
  Instant at;  ///< when it was received: the kernel's time stamp where there is one
};

/// Life: closed -> open() -> open -> close() or a failure -> closed. Nothing here throws. An interface that is only
/// down keeps the link open (`state()` is kDown); one that was removed closes it. As with `ByteLink` the link owns the
/// time of the bus.
class CanLink {
 public:
  virtual ~CanLink() = default;

  /// Opens the interface with the settings it was constructed with. False: `lastError()`.
  virtual bool open() noexcept = 0;
  virtual void close() noexcept = 0;
  virtual bool isOpen() const noexcept = 0;

  virtual CanSend send(const CanFrame& frame) noexcept = 0;
  /// The next frame that has arrived, without waiting; error frames of the controller are taken in here and never
  /// given out. False when there is none.
  virtual bool receive(ReceivedCanFrame& received) noexcept = 0;

  /// Waits until something can be received or `until` has come. True when something can be received.
  virtual bool waitReadable(Instant until) noexcept = 0;
  /// After kQueueFull: waits until a send may succeed or `until` has come. True when it may. A burst longer than the
  /// interface's queue (8 frames) needs it.
  virtual bool waitWritable(Instant until) noexcept {
    static_cast<void>(until);
    return true;
  }
  /// Waits until `when`, whatever arrives meanwhile.
  virtual void sleepUntil(Instant when) noexcept = 0;
  virtual Instant now() const noexcept = 0;

  virtual CanState state() const noexcept = 0;
  /// Open, and frames can pass: neither down nor bus-off.
  bool works() const noexcept { return isOpen() && state() != CanState::kBusOff && state() != CanState::kDown; }
  virtual CanCounters counters() const noexcept = 0;
  /// One sentence naming the interface and what went wrong; empty when nothing did.
  virtual const std::string& lastError() const noexcept = 0;
  /// One sentence for a technician about an open interface that does not work as it should ("no other node
  /// acknowledges: are the drives powered and is the bus terminated?"); empty when there is nothing to say.
  virtual const char* advice() const noexcept = 0;
};

}  // namespace nord_driver::link
