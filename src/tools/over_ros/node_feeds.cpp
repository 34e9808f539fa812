#include "tools/over_ros/node_feeds.h"

#include <ros/node_handle.h>

#include <algorithm>
#include <boost/function.hpp>
#include <chrono>
#include <cstddef>

#include "tools/drive_parameters.h"

namespace nord_driver::tools {

namespace {

// Not by ros::Time, which may stand still (/use_sim_time).
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kFirst{11};  // status_rate may be 0.1 Hz
const ros::WallDuration kSlice{0.05};

template <typename Message, typename Take>
ros::Subscriber listen(ros::CallbackQueue& queue, const std::string& topic, std::uint32_t depth, Take take) {
  ros::NodeHandle handle;
  handle.setCallbackQueue(&queue);
  const boost::function<void(const boost::shared_ptr<const Message>&)> callback = take;
  return handle.subscribe<Message>(topic, depth, callback);
}

template <typename Words, typename Values>
void copyWords(const Words& from, Values& to) {
  std::copy_n(from.begin(), std::min(from.size(), to.size()), to.begin());
}

LiveStatus statusOf(const DriveStatus& told) {
  LiveStatus status;
  status.online = told.online != 0;
  status.output.control_word = told.control_word;
  copyWords(told.setpoints, status.output.setpoints);
  status.input.status_word = told.status_word;
  copyWords(told.actual_values, status.input.actual_values);
  status.frequency = told.frequency;
  status.fault_number = told.fault_number;
  status.fault_text = told.fault_text;
  return status;
}

LiveCycle cycleOf(const ProcessData& told) {
  LiveCycle cycle;
  cycle.number = told.cycle;
  cycle.sample.time = told.time;
  cycle.sample.answered = told.answered != 0;
  cycle.sample.output.control_word = told.control_word;
  copyWords(told.setpoints, cycle.sample.output.setpoints);
  cycle.sample.input.status_word = told.status_word;
  copyWords(told.actual_values, cycle.sample.input.actual_values);
  return cycle;
}

}  // namespace

NodeStatusFeed::NodeStatusFeed(const std::string& node, const std::string& drive)
    : topic_(node + "/" + drive + "/status"), life_(node) {
  subscriber_ = listen<DriveStatus>(queue_, topic_, 1, [this](const DriveStatus::ConstPtr& told) {
    newest_ = statusOf(*told);
    life_.heard();
  });
  const Clock::time_point end = Clock::now() + kFirst;
  while (!newest_ && Clock::now() < end) queue_.callAvailable(kSlice);
  if (!newest_) throw Trouble("nothing comes on " + topic_ + ": is it a nord_driver_node, and has it this drive?");
}

LiveStatus NodeStatusFeed::newest() {
  queue_.callAvailable();
  life_.check(subscriber_.getNumPublishers() > 0);
  return *newest_;
}

NodeCycleFeed::NodeCycleFeed(const std::string& node, const std::string& drive)
    : topic_(node + "/" + drive + "/process_data"), life_(node) {
  subscriber_ = listen<ProcessData>(queue_, topic_, 0, [this](const ProcessData::ConstPtr& told) {
    cycles_.push_back(cycleOf(*told));
    life_.heard();
  });
  const Clock::time_point end = Clock::now() + kFirst;
  while (cycles_.empty() && Clock::now() < end) queue_.callAvailable(kSlice);
  if (cycles_.empty())
    throw Trouble("nothing comes on " + topic_ + ": is it a nord_driver_node, and has it this drive?");
}

std::vector<LiveCycle> NodeCycleFeed::take() {
  queue_.callAvailable(kSlice);
  life_.check(subscriber_.getNumPublishers() > 0);
  std::vector<LiveCycle> taken;
  taken.swap(cycles_);
  return taken;
}

}  // namespace nord_driver::tools
