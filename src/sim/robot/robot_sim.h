// The robot that is simulated: its drives, the bus modules they sit behind, and the body they move. What goes over the
// bus is the business of the stations in the folder of that bus.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nord_driver/core/time.h"
#include "sim/bus_module.h"
#include "sim/drive_unit.h"
#include "sim/robot/body.h"
#include "sim/sim_config.h"

namespace nord_driver::sim {

/// Fed with the time; opens nothing, waits for nothing, allocates nothing once its modules are there.
class RobotSim {
 public:
  /// Its drives are not connected yet: the stations of a bus do that.
  explicit RobotSim(const SimConfig& config);

  /// Lets drives and body run up to `now` in steps of at most a millisecond; the first call sets the start. The modules
  /// are advanced by the stations of their bus.
  void advance(Instant now) noexcept;
  /// Drives and body run on for `span`, a minute at most, in which no telegram could come: it is in no `now` and
  /// counts for no time-out. Wheels that turn do not wait for a bus.
  void runOnUnheard(Duration span) noexcept;

  /// Takes a module over, for as long as the robot lives.
  template <typename Module>
  Module& add(std::unique_ptr<Module> module) {
    Module& added = *module;
    modules_.push_back(std::move(module));
    return added;
  }

  std::vector<std::unique_ptr<DriveUnit>>& drives() noexcept { return drives_; }
  const std::vector<std::unique_ptr<DriveUnit>>& drives() const noexcept { return drives_; }
  DriveUnit& drive(std::size_t index) noexcept { return *drives_[index]; }
  /// Null when there is none of this name.
  DriveUnit* find(const std::string& name) noexcept;
  const std::vector<std::unique_ptr<BusModule>>& modules() const noexcept { return modules_; }
  /// Null when none is configured.
  const Body* body() const noexcept { return body_.get(); }
  const SimConfig& config() const noexcept { return config_; }

 private:
  void step(Duration span) noexcept;
  Wheels wheels(double (DriveUnit::*of)() const noexcept) const noexcept;
  Steering steering() const noexcept;

  SimConfig config_;
  std::vector<std::unique_ptr<DriveUnit>> drives_;
  std::vector<std::unique_ptr<BusModule>> modules_;
  std::unique_ptr<Body> body_;
  std::optional<Instant> now_;
};

}  // namespace nord_driver::sim
