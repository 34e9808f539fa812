#include "node/signal_publisher.h"

#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>

#include "cycle/signal_values.h"

namespace nord_driver::node {

SignalPublisher::SignalPublisher(ros::NodeHandle& private_node, const cycle::DriveSetup& setup)
    : series_(setup.series) {
  for (const cycle::SignalSetup& signal : setup.words.signals) {
    if (cycle::isOutput(signal.source)) continue;
    const std::string topic = setup.name + "/signals/" + signal.name;
    const bool analogue = signal.source == cycle::SignalSource::kAnalogInput;
    signals_.push_back({signal,
                        analogue ? private_node.advertise<std_msgs::Float64>(topic, 10, true)
                                 : private_node.advertise<std_msgs::Bool>(topic, 10, true),
                        std::nullopt});
  }
}

void SignalPublisher::publish(const cycle::DriveSnapshot& drive) {
  for (Signal& signal : signals_) {
    const auto value = cycle::signalValue(signal.setup, series_, drive);
    if (!value || value == signal.told) continue;
    signal.told = value;
    if (signal.setup.source == cycle::SignalSource::kAnalogInput) {
      std_msgs::Float64 message;
      message.data = *value;
      signal.publisher.publish(message);
    } else {
      std_msgs::Bool message;
      message.data = *value != 0.0;
      signal.publisher.publish(message);
    }
  }
}

}  // namespace nord_driver::node
