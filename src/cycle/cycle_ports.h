// Everything that crosses the border of the bus cycle's thread: newest values and bounded queues, no locks.
#pragma once

#include <semaphore.h>

#include <memory>
#include <mutex>
#include <vector>

#include "core/event_ring.h"
#include "core/latest_value.h"
#include "cycle/commands.h"
#include "cycle/cycle_observer.h"
#include "cycle/request.h"
#include "cycle/snapshot.h"
#include "cycle/word_commands.h"

namespace nord_driver::cycle {

/// Outside threads call `command*`, `submit`, `waitCompletion` and `readSnapshot`; the cycle's thread uses the rest.
class CyclePorts {
 public:
  explicit CyclePorts(std::size_t drive_count);
  ~CyclePorts();
  CyclePorts(const CyclePorts&) = delete;
  CyclePorts& operator=(const CyclePorts&) = delete;

  // Outside.
  /// False, and no command at all, when it is not a number or infinite: the one before goes on growing old.
  bool commandBase(const TwistCommand& command);
  bool commandDrive(DriveIndex drive, const JointCommand& command);
  /// The target of a drive that positions. False as commandBase().
  bool commandPosition(DriveIndex drive, double target);
  /// The same, by an element of the drive's array.
  void commandElement(DriveIndex drive, std::uint8_t element);
  /// Onward from the target it then has. False also beyond kMostIncrement either way.
  bool commandIncrement(DriveIndex drive, double increment);
  static constexpr double kMostIncrement = 1e6;  ///< rad or m
  /// `index` of a configured setpoint, `value` in its unit. False as commandBase().
  bool commandSetpoint(DriveIndex drive, std::size_t index, double value, Instant received);
  /// `index` counts the configured outputs.
  void commandOutput(DriveIndex drive, std::size_t index, bool on, Instant received);
  void tuneBase(const BaseTuning& tuning);
  /// One more publisher of commands is connected: what it has to say has not been heard yet.
  void commanderConnected(Instant when);
  /// False when the queue is full.
  bool submit(const Request& request);
  /// Waits for a completion, at most `limit`. One thread only.
  std::optional<Completion> waitCompletion(Duration limit);
  /// One thread only; the reference holds until the next call.
  const CycleSnapshot& readSnapshot() { return snapshot_.read(); }
  /// What happened on the bus. One thread only.
  std::optional<BusEvent> pollBusEvent() noexcept { return bus_events_.pop(); }
  /// Before the first cycle, or after the last one; nullptr: nobody looks on. It must outlive the cycle.
  void setObserver(CycleObserver* observer) noexcept { observer_ = observer; }

  // The cycle's thread.
  const TwistCommand& newestBaseCommand() { return base_command_.read(); }
  const JointCommand& newestDriveCommand(DriveIndex drive) { return drive_commands_[drive]->read(); }
  const PositionCommand& newestPosition(DriveIndex drive) { return positions_[drive]->read(); }
  const WordCommands& newestWords(DriveIndex drive) { return words_[drive]->read(); }
  /// When a publisher of commands was connected last; {} while there was none.
  Instant newestCommander() { return commander_.read(); }
  const BaseTuning& newestBaseTuning() { return base_tuning_.read(); }
  std::optional<Request> pollRequest() noexcept { return requests_.pop(); }
  /// Comes out of `waitCompletion` once the next snapshot is published: who has an answer finds its effect there.
  void complete(const Completion& completion) noexcept;
  void observe(const std::vector<profile::ProcessOutput>& outputs, const std::vector<DriveExchange>& inputs,
               const CycleSnapshot& snapshot) noexcept {
    if (observer_ != nullptr) observer_->handleCycle(outputs, inputs, snapshot);
  }
  void publish(const CycleSnapshot& snapshot) noexcept;
  /// What nobody fetches in time is lost.
  void tell(const BusEvent& event) noexcept { bus_events_.push(event); }

 private:
  std::mutex writers_;  // several ROS threads may write; the cycle never takes it
  LatestValue<TwistCommand> base_command_;
  LatestValue<BaseTuning> base_tuning_;
  std::vector<std::unique_ptr<LatestValue<JointCommand>>> drive_commands_;
  std::vector<std::unique_ptr<LatestValue<PositionCommand>>> positions_;
  std::vector<PositionCommand> positions_written_;  // the writers'
  std::vector<std::unique_ptr<LatestValue<WordCommands>>> words_;
  std::vector<WordCommands> words_written_;  // the writers'
  LatestValue<Instant> commander_;
  std::optional<Instant> base_moved_;                 // the writers'
  std::vector<std::optional<Instant>> drives_moved_;  // the writers'
  EventRing<Request, 32> requests_;
  EventRing<Completion, 64> completions_;
  std::size_t unpublished_ = 0;  // completions in the ring that `completed_` does not count yet
  sem_t completed_;
  LatestValue<CycleSnapshot> snapshot_;
  EventRing<BusEvent, 256> bus_events_;
  CycleObserver* observer_ = nullptr;
};

}  // namespace nord_driver::cycle
