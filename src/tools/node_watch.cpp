#include "tools/node_watch.h"

namespace nord_driver::tools {

namespace {

constexpr std::uint16_t kNotKnown = 65535;  // DriveStatus.fault_number

std::vector<const catalogue::DriveCatalogue*> knownOf(const std::vector<DriveDescription>& drives) {
  std::vector<const catalogue::DriveCatalogue*> known;
  known.reserve(drives.size());
  for (const DriveDescription& drive : drives) known.push_back(&drive.known);
  return known;
}

std::string faultOf(const LiveStatus& status, const catalogue::DriveCatalogue& known) {
  if (status.fault_number == 0) return "none";
  if (status.fault_number == kNotKnown) return "its number is not known";
  const std::string& name = status.fault_text.empty() ? known.faults().name(status.fault_number) : status.fault_text;
  return catalogue::FaultWords::label(status.fault_number) + " " + name;
}

}  // namespace

NodeWatch::NodeWatch(DriveNodes& nodes, const std::string& node, const std::vector<DriveDescription>& drives,
                     const std::vector<std::string>& parameters)
    : list_(parameters, knownOf(drives)) {
  for (const DriveDescription& drive : drives) {
    Watched watched{drive, nodes.statusOf(node, drive.name), nullptr};
    if (!parameters.empty()) watched.parameters = nodes.open(node, drive);
    drives_.push_back(std::move(watched));
  }
}

std::vector<WatchedDrive> NodeWatch::look() {
  std::vector<WatchedDrive> seen;
  seen.reserve(drives_.size());
  for (std::size_t i = 0; i < drives_.size(); ++i) seen.push_back(look(drives_[i], list_.of(i)));
  return seen;
}

WatchedDrive NodeWatch::look(Watched& watched, const std::vector<catalogue::ParameterAddress>& addresses) {
  WatchedDrive seen;
  seen.name = watched.drive.name;
  seen.process_values = watched.drive.identity.process_values;
  seen.values.assign(addresses.size(), "not read");
  // Of a drive that is gone the node would wait for every answer.
  if (watched.status->newest().online) {
    for (std::size_t i = 0; i < addresses.size(); ++i) {
      seen.values[i] = answerCell(addresses[i], watched.parameters->read(addresses[i]), watched.drive.known);
    }
  }
  const LiveStatus now = watched.status->newest();  // not older than what was read
  seen.online = now.online;
  seen.output = now.output;
  seen.input = now.input;
  seen.fault = faultOf(now, watched.drive.known);
  if (!seen.online) {
    seen.silence = "the node has no fresh process data of it";
  } else if (seen.process_values > 0) {
    seen.frequency = now.frequency;
  }
  return seen;
}

}  // namespace nord_driver::tools
