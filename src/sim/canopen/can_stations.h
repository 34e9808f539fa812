// The CANopen nodes of a simulated robot and their referee: what sits on the CAN bus beside the master.
#pragma once

#include <vector>

#include "sim/canopen/can_node.h"
#include "sim/judge.h"
#include "sim/robot/robot_sim.h"

namespace nord_driver::sim {

class CanStations {
 public:
  /// Connects the drives of `robot`, with one node for each node id of the configuration; the drives of a gateway share
  /// theirs. `robot` must outlive it.
  /// Throws ConfigError when two drives claim the same place.
  explicit CanStations(RobotSim& robot);

  /// Lets robot and nodes run up to `now` in steps of at most a millisecond; the first call sets the start.
  void advance(Instant now, CanSink& sink) noexcept;
  /// A frame that reached the nodes at the time of the last `advance()`. `Judge::kYes`: it is the master's, unspoilt.
  void receive(const CanFrame& frame, Judge judge, CanSink& sink) noexcept;
  /// A frame of a node reached the others, and perhaps the master.
  void delivered(const CanFrame& frame, bool to_master, CanSink& sink) noexcept;
  /// The nodes were kept from running, for so long that the master may take them for lost and begin anew with each.
  void stoodStill() noexcept;

  bool anyAlive() const noexcept;
  std::size_t nodeCount() const noexcept { return nodes_.size(); }
  const std::vector<CanNode*>& nodes() const noexcept { return nodes_; }
  CanNode& node(std::size_t index) noexcept { return *nodes_[index]; }
  /// The node behind which a drive (index in the configuration) sits.
  CanNode& nodeOf(std::size_t drive) noexcept { return *nodes_[node_of_[drive]]; }
  /// Null when there is none.
  CanNode* find(std::uint8_t id) noexcept;

  CanReferee& referee() noexcept { return referee_; }
  std::string report() const { return referee_.report(); }
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
