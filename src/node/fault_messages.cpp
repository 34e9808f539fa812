#include "node/fault_messages.h"

#include <utility>

#include "node/remembered_fault.h"

namespace nord_driver::node {

namespace {

/// Of a fault that stands, or of one that is latched still; 0: there is none.
std::uint16_t numberOf(const cycle::DriveSnapshot& drive) {
  if (drive.fault_number != 0) return drive.fault_number;
  return drive.fault_latched ? drive.last_fault_number : std::uint16_t{0};
}

std::string textOf(const catalogue::FaultWords& words, std::uint16_t number) {
  const std::string label = catalogue::FaultWords::label(number);
  const std::string& name = words.name(number);
  return label == name ? label : label + ", " + name;
}

}  // namespace

FaultMessages::FaultMessages(std::string drive, catalogue::FaultWords words)
    : drive_(std::move(drive)), words_(words) {}

std::vector<Fault> FaultMessages::poll(const cycle::DriveSnapshot& drive, const Stamps& stamps) {
  std::vector<Fault> due;
  const Told now{drive.faults, numberOf(drive), drive.fault, drive.fault_history.asked};
  const Told before = std::exchange(told_, now);
  if (now.faults != before.faults) {
    begin(drive, stamps);
    due.push_back(fault(drive, now.number != 0 ? now.number : drive.last_fault_number));
    if (now.number == 0) due.push_back(noFault(stamps.of(drive.time)));
  } else if (now.number == 0) {
    if (before.number != 0 || (drive.online && !met_)) due.push_back(noFault(stamps.of(drive.time)));
  } else if (now.number != before.number || now.active != before.active || now.history != before.history) {
    due.push_back(fault(drive, now.number));
  }
  met_ = met_ || drive.online;
  return due;
}

void FaultMessages::begin(const cycle::DriveSnapshot& drive, const Stamps& stamps) {
  begun_ = {};
  begun_.name = drive_;
  begun_.header.stamp = stamps.of(drive.at_fault.time);
  for (const cycle::CycleData& cycle : drive.fault_record) {
    ProcessData data;
    data.stamp = stamps.of(cycle.time);
    data.time = toSeconds(cycle.time.time_since_epoch());
    data.answered = cycle.answered;
    data.control_word = cycle.output.control_word;
    data.setpoints.assign(cycle.output.setpoints.begin(), cycle.output.setpoints.end());
    data.status_word = cycle.input.status_word;
    data.actual_values.assign(cycle.input.actual_values.begin(), cycle.input.actual_values.end());
    begun_.process_data.push_back(data);
  }
}

Fault FaultMessages::fault(const cycle::DriveSnapshot& drive, std::uint16_t number) const {
  Fault message = begun_;
  message.number = number;
  message.active = drive.fault;
  message.text = textOf(words_, number) + rememberedFault(drive, number, words_);
  message.cause = words_.cause(number);
  message.remedy = words_.remedy(number);
  for (const std::uint16_t past : drive.fault_history.numbers) {
    if (!drive.fault_history.asked) break;
    message.history_numbers.push_back(past);
    message.history.push_back(textOf(words_, past));
  }
  return message;
}

Fault FaultMessages::noFault(ros::Time stamp) const {
  Fault message;
  message.header.stamp = stamp;
  message.name = drive_;
  message.text = textOf(words_, 0);
  return message;
}

}  // namespace nord_driver::node
