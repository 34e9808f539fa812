// A parameter written by the driver's service, as a user does it.
#pragma once

#include <cstdint>
#include <string>

#include "nord_driver/WriteParameter.h"
#include "ros_support/service_call.h"

namespace nord_driver::test {

struct WrittenParameter {
  Answer answer;
  std::int32_t raw = 0;  ///< as read back
};

/// To the EEPROM. `number`: the manual's, 102 for P102; `set`: 1..4; `value`: in the parameter's unit.
inline WrittenParameter writeToEeprom(const std::string& drive, std::uint16_t number, std::uint8_t set, double value) {
  WriteParameter service;
  service.request.number = number;
  service.request.parameter_set = set;
  service.request.value = value;
  service.request.persistent = true;
  const Answer answer = callService("nord_driver/" + drive + "/write_parameter", service);
  return {answer, service.response.raw};
}

}  // namespace nord_driver::test
