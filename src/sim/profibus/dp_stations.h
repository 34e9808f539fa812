// The PROFIBUS stations of a simulated robot and their referee: what sits on the segment beside the master.
#pragma once

#include <string>
#include <vector>

#include "nord_driver/core/bytes.h"
#include "sim/judge.h"
#include "sim/profibus/module_station.h"
#include "sim/profibus/referee.h"
#include "sim/robot/robot_sim.h"

namespace nord_driver::sim {

/// Takes the answers of the stations; whoever moves the bytes implements it.
class AnswerSink {
 public:
  virtual ~AnswerSink() = default;
  /// `delay`: how much later than usual this station answers. The sink tells when the answer got through
  /// (`DpStations::delivered()`).
  virtual void answer(const WireBytes& bytes, Duration delay) noexcept = 0;
};

/// Fed with the master's bytes and the time; opens nothing, waits for nothing, allocates nothing after construction.
class DpStations {
 public:
  /// Connects the drives of `robot`, each with a station of its own or behind the module with its address. `robot` must
  /// outlive it. Throws ConfigError when two drives share an address, or a place behind one module.
  explicit DpStations(RobotSim& robot);

  /// Lets stations and robot run up to `now` in steps of at most a millisecond; the first call sets the start.
  void advance(Instant now) noexcept;
  /// Bytes of the master, complete at `now`.
  void receive(ByteView bytes, Instant now, Judge judge, AnswerSink& sink) noexcept;
  /// What the master sent, when the line made something else of it.
  void judgeOnly(ByteView bytes) noexcept;
  /// Whether the master waits for an answer to this: not to what goes to all, or is sent without acknowledge (EN 50170, SDN).
  static bool isAnswered(ByteView request) noexcept;
  /// Forgets the beginning of a telegram whose rest never came.
  void forgetPartial() noexcept { input_.clear(); }
  bool hasPartial() const noexcept { return !input_.empty(); }
  /// An answer reached the master.
  void delivered(const WireBytes& bytes) noexcept;

  /// The station of drive `index`: its own, or the module it shares.
  DpStation& stationOf(std::size_t drive) noexcept { return *station_of_[drive]; }
  /// The modules with slots, in the order of the drives that name them first.
  const std::vector<ModuleStation*>& modules() const noexcept { return modules_; }
  ModuleStation& module(std::size_t index) noexcept { return *modules_[index]; }
  Referee& referee() noexcept { return referee_; }
  std::string report() const { return referee_.report(); }
  RobotSim& robot() noexcept { return robot_; }

 private:
  void connect(DriveUnit& drive);
  ModuleStation& moduleAt(std::uint8_t address);
  void step(Duration span) noexcept;

  RobotSim& robot_;
  Referee referee_;
  std::vector<DpStation*> stations_;  // the robot's, every one once
  std::vector<ModuleStation*> modules_;
  std::vector<DpStation*> station_of_;  // each drive's
  bool started_ = false;
  Instant now_{};
  FixedBytes<512> input_;
  Telegram telegram_;
};

}  // namespace nord_driver::sim
