// Everything on one simulated segment: the drives, the robot they move, and the referee.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"
#include "sim/drive_unit.h"
#include "sim/profibus/referee.h"
#include "sim/robot/body.h"
#include "sim/sim_config.h"

namespace nord_driver::sim {

/// Takes the answers of the stations; whoever moves the bytes implements it.
class AnswerSink {
 public:
  virtual ~AnswerSink() = default;
  /// `delay`: how much later than usual this station answers. The sink tells the referee when the answer got through
  /// (`RobotSim::delivered()`).
  virtual void answer(const WireBytes& bytes, Duration delay) noexcept = 0;
};

/// Whether the referee sees what is received.
enum class Judge : std::uint8_t { kNo, kYes };

/// Fed with the master's bytes and the time; opens nothing, waits for nothing, allocates nothing after construction.
class RobotSim {
 public:
  /// Throws ConfigError when two drives share an address, or a place behind one module.
  explicit RobotSim(const SimConfig& config);

  /// Lets the models run up to `now`; the first call sets the start.
  void advance(Instant now) noexcept;
  /// Bytes of the master, complete at `now`.
  void receive(ByteView bytes, Instant now, Judge judge, AnswerSink& sink) noexcept;
  /// What the master sent, when the line made something else of it.
  void judgeOnly(ByteView bytes) noexcept;
  /// Forgets the beginning of a telegram whose rest never came.
  void forgetPartial() noexcept { input_.clear(); }
  bool hasPartial() const noexcept { return !input_.empty(); }
  /// An answer reached the master.
  void delivered(const WireBytes& bytes) noexcept;

  std::vector<std::unique_ptr<DriveUnit>>& drives() noexcept { return drives_; }
  const std::vector<std::unique_ptr<DriveUnit>>& drives() const noexcept { return drives_; }
  DriveUnit& drive(std::size_t index) noexcept { return *drives_[index]; }
  /// Null when there is none of this name.
  DriveUnit* find(const std::string& name) noexcept;
  /// The modules with slots, in the order of the drives that name them first.
  std::vector<std::unique_ptr<ModuleStation>>& modules() noexcept { return modules_; }
  ModuleStation& module(std::size_t index) noexcept { return *modules_[index]; }
  Referee& referee() noexcept { return referee_; }
  const Referee& referee() const noexcept { return referee_; }
  /// Null when none is configured.
  const Body* body() const noexcept { return body_.get(); }
  const SimConfig& config() const noexcept { return config_; }

 private:
  void addDrive(const DriveConfig& config);
  ModuleStation& moduleAt(std::uint8_t address);
  void step(Duration span) noexcept;
  Wheels wheels(double (DriveUnit::*of)() const noexcept) const noexcept;

  SimConfig config_;
  Referee referee_;
  std::vector<std::unique_ptr<ModuleStation>> modules_;
  std::vector<std::unique_ptr<DriveUnit>> drives_;
  std::vector<DpStation*> stations_;  // every one once
  std::unique_ptr<Body> body_;
  std::optional<Instant> now_;
  FixedBytes<512> input_;
  Telegram telegram_;
};

}  // namespace nord_driver::sim
