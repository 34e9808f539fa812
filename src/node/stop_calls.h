// What `~enable`, `~quick_stop` and those of the drives do with their calls: a stop reaches the bus cycle at once,
// however many calls wait for their drives.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "cycle/request.h"

namespace nord_driver::node {

/// A call holds its thread until the drives have confirmed, seconds maybe. Each of the two lanes always has a thread
/// that holds none: calls of `~enable` with true are refused when too many wait, and a stop that comes then is begun,
/// but not followed to its end. By any thread.
class StopCalls {
 public:
  /// How a request is carried out: RequestBroker::call.
  using CarryOut = std::function<cycle::Completion(const cycle::Request&)>;

  /// `patience`: for the answer of the drives.
  StopCalls(std::size_t drives, Duration patience, CarryOut carry_out);

  /// Threads of a node with so many drives: for `~enable`, and for `~quick_stop`, which shares none with it.
  static std::uint32_t enableThreads(std::size_t drives) noexcept;
  static std::uint32_t quickStopThreads(std::size_t drives) noexcept;

  /// `~enable` and `~<drive>/enable`.
  cycle::Completion enable(bool on, DriveIndex drive);
  cycle::Completion quickStop(DriveIndex drive);

 private:
  /// Calls that hold a thread of a lane.
  struct Lane {
    std::atomic<std::uint32_t> calls{0};
    std::uint32_t threads;
  };

  cycle::Completion enableIfFree(DriveIndex drive);
  cycle::Completion stop(Lane& lane, cycle::RequestKind kind, DriveIndex drive);
  cycle::Completion carryOut(cycle::RequestKind kind, DriveIndex drive, Duration patience) const;

  Duration patience_;
  CarryOut carry_out_;
  Lane enabling_, quick_stops_;
};

}  // namespace nord_driver::node
