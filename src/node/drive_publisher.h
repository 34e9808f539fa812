// Status and device information of one drive, from snapshots of the bus cycle.
#pragma once

#include <ros/ros.h>

#include <array>
#include <optional>
#include <string>

#include "catalogue/fault_words.h"
#include "cycle/cycle_config.h"
#include "cycle/snapshot.h"
#include "node/drive_protection.h"
#include "node/signal_publisher.h"
#include "node/stamps.h"
#include "nord_driver/DeviceInfo.h"
#include "nord_driver/DriveStatus.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::node {

class DrivePublisher {
 public:
  /// `private_node`: "~"; the topics are ~<drive>/status and ~<drive>/device_info.
  DrivePublisher(ros::NodeHandle& private_node, const cycle::DriveSetup& setup, DriveIdentity identity,
                 DriveProtection protection, catalogue::FaultWords faults, std::uint16_t address);

  /// Every fault stands in at least one message: one that rose and vanished since the last gets a message of its own.
  void publishStatus(const cycle::DriveSnapshot& drive, const Stamps& stamps);
  /// Latched, and published again only when it has changed. A drive that would run on when this computer dies, or
  /// stop late, is named in the log.
  void publishDeviceInfo(const cycle::DriveSnapshot& drive);

 private:
  void logProtection(const cycle::DeviceData& device);
  void logLeader(const cycle::DeviceData& device);
  void publishStatus(const cycle::DriveSample& sample, const cycle::DeviceData& device, ros::Time stamp);

  DriveIdentity identity_;
  DriveProtection protection_;
  catalogue::FaultWords faults_;
  SignalPublisher signals_;
  cycle::DriveSetup setup_;
  DriveStatus status_;
  DeviceInfo info_;
  ros::Publisher status_publisher_;
  ros::Publisher info_publisher_;
  std::array<std::optional<double>, 4> frequencies_;  // behind info_.max_frequency, whose NaN equals nothing
  std::uint64_t faults_told_ = 0;
  bool told_ = false;
  std::string protection_told_;
  std::string leader_told_;
};

}  // namespace nord_driver::node
