// The CANopen nodes of a simulated robot and their referee: what sits on the CAN bus beside the master.
#pragma once

#include <string>
#include <vector>

#include "sim/can/can_participants.h"
#include "sim/canopen/can_node.h"
#include "sim/robot/robot_sim.h"

namespace nord_driver::sim {

class CanStations final : public CanParticipants {
 public:
  /// Connects the drives of `robot`, with one node for each node id of the configuration; the drives of a gateway share
  /// theirs. `robot` must outlive it.
  /// Throws ConfigError when two drives claim the same place.
  explicit CanStations(RobotSim& robot);

  void advance(Instant now, CanSink& sink) noexcept override;
  void receive(const CanFrame& frame, Judge judge, CanSink& sink) noexcept override;
  void judgeOnly(const CanFrame& frame) noexcept override { referee_.masterFrame(frame); }
  void delivered(const CanFrame& frame, bool to_master, CanSink& sink) noexcept override;
  void stoodStill() noexcept override;
  bool anyAlive() const noexcept override;
  std::size_t nodeCount() const noexcept override { return nodes_.size(); }
  std::string report() const override { return referee_.report(); }

  const std::vector<CanNode*>& nodes() const noexcept { return nodes_; }
  CanNode& node(std::size_t index) noexcept { return *nodes_[index]; }
  /// The node behind which a drive (index in the configuration) sits.
  CanNode& nodeOf(std::size_t drive) noexcept { return *nodes_[node_of_[drive]]; }
  /// Null when there is none.
  CanNode* find(std::uint8_t id) noexcept;

  CanReferee& referee() noexcept { return referee_; }
  RobotSim& robot() noexcept { return robot_; }

 private:
  RobotSim& robot_;
  CanReferee referee_;
  std::vector<CanNode*> nodes_;  // the robot's
  std::vector<std::size_t> node_of_;
  bool started_ = false;
  Instant now_{};
};

}  // namespace nord_driver::sim
