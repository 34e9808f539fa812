// The bus as a whole, once a second.
#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "cycle/snapshot.h"
#include "nord_driver/BusStatus.h"

namespace nord_driver::node {

/// One sentence for a technician: what the bus waits for, or that all is well.
std::string busSentence(const cycle::CycleSnapshot& snapshot, const std::vector<std::string>& drive_names);

/// False when that sentence is of trouble. A bus that is lost is trouble before its drives are: they count as online
/// until drive_timeout has passed.
bool busIsWell(const cycle::CycleSnapshot& snapshot);

/// Of the sentence in /diagnostics, one of diagnostic_msgs::DiagnosticStatus: ERROR while the bus is lost, WARN for any
/// other trouble, as in the log.
unsigned char busLevel(const cycle::CycleSnapshot& snapshot);

/// All of them by name, and those that have a field of their own there, too.
void addCounters(const BusCounters& counters, BusStatus& status);

class BusPublisher {
 public:
  BusPublisher(ros::NodeHandle& private_node, std::vector<std::string> drive_names);
  void publish(const cycle::CycleSnapshot& snapshot, ros::Time stamp);
  std::string sentence(const cycle::CycleSnapshot& snapshot) const { return busSentence(snapshot, names_); }

 private:
  std::vector<std::string> names_;
  ros::Publisher publisher_;
};

}  // namespace nord_driver::node
