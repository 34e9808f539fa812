// Callbacks with threads of their own: what waits elsewhere does not hold them up.
//
// Service calls wait for their drives, seconds sometimes. On roscpp's one queue a few of them take every thread there
// is, and a stop or a velocity command would wait behind them.
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <cstdint>

namespace nord_driver::node {

/// Must outlive what is subscribed and advertised with `handle()`.
class CallbackThreads {
 public:
  CallbackThreads(const ros::NodeHandle& handle, std::uint32_t threads) : handle_(handle), spinner_(threads, &queue_) {
    handle_.setCallbackQueue(&queue_);
  }

  /// What is subscribed or advertised with it is called by these threads.
  ros::NodeHandle& handle() noexcept { return handle_; }
  void start() { spinner_.start(); }
  void stop() { spinner_.stop(); }

 private:
  ros::NodeHandle handle_;
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
};

}  // namespace nord_driver::node
