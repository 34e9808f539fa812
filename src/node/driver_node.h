// The driver as a ROS node: configuration in, topics and services out, the bus cycle in a thread of its own.
#pragma once

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <array>
#include <atomic>
#include <deque>
#include <memory>
#include <optional>
#include <pluginlib/class_loader.hpp>
#include <vector>

#include "catalogue/drive_catalogue.h"
#include "cycle/bus_cycle.h"
#include "cycle/cycle_ports.h"
#include "cycle/cycle_thread.h"
#include "node/base_publisher.h"
#include "node/base_tuner.h"
#include "node/bus_publisher.h"
#include "node/callback_threads.h"
#include "node/diagnostics.h"
#include "node/drive_publisher.h"
#include "node/fault_board.h"
#include "node/fault_publisher.h"
#include "node/ignored_commands.h"
#include "node/node_config.h"
#include "node/nothing_to_tune.h"
#include "node/parameter_jobs.h"
#include "node/process_data_publisher.h"
#include "node/request_broker.h"
#include "node/ros_settings.h"
#include "node/services.h"
#include "node/snapshot_publisher.h"
#include "node/tracing.h"
#include "node/values_publisher.h"
#include "node/word_topics.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::node {

/// Reads and checks the whole configuration before anything is advertised. Throws ConfigError.
class DriverNode {
 public:
  DriverNode();
  ~DriverNode();
  DriverNode(const DriverNode&) = delete;
  DriverNode& operator=(const DriverNode&) = delete;

  /// Publishes until `end_asked` or ROS shuts down, then brings the drives to rest and ends the exchange.
  void run(const std::atomic<bool>& end_asked);

 private:
  /// All that have threads of their own.
  std::array<CallbackThreads*, 6> lanes() noexcept;
  void loadTransport();
  /// Looks up what drives/<name>/monitor lists; the transport is configured.
  void lookUpMonitored();
  void warnOfUnknownKeys() const;
  void advertise();
  void takeCommand(const geometry_msgs::Twist& twist);
  void subscribeCommand(DriveIndex drive);
  void subscribePosition(DriveIndex drive);
  /// `what`: "position command"; `taken`: by its port.
  void countBadCommand(DriveIndex drive, const char* what, double command, bool taken);
  /// Whoever publishes commands and has just been connected is listened to before anything is enabled.
  void noteCommanders();
  void bringToRest();
  /// A RAM write that is under way has P560 = 0; nobody reads the snapshots any more.
  void putEepromSwitchesBack();
  LoggedDrives loggedDrives() const;
  /// What is known of each drive; the transport is configured.
  std::vector<catalogue::DriveCatalogue> knownDrives() const;

  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  CallbackThreads commands_;          // cmd_vel
  CallbackThreads private_commands_;  // ~<drive>/command
  CallbackThreads jobs_;              // ~<drive>/dump_parameters, ~<drive>/verify_parameters
  RosSettings settings_;
  NodeConfig config_;
  CallbackThreads enabling_;     // ~enable and ~<drive>/enable, which stop, too
  CallbackThreads quick_stops_;  // ~quick_stop and ~<drive>/quick_stop
  CallbackThreads homing_;       // ~<drive>/home
  catalogue::Catalogues catalogues_;
  pluginlib::ClassLoader<Transport> loader_;
  boost::shared_ptr<Transport> transport_;
  std::string where_;  // what the transport opens, as configured
  std::vector<DriveIdentity> identities_;
  std::vector<catalogue::DriveCatalogue> known_;  // one per drive
  std::vector<catalogue::FaultWords> faults_;     // one per drive
  std::vector<DriveValues> values_;               // one per drive
  std::unique_ptr<FaultBoard> fault_board_;
  state::EepromBudget eeprom_budget_;
  std::deque<state::DriveEeprom> eeproms_;  // one per drive

  IgnoredCommands ignored_;
  LogPause publishers_told_;
  std::unique_ptr<cycle::CyclePorts> ports_;
  std::unique_ptr<cycle::BusCycle> cycle_;
  std::unique_ptr<cycle::CycleThread> thread_;
  std::unique_ptr<RequestBroker> broker_;

  std::unique_ptr<BasePublisher> base_publisher_;
  std::unique_ptr<BaseTuner> base_tuner_;           // with a base that has sides
  std::unique_ptr<NothingToTune> nothing_to_tune_;  // without one
  std::vector<DrivePublisher> drive_publishers_;
  std::vector<ValuesPublisher> values_publishers_;
  std::vector<FaultPublisher> fault_publishers_;
  std::unique_ptr<BusPublisher> bus_publisher_;
  std::unique_ptr<Diagnostics> diagnostics_;
  std::unique_ptr<Services> services_;
  std::unique_ptr<ParameterJobs> parameter_jobs_;
  std::unique_ptr<WordTopics> word_topics_;
  std::unique_ptr<Tracing> tracing_;
  std::unique_ptr<ProcessDataPublisher> process_data_publisher_;  // reads what tracing_ keeps
  std::optional<SnapshotPublisher> publisher_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Subscriber command_subscriber_;
  std::uint32_t commanders_ = 0;  // publishers connected to all of these
};

}  // namespace nord_driver::node
