// When something was measured, in ROS time: what is published is stamped with that, not with its publishing.
#pragma once

#include <ros/time.h>

#include "nord_driver/core/time.h"

namespace nord_driver::node {

/// Both clocks at one moment. Under /use_sim_time simulated and real seconds count alike within the short age of a
/// measurement.
class Stamps {
 public:
  Stamps(ros::Time ros_now, Instant steady_now) : ros_now_(ros_now), steady_now_(steady_now) {}
  /// Of now.
  static Stamps sample();

  /// ROS time of a moment on the steady clock. Never after the moment of the sample, never before ROS time 0.
  ros::Time of(Instant moment) const;

 private:
  ros::Time ros_now_;
  Instant steady_now_;
};

}  // namespace nord_driver::node
