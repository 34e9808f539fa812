// An inverter's parameter memory for tests: RAM, EEPROM and P560, and a record of what it was asked, in order.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::drive {

class FakeParameters {
 public:
  using Request = profile::ParameterRequest;
  using Result = profile::ParameterResult;

  bool ram_orders = true;  ///< writes that spare the EEPROM are known
  std::map<std::uint16_t, std::int32_t> ram{{102, 200}, {105, 500}, {560, 1}};
  std::map<std::uint16_t, std::int32_t> eeprom = ram;
  std::map<std::string, Result> scripted;  ///< answers by record ("P102?", "P560=1"), instead of carrying it out
  std::vector<std::string> asked;
  int eeprom_cycles = 0;

  /// "P102?" reads, "P102=5" writes with the orders of old, "P102~5" with those that spare the EEPROM.
  static std::string record(const Request& request) {
    const std::string name = "P" + std::to_string(request.number);
    switch (request.action) {
      case profile::ParameterAction::kRead:
        return name + "?";
      case profile::ParameterAction::kWriteRam:
        return name + "~" + std::to_string(request.raw);
      case profile::ParameterAction::kWritePersistent:
        break;
    }
    return name + "=" + std::to_string(request.raw);
  }
  static Result refusal(profile::ParameterReason reason) {
    Result result;
    result.outcome = profile::ParameterOutcome::kRefused;
    result.reason = reason;
    result.text = "its own words";
    return result;
  }
  static Result failure(profile::ParameterOutcome outcome) {
    Result result;
    result.outcome = outcome;
    return result;
  }

  Result carryOut(const Request& request) {
    asked.push_back(record(request));
    const auto script = scripted.find(asked.back());
    if (script != scripted.end()) return script->second;
    if (ram.count(request.number) == 0) return refusal(profile::ParameterReason::kNoSuchParameter);
    Result result;
    result.outcome = profile::ParameterOutcome::kDone;
    if (request.action == profile::ParameterAction::kRead) {
      result.raw = ram[request.number];
      return result;
    }
    if (request.action == profile::ParameterAction::kWriteRam) {
      if (!ram_orders) return refusal(profile::ParameterReason::kNotSupported);
    } else if (ram[560] != 0) {
      eeprom[request.number] = request.raw;
      ++eeprom_cycles;
    }
    ram[request.number] = request.raw;
    result.raw = request.raw;
    return result;
  }
};

}  // namespace nord_driver::drive
