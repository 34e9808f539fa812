// The trace as ROS sees it: the service ~write_trace, and a thread that writes one with each fault.
#pragma once

#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "nord_driver/trace/telegram_trace.h"
#include "trace/fault_tracer.h"
#include "trace/trace_config.h"
#include "trace/trace_feed.h"
#include "trace/trace_writer.h"

namespace nord_driver::node {

/// From construction to destruction. Without a directory only the service writes, into the home of ROS.
class Tracing {
 public:
  /// `telegrams` (nullptr: none) must outlive it.
  Tracing(ros::NodeHandle& private_node, const trace::TraceConfig& config,
          const std::vector<trace::TracedDrive>& drives, const TelegramTrace* telegrams);
  ~Tracing();
  Tracing(const Tracing&) = delete;
  Tracing& operator=(const Tracing&) = delete;

  /// What the bus cycle fills.
  trace::TraceFeed& feed() noexcept { return feed_; }

 private:
  void run();
  void answer(std_srvs::Trigger::Response& response);
  void log(const trace::TraceResult& result);

  trace::TraceFeed feed_;
  std::unique_ptr<trace::TraceWriter> writer_;
  std::unique_ptr<trace::FaultTracer> tracer_;  // with a directory
  std::string by_hand_;                         // the directory without one
  std::string told_;                            // an unusable directory is named once, not with every fault
  ros::ServiceServer server_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace nord_driver::node
