#include "node/process_data_publisher.h"

#include <algorithm>

#include "node/stamps.h"

namespace nord_driver::node {

namespace {

constexpr std::uint32_t kQueue = 2000;  // messages to one listener; what is published at once is a tenth of a second

void fill(const trace::ProcessDataRecord& record, const Stamps& stamps, ProcessData& message) {
  message.cycle = record.cycle;
  message.stamp = stamps.of(record.time);
  message.time = toSeconds(record.time.time_since_epoch());
  message.answered = record.answered;
  message.control_word = record.output.control_word;
  message.setpoints.assign(record.output.setpoints.begin(), record.output.setpoints.end());
  message.status_word = record.input.status_word;
  message.actual_values.assign(record.input.actual_values.begin(), record.input.actual_values.end());
}

}  // namespace

ProcessDataPublisher::ProcessDataPublisher(ros::NodeHandle& private_node, const std::vector<std::string>& drives,
                                           const trace::ProcessDataHistory& history)
    : history_(history) {
  for (const std::string& drive : drives) {
    publishers_.push_back(private_node.advertise<ProcessData>(drive + "/process_data", kQueue));
  }
}

void ProcessDataPublisher::publish() {
  const std::uint64_t end = history_.cycles();
  const bool heard = std::any_of(publishers_.begin(), publishers_.end(),
                                 [](const ros::Publisher& publisher) { return publisher.getNumSubscribers() > 0; });
  if (heard) {
    const Stamps stamps = Stamps::sample();  // not before any of these cycles
    for (; next_ < end; ++next_) {
      for (std::size_t drive = 0; drive < publishers_.size(); ++drive) {
        if (publishers_[drive].getNumSubscribers() == 0) continue;
        const auto record = history_.at(next_, drive);
        if (!record) continue;
        fill(*record, stamps, message_);
        publishers_[drive].publish(message_);
      }
    }
  }
  next_ = end;
}

}  // namespace nord_driver::node
