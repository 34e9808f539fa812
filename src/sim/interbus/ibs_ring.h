// The simulated InterBus ring: its subscribers, and the master in the gateway that moves their words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/interbus/ibs_module.h"
#include "sim/robot/robot_sim.h"

namespace nord_driver::sim {

/// The words of all drives, as the gateway's master has them. Fed with the time; opens nothing.
class IbsRing {
 public:
  /// Connects the drives of `robot`, in the order of their addresses. `robot` must outlive it. Throws ConfigError where
  /// words overlap or do not fit into 256.
  explicit IbsRing(RobotSim& robot);

  /// Drives and ring run up to `now`.
  void advance(Instant now) noexcept;

  /// The ring runs: words move. It stands while a subscriber has no power or begins anew, or has another length or ID
  /// code than the master knows; then the inputs stay as they were.
  bool runs() const noexcept { return runs_; }
  /// Another one commands the drives from here on, or nobody.
  void masterBegins() noexcept;
  /// A cut cable: the ring stands until it is whole again.
  void setCut(bool cut) noexcept { cut_ = cut; }
  /// BU 0070 4.3 and the usual formula: 0.2 ms + (13 * (6 + bytes) + 1.5 * subscribers) bits at 500 kBd.
  Duration cycleTime() const noexcept { return cycle_time_; }
  std::uint64_t cycles() const noexcept { return cycles_; }

  std::vector<Word>& outputs() noexcept { return outputs_; }
  const std::vector<Word>& outputs() const noexcept { return outputs_; }
  const std::vector<Word>& inputs() const noexcept { return inputs_; }

  RobotSim& robot() noexcept { return robot_; }
  IbsModule& module(std::size_t drive) noexcept { return *subscribers_[of_drive_[drive]].module; }
  /// How many drives stand before this one in the ring.
  std::size_t placeOf(std::size_t drive) const noexcept { return of_drive_[drive]; }
  /// "no rule broken", or which.
  std::string report() const;

 private:
  struct Subscriber {
    IbsModule* module = nullptr;
    std::string name;
    std::size_t input = 0;  // of its first word behind the PCP word
    std::size_t output = 0;
    std::size_t words = 2;
  };

  void layOut(bool pcp_word);
  void cycle() noexcept;
  bool mayRun() const noexcept;

  RobotSim& robot_;
  std::vector<Subscriber> subscribers_;  // in the order of the ring
  std::vector<std::size_t> of_drive_;
  std::vector<Word> outputs_, inputs_;
  Duration cycle_time_{};
  bool started_ = false;
  bool runs_ = false;
  bool cut_ = false;
  Instant now_{}, next_cycle_{}, may_start_{};
  std::uint64_t cycles_ = 0;
};

}  // namespace nord_driver::sim
