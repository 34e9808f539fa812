#include "node/bus_publisher.h"

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <algorithm>
#include <utility>

namespace nord_driver::node {

BusPublisher::BusPublisher(ros::NodeHandle& private_node, std::vector<std::string> drive_names)
    : names_(std::move(drive_names)), publisher_(private_node.advertise<BusStatus>("bus_status", 1)) {}

void BusPublisher::publish(const cycle::CycleSnapshot& snapshot, ros::Time stamp) {
  BusStatus status;
  status.header.stamp = stamp;
  status.connected = snapshot.connected;
  status.cycle_time_min = snapshot.times.min;
  status.cycle_time_mean = snapshot.times.mean;
  status.cycle_time_p99 = snapshot.times.p99;
  status.cycle_time_max = snapshot.times.max;
  addCounters(snapshot.counters, status);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    (snapshot.drives[i].online ? status.online : status.offline).push_back(names_[i]);
  }
  status.text = busSentence(snapshot, names_);
  publisher_.publish(status);
}

void addCounters(const BusCounters& counters, BusStatus& status) {
  status.cycles = counters.value(bus_counter::kCycles);
  status.retries = counters.value(bus_counter::kRetries);
  status.timeouts = counters.value(bus_counter::kTimeouts);
  status.checksum_errors = counters.value(bus_counter::kChecksumErrors);
  status.parity_errors = counters.value(bus_counter::kParityErrors);
  status.overruns = counters.value(bus_counter::kOverruns);
  status.discarded_bytes = counters.value(bus_counter::kDiscardedBytes);
  status.unexpected = counters.value(bus_counter::kUnexpected);
  status.stale = counters.value(bus_counter::kStale);
  status.counters.reserve(counters.size());
  for (const NamedCounter& counter : counters) {
    status.counters.emplace_back();
    status.counters.back().name = counter.name;
    status.counters.back().value = counter.value;
    status.counters.back().meaning = counter.meaning;
  }
}

std::string busSentence(const cycle::CycleSnapshot& snapshot, const std::vector<std::string>& drive_names) {
  if (!snapshot.bus_text.empty()) return snapshot.bus_text.str();
  std::string silent;
  for (std::size_t i = 0; i < drive_names.size(); ++i) {
    const cycle::DriveSnapshot& drive = snapshot.drives[i];
    if (drive.online) continue;
    silent += (silent.empty() ? "drive " : "; drive ") + drive_names[i] + ": " +
              (drive.text.empty() ? "no answer" : drive.text.str());
  }
  return silent.empty() ? "all drives answer" : silent;
}

bool busIsWell(const cycle::CycleSnapshot& snapshot) {
  return snapshot.connected && snapshot.bus_text.empty() &&
         std::all_of(snapshot.drives.begin(), snapshot.drives.end(),
                     [](const cycle::DriveSnapshot& drive) { return drive.online; });
}

unsigned char busLevel(const cycle::CycleSnapshot& snapshot) {
  using diagnostic_msgs::DiagnosticStatus;
  if (!snapshot.connected) return DiagnosticStatus::ERROR;
  return busIsWell(snapshot) ? DiagnosticStatus::OK : DiagnosticStatus::WARN;
}

}  // namespace nord_driver::node
