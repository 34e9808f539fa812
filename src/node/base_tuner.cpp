#include "node/base_tuner.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::node {

namespace {

TuningConfig tuningOf(const NodeConfig& config) {
  const robot::BaseGeometry& geometry = config.cycle.base->geometry;
  TuningConfig tuning = TuningConfig::__getDefault__();  // the constructor leaves its group's fields open
  tuning.left_wheel_radius_multiplier = geometry.left_wheel_radius_multiplier;
  tuning.right_wheel_radius_multiplier = geometry.right_wheel_radius_multiplier;
  tuning.wheel_separation_multiplier = geometry.wheel_separation_multiplier;
  tuning.publish_rate = config.publish.publish_rate;
  tuning.enable_odom_tf = config.publish.enable_odom_tf;
  return tuning;
}

// The server lets values that are no numbers through its limits.
bool isFinite(const TuningConfig& tuning) {
  return std::isfinite(tuning.left_wheel_radius_multiplier) && std::isfinite(tuning.right_wheel_radius_multiplier) &&
         std::isfinite(tuning.wheel_separation_multiplier) && std::isfinite(tuning.publish_rate);
}

}  // namespace

BaseTuner::BaseTuner(ros::NodeHandle& private_node, const NodeConfig& config, cycle::CyclePorts& ports,
                     BasePublisher& publisher)
    : ports_(ports), publisher_(publisher), taken_(tuningOf(config)), server_(mutex_, private_node) {
  const boost::recursive_mutex::scoped_lock lock(mutex_);
  server_.setConfigDefault(taken_);
  offerRanges();
  server_.updateConfig(taken_);
  server_.setCallback([this](TuningConfig& wanted, std::uint32_t) { take(wanted); });
}

// What diff_drive_controller offers for the multipliers, made wide enough for what is configured.
void BaseTuner::offerRanges() {
  TuningConfig low, high;
  server_.getConfigMin(low);
  server_.getConfigMax(high);
  const auto offer = [&](double TuningConfig::*multiplier) {
    low.*multiplier = std::min(0.5, taken_.*multiplier);
    high.*multiplier = std::max(1.5, taken_.*multiplier);
  };
  offer(&TuningConfig::left_wheel_radius_multiplier);
  offer(&TuningConfig::right_wheel_radius_multiplier);
  offer(&TuningConfig::wheel_separation_multiplier);
  server_.setConfigMin(low);
  server_.setConfigMax(high);
}

void BaseTuner::take(TuningConfig& wanted) {
  if (!isFinite(wanted)) {
    ROS_WARN("nord_driver: dynamic_reconfigure was given a value that is not a number or infinite, ignored");
    wanted = taken_;
    return;
  }
  taken_ = wanted;
  cycle::BaseTuning tuning;
  tuning.left_wheel_radius_multiplier = wanted.left_wheel_radius_multiplier;
  tuning.right_wheel_radius_multiplier = wanted.right_wheel_radius_multiplier;
  tuning.wheel_separation_multiplier = wanted.wheel_separation_multiplier;
  tuning.given = true;
  ports_.tuneBase(tuning);
  publisher_.setRate(wanted.publish_rate);
  publisher_.setOdomTf(wanted.enable_odom_tf);
}

}  // namespace nord_driver::node
