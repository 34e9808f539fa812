#include "node/snapshot_publisher.h"

#include <algorithm>
#include <utility>

namespace nord_driver::node {

namespace {

constexpr Duration kSecond = std::chrono::seconds{1};

/// The rate of the base may change at any time; 0 Hz is never, but a new rate is soon seen.
Duration basePeriod(const BasePublisher& base) {
  constexpr double kSlowest = 1e-6;  // Hz; below it is never, too: the period of 1e-200 Hz fits into no Duration
  const double rate = base.rate();
  return rate >= kSlowest ? seconds(1.0 / rate) : Duration::max();
}

/// True when `period` has passed since the last time; a late one is not caught up with.
bool isDue(Instant& next, Duration period, Instant now) {
  if (now < next) return false;
  next = std::max(next + period, now);
  return true;
}

}  // namespace

SnapshotPublisher::SnapshotPublisher(cycle::CyclePorts& ports, const PublishConfig& config, const SnapshotParts& parts,
                                     LoggedDrives logged)
    : ports_(ports),
      parts_(parts),
      status_period_(seconds(1.0 / config.status_rate)),
      log_(std::move(logged)),
      thread_([this] {
        try {
          run();
        } catch (const std::exception& error) {
          // Not let out of the thread: that would kill the node with its drives running.
          ROS_FATAL("nord_driver: publishing failed, the node ends: %s", error.what());
          healthy_ = false;
        }
      }) {}

SnapshotPublisher::~SnapshotPublisher() {
  stop_ = true;
  thread_.join();
}

void SnapshotPublisher::run() {
  Instant now = std::chrono::steady_clock::now();
  Instant next_base = now, next_status = now, next_second = now, stamped{};
  Stamps stamps{ros::Time{}, now};
  while (!stop_) {
    tellBusEvents();
    const cycle::CycleSnapshot& snapshot = ports_.readSnapshot();
    if (snapshot.time != Instant{}) {  // the first cycle has ended
      if (snapshot.time != stamped) {  // what is published twice has one stamp
        stamps = Stamps::sample();
        stamped = snapshot.time;
      }
      const ros::Time stamp = stamps.of(snapshot.time);
      const Duration base_period = basePeriod(parts_.base);
      if (base_period == Duration::max()) {
        next_base = now + seconds(0.1);
      } else {
        next_base = std::min(next_base, now + base_period);
        if (isDue(next_base, base_period, now)) parts_.base.publish(snapshot, stamp);
      }
      if (isDue(next_status, status_period_, now)) {
        for (std::size_t i = 0; i < parts_.drives.size(); ++i) {
          parts_.drives[i].publishStatus(snapshot.drives[i], stamps);
          parts_.drives[i].publishDeviceInfo(snapshot.drives[i]);
        }
      }
      if (isDue(next_second, kSecond, now)) {
        parts_.bus.publish(snapshot, stamp);
        for (std::size_t i = 0; i < parts_.values.size(); ++i) parts_.values[i].publish(snapshot.drives[i], stamp);
      }
      for (std::size_t i = 0; i < parts_.fault_messages.size(); ++i) {
        parts_.fault_messages[i].update(snapshot.drives[i], stamps);
      }
      parts_.process_data.publish();
      parts_.faults.post(snapshot);
      logChanges(snapshot, now);
      parts_.diagnostics.update(snapshot);
    }
    const Instant wake = std::min({std::max(next_base, now), std::max(next_status, now), now + seconds(0.1)});
    std::this_thread::sleep_until(std::max(wake, now + seconds(0.0005)));
    now = std::chrono::steady_clock::now();
  }
}

void SnapshotPublisher::tellBusEvents() {
  while (const auto event = ports_.pollBusEvent()) {
    if (event->warning) {
      ROS_WARN("nord_driver: %s", event->text.c_str());
    } else {
      ROS_INFO("nord_driver: %s", event->text.c_str());
    }
  }
}

void SnapshotPublisher::logChanges(const cycle::CycleSnapshot& snapshot, Instant now) {
  for (const LogLine& line : log_.poll(snapshot, now)) {
    switch (line.level) {
      case LogLine::Level::kInfo:
        ROS_INFO("nord_driver: %s", line.text.c_str());
        break;
      case LogLine::Level::kWarn:
        ROS_WARN("nord_driver: %s", line.text.c_str());
        break;
      case LogLine::Level::kError:
        ROS_ERROR("nord_driver: %s", line.text.c_str());
        break;
    }
  }
}

}  // namespace nord_driver::node
