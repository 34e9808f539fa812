// The publishing thread: takes the newest snapshot of the bus cycle and publishes each part of it at its own rate.
#pragma once

#include <atomic>
#include <thread>
#include <vector>

#include "cycle/cycle_ports.h"
#include "node/base_publisher.h"
#include "node/bus_publisher.h"
#include "node/diagnostics.h"
#include "node/drive_publisher.h"
#include "node/fault_board.h"
#include "node/fault_publisher.h"
#include "node/node_config.h"
#include "node/process_data_publisher.h"
#include "node/state_log.h"
#include "node/values_publisher.h"

namespace nord_driver::node {

/// Who makes what of a snapshot; all outlive the thread.
struct SnapshotParts {
  BasePublisher& base;
  std::vector<DrivePublisher>& drives;
  std::vector<ValuesPublisher>& values;
  std::vector<FaultPublisher>& fault_messages;
  ProcessDataPublisher& process_data;
  BusPublisher& bus;
  Diagnostics& diagnostics;
  FaultBoard& faults;
};

/// Publishes from construction to destruction, and writes into the log what happened on the bus. The rates run on the steady clock, so that /use_sim_time cannot stop
/// them; only the stamps are ROS time: of the bus cycle that measured.
class SnapshotPublisher {
 public:
  SnapshotPublisher(cycle::CyclePorts& ports, const PublishConfig& config, const SnapshotParts& parts,
                    LoggedDrives logged);
  ~SnapshotPublisher();
  SnapshotPublisher(const SnapshotPublisher&) = delete;
  SnapshotPublisher& operator=(const SnapshotPublisher&) = delete;

  /// False when publishing has failed for good.
  bool healthy() const noexcept { return healthy_; }

 private:
  void run();
  void tellBusEvents();
  void logChanges(const cycle::CycleSnapshot& snapshot, Instant now);

  cycle::CyclePorts& ports_;
  SnapshotParts parts_;
  Duration status_period_;
  StateLog log_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> healthy_{true};
  std::thread thread_;
};

}  // namespace nord_driver::node
