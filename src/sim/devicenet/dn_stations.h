// The DeviceNet modules of a simulated robot and their referee: what sits on the CAN bus beside the scanner.
#pragma once

#include <string>
#include <vector>

#include "sim/can/can_participants.h"
#include "sim/devicenet/dn_module.h"
#include "sim/robot/robot_sim.h"

namespace nord_driver::sim {

class DnStations final : public CanParticipants {
 public:
  /// Connects the drives of `robot`, with one module for each MAC id of the configuration; the drives of a gateway
  /// share theirs. `robot` must outlive it.
  /// Throws ConfigError when two drives claim the same place.
  explicit DnStations(RobotSim& robot);

  void advance(Instant now, CanSink& sink) noexcept override;
  void receive(const CanFrame& frame, Judge judge, CanSink& sink) noexcept override;
  void givenAt(Instant when) noexcept override { referee_.givenAt(when); }
  bool isAnswered(const CanFrame& frame) const noexcept override;
  void judgeOnly(const CanFrame& frame) noexcept override { referee_.masterFrame(frame); }
  void delivered(const CanFrame& frame, bool to_master, CanSink& sink) noexcept override;
  void stoodStill() noexcept override;
  bool anyAlive() const noexcept override;
  std::size_t nodeCount() const noexcept override { return modules_.size(); }
  std::string report() const override { return referee_.report(); }

  const std::vector<DnModule*>& modules() const noexcept { return modules_; }
  /// The module behind which a drive (index in the configuration) sits.
  DnModule& moduleOf(std::size_t drive) noexcept { return *modules_[module_of_[drive]]; }

  DnReferee& referee() noexcept { return referee_; }
  RobotSim& robot() noexcept { return robot_; }

 private:
  RobotSim& robot_;
  DnReferee referee_;
  std::vector<DnModule*> modules_;  // the robot's
  std::vector<std::size_t> module_of_;
  bool started_ = false;
  Instant now_{};
};

}  // namespace nord_driver::sim
