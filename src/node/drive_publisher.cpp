#include "node/drive_publisher.h"

#include <limits>
#include <utility>

#include "cycle/leaders.h"
#include "cycle/measured_values.h"
#include "node/drive_status.h"
#include "profile/word_function.h"

namespace nord_driver::node {

namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// P707 holds the version times ten: 21 is V2.1 R3 with revision 3.
std::string versionText(const cycle::DeviceData& device) {
  if (!device.software_version) return "";
  std::string text =
      "V" + std::to_string(*device.software_version / 10) + "." + std::to_string(*device.software_version % 10);
  if (device.software_revision) text += " R" + std::to_string(*device.software_revision);
  return text;
}

}  // namespace

DrivePublisher::DrivePublisher(ros::NodeHandle& private_node, const cycle::DriveSetup& setup, DriveIdentity identity,
                               DriveProtection protection, catalogue::FaultWords faults, std::uint16_t address)
    : identity_(std::move(identity)),
      protection_(std::move(protection)),
      faults_(faults),
      signals_(private_node, setup),
      setup_(setup) {
  status_.name = setup.name;
  info_.name = setup.name;
  info_.series = profile::toString(setup.series);
  info_.address = address;
  info_.inverter = identity_.inverter;
  info_.rated_current = setup.rated_current.value_or(kNotKnown);
  info_.parameter_channel = identity_.parameter_channel;
  status_publisher_ = private_node.advertise<DriveStatus>(setup.name + "/status", 10);
  info_publisher_ = private_node.advertise<DeviceInfo>(setup.name + "/device_info", 1, true);
}

// The driver's own idle word can acknowledge a fault within one cycle (BU 0020 8), between two messages.
void DrivePublisher::publishStatus(const cycle::DriveSnapshot& drive, const Stamps& stamps) {
  if (hidesAFault(drive, faults_told_)) {
    publishStatus(drive.at_fault, drive.device, stamps.of(drive.at_fault.time));
  }
  faults_told_ = drive.faults;
  publishStatus(drive, drive.device, stamps.of(drive.time));
  signals_.publish(drive);
}

void DrivePublisher::publishStatus(const cycle::DriveSample& sample, const cycle::DeviceData& device, ros::Time stamp) {
  fillDriveStatus(sample, faults_, status_);
  status_.header.stamp = stamp;
  status_.current = cycle::currentOf(sample, device, setup_);
  status_publisher_.publish(status_);
}

// Once all that can be read has been read: before, "not known" would tell nothing.
void DrivePublisher::logProtection(const cycle::DeviceData& device) {
  if (!device.complete) return;
  const ProtectionReport report = protection_.assess(device);
  if (report.level == ProtectionReport::Level::kFine || report.text == protection_told_) return;
  protection_told_ = report.text;
  if (report.level == ProtectionReport::Level::kError) {
    ROS_ERROR("nord_driver: what stops drive %s if this computer dies: %s", info_.name.c_str(), report.text.c_str());
  } else {
    ROS_WARN("nord_driver: what stops drive %s if this computer dies: %s", info_.name.c_str(), report.text.c_str());
  }
}

// Known as soon as these parameters are; said anew when they have changed.
void DrivePublisher::logLeader(const cycle::DeviceData& device) {
  if (!device.complete) return;
  const std::string text = cycle::followsMessage(device, setup_.series).c_str();
  if (text == leader_told_) return;
  leader_told_ = text;
  if (text.empty()) {
    ROS_INFO("nord_driver: drive %s follows no other inverter any more", info_.name.c_str());
  } else if (setup_.follows.empty()) {
    ROS_WARN("nord_driver: drive %s follows another inverter, and is not enabled: %s", info_.name.c_str(),
             text.c_str());
  } else {
    ROS_INFO("nord_driver: drive %s follows drive %s: %s", info_.name.c_str(), setup_.follows.c_str(), text.c_str());
  }
}

void DrivePublisher::publishDeviceInfo(const cycle::DriveSnapshot& drive) {
  const cycle::DeviceData& device = drive.device;
  logProtection(device);
  logLeader(device);
  if (!device.complete && told_) return;
  DeviceInfo info = info_;
  info.ident = device.ident;
  info.software_version = versionText(device);
  info.protected_by = protection_.assess(device).text;
  info.follows = cycle::followsMessage(device, setup_.series).c_str();
  info.max_frequency.clear();
  for (std::size_t set = 0; set < device.max_frequency.size(); ++set) {
    // Where it cannot be read, what is configured is what the driver scales by.
    info.max_frequency.push_back(device.max_frequency[set].value_or(setup_.typed_max_frequency.value_or(kNotKnown)));
  }
  const cycle::WordFunctions& words = device.word_functions[0];
  info.setpoint_functions.assign(words.setpoints.begin(), words.setpoints.end());
  info.actual_value_functions.assign(words.actual_values.begin(), words.actual_values.end());
  info.setpoint_names.clear();
  info.actual_value_names.clear();
  for (std::size_t i = 0; i < info.setpoint_functions.size(); ++i) {
    info.setpoint_names.emplace_back(profile::setpointName(setup_.series, i + 1, info.setpoint_functions[i]));
  }
  for (const std::uint16_t function : info.actual_value_functions) {
    info.actual_value_names.emplace_back(profile::actualValueName(setup_.series, function));
  }
  const bool same = told_ && info.ident == info_.ident && info.protected_by == info_.protected_by &&
                    info.follows == info_.follows && info.software_version == info_.software_version &&
                    info.setpoint_functions == info_.setpoint_functions &&
                    info.actual_value_functions == info_.actual_value_functions && frequencies_ == device.max_frequency;
  if (same) return;
  info_ = info;
  frequencies_ = device.max_frequency;
  told_ = true;
  info_publisher_.publish(info_);
}

}  // namespace nord_driver::node
