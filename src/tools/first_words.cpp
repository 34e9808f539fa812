#include "tools/first_words.h"

#include "profile/word_function.h"

namespace nord_driver::tools {

catalogue::ParameterAddress firstWordFunction(profile::Series series, bool actual_value, std::uint8_t set) {
  const profile::WordParameter word =
      actual_value ? profile::actualValueParameter(series, 1) : profile::setpointParameter(series, 1);
  catalogue::ParameterAddress address;
  address.number = word.number;
  address.parameter_set = set;
  if (word.is_array) address.index = word.index;
  return address;
}

bool saysFrequency(const ParameterAnswer& answer, profile::Series series, bool actual_value) {
  if (!answer.success) return false;
  const auto code = static_cast<std::uint16_t>(answer.raw & 0xFFFF);
  const profile::WordFunction* const function =
      actual_value ? profile::findActualValueFunction(series, code) : profile::findSetpointFunction(series, 1, code);
  return function != nullptr && function->use == profile::WordUse::kFrequency;
}

void readFirstWords(DriveParameters& drive, ScopeRecord& record) {
  const auto is_frequency = [&drive](bool actual_value) {
    const ParameterAnswer answer = drive.read(firstWordFunction(drive.series(), actual_value, 0));
    return saysFrequency(answer, drive.series(), actual_value);
  };
  record.setpoint_is_frequency = is_frequency(false);
  record.actual_value_is_frequency = is_frequency(true);
}

}  // namespace nord_driver::tools
