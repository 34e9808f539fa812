#include "cycle/parameter_access.h"

#include <cmath>
#include <optional>

#include "config/setting_checks.h"
#include "profile/parameter_shape.h"

namespace nord_driver::cycle {

namespace {

// Nobody has said how an unknown parameter is indexed: as it was asked for.
profile::ParameterShape shapeOfUnknown(std::uint8_t set, std::uint8_t index) {
  if (set != 0) return index != 0 ? profile::ParameterShape::kArrayPerSet : profile::ParameterShape::kPerSet;
  return index != 0 ? profile::ParameterShape::kArray : profile::ParameterShape::kPlain;
}

std::optional<std::int32_t> rawValue(double value) {
  if (!(std::abs(value) <= INT32_MAX) || value != std::trunc(value)) return std::nullopt;
  return static_cast<std::int32_t>(value);
}

std::string rangeOf(const profile::ParameterInfo* info) {
  if (info == nullptr) return "a whole number of 32 bits";
  return shortNumber(profile::toValue(*info, info->minimum)) + " to " +
         shortNumber(profile::toValue(*info, info->maximum)) + (info->unit[0] != '\0' ? " " : "") + info->unit;
}

}  // namespace

std::string addressParameter(const ParameterAddress& address, profile::Series series, Request& request,
                             const profile::ParameterInfo*& info) {
  if (address.number > 999) {
    return "parameter " + std::to_string(address.number) + " does not exist, expected 0 to 999";
  }
  if (address.parameter_set > 4) {
    return "parameter set " + std::to_string(address.parameter_set) + " does not exist, expected 0 to 4";
  }
  info = profile::findParameter(address.number, series);
  const bool array = info == nullptr || profile::isArray(info->shape);
  if (!array && address.index > 1) {
    return "P" + std::to_string(address.number) + " is no array, expected index 0, not " +
           std::to_string(address.index);
  }
  const std::uint8_t index = address.index == 0 ? 1 : address.index;
  if (info != nullptr) {
    request.parameter = profile::readRequest(*info, address.parameter_set, index);
  } else {
    request.parameter.number = address.number;
    request.parameter.shape = shapeOfUnknown(address.parameter_set, address.index);
    request.parameter.parameter_set = address.parameter_set;
    request.parameter.index = index;
  }
  request.kind = RequestKind::kReadParameter;
  return "";
}

std::string addValue(const ParameterWrite& write, const profile::ParameterInfo* info, Request& request) {
  const std::string name = "P" + std::to_string(request.parameter.number);
  if (info == nullptr && !write.allow_raw) {
    return name + " is not in the catalogue: its unit is not known, and raw values need allow_raw_parameters: true";
  }
  const auto raw = info != nullptr ? profile::toRaw(*info, write.value) : rawValue(write.value);
  if (!raw) {
    return "the value " + shortNumber(write.value) + " cannot be written to " + name + ", expected " + rangeOf(info);
  }
  request.kind = RequestKind::kWriteParameter;
  request.parameter.action =
      write.persistent ? profile::ParameterAction::kWritePersistent : profile::ParameterAction::kWriteRam;
  request.parameter.raw = *raw;
  return "";
}

double valueOf(const profile::ParameterInfo* info, std::int32_t raw) {
  return info != nullptr ? profile::toValue(*info, raw) : raw;
}

}  // namespace nord_driver::cycle
