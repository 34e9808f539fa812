// What sits on a simulated CAN bus beside the master, whatever protocol it speaks.
#pragma once

#include <cstddef>
#include <string>

#include "core/can_frame.h"
#include "nord_driver/core/time.h"
#include "sim/judge.h"

namespace nord_driver::sim {

/// Takes what the nodes send; whoever moves the frames implements it.
class CanSink {
 public:
  virtual ~CanSink() = default;
  virtual void transmit(const CanFrame& frame) noexcept = 0;
};

class CanParticipants {
 public:
  virtual ~CanParticipants() = default;

  /// Lets robot and nodes run up to `now` in steps of at most a millisecond; the first call sets the start.
  virtual void advance(Instant now, CanSink& sink) noexcept = 0;
  /// A frame that reached the nodes at the time of the last `advance()`. `Judge::kYes`: it is the master's, unspoilt.
  virtual void receive(const CanFrame& frame, Judge judge, CanSink& sink) noexcept = 0;
  /// When the master's next frame was given to its interface, which repeats it until somebody acknowledges: for a
  /// referee that judges how long it has waited. A bus that does not know says nothing.
  virtual void givenAt(Instant /*when*/) noexcept {}
  /// Whether the master learns by its answer that this frame of its own has arrived: an acknowledge has none.
  virtual bool isAnswered(const CanFrame& /*frame*/) const noexcept { return true; }
  /// A frame of the master that reached nobody, for the referee.
  virtual void judgeOnly(const CanFrame& frame) noexcept = 0;
  /// A frame of a node reached the others, and perhaps the master.
  virtual void delivered(const CanFrame& frame, bool to_master, CanSink& sink) noexcept = 0;
  /// The nodes were kept from running, for so long that the master may take them for lost and begin anew with each.
  virtual void stoodStill() noexcept = 0;

  /// A node is powered: it acknowledges frames.
  virtual bool anyAlive() const noexcept = 0;
  virtual std::size_t nodeCount() const noexcept = 0;
  /// What the referee says.
  virtual std::string report() const = 0;
};

}  // namespace nord_driver::sim
