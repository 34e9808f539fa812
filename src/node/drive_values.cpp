#include "node/drive_values.h"

#include <limits>
#include <utility>

namespace nord_driver::node {

namespace {

std::string whyNotKnown(const cycle::DriveSnapshot& drive, const cycle::MonitoredValue& read) {
  if (!drive.online) return "the drive does not answer";
  return read.state == cycle::MonitoredValue::State::kNotRead ? "not read yet" : read.why.str();
}

}  // namespace

DriveValues::DriveValues(catalogue::DriveCatalogue known, std::vector<tools::MonitoredParameter> parameters)
    : known_(known), parameters_(std::move(parameters)) {}

std::vector<ParameterValue> DriveValues::values(const cycle::DriveSnapshot& drive) const {
  std::vector<ParameterValue> values;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const catalogue::ParameterAccess& access = parameters_[i].access;
    const unsigned index = access.request.index;
    const cycle::MonitoredValue read = i < drive.monitored.size() ? drive.monitored[i] : cycle::MonitoredValue{};
    ParameterValue value;
    value.parameter = parameters_[i].label;
    value.name = catalogue::fullName(access.entry, index);
    if (access.entry != nullptr) value.unit = access.entry->unitOf(index);
    if (drive.online && read.state == cycle::MonitoredValue::State::kKnown) {
      value.value = catalogue::valueOf(access.entry, read.raw, index);
      value.text = known_.valueText(access.entry, read.raw, index);
    } else {
      value.value = std::numeric_limits<double>::quiet_NaN();
      value.text = whyNotKnown(drive, read);
    }
    values.push_back(std::move(value));
  }
  return values;
}

}  // namespace nord_driver::node
