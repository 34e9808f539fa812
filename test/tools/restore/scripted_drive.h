// A drive whose parameters are a map: what it refuses, where it falls silent and what it loses is told to it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "catalogue/shipped.h"
#include "tools/comparison.h"
#include "tools/drive_parameters.h"
#include "tools/parameter_name.h"

namespace nord_driver::tools {

class ScriptedDrive final : public DriveParameters {
 public:
  explicit ScriptedDrive(std::map<std::string, std::int32_t> parameters) : values(std::move(parameters)) {}

  ParameterAnswer read(const catalogue::ParameterAddress& address) override { return access(parameterName(address)); }
  ParameterAnswer write(const catalogue::ParameterAccess& asked) override {
    catalogue::ParameterAddress address;
    address.number = asked.request.number;
    const auto shape = asked.request.shape;
    const bool array = shape == profile::ParameterShape::kArray || shape == profile::ParameterShape::kArrayPerSet;
    const bool sets = shape == profile::ParameterShape::kPerSet || shape == profile::ParameterShape::kArrayPerSet;
    if (array) address.index = asked.request.index;
    if (sets) address.parameter_set = asked.request.parameter_set;
    const std::string name = parameterName(address);
    const bool persistent = asked.request.action == profile::ParameterAction::kWritePersistent;
    if (refused.count(name) != 0) {
      ParameterAnswer answer;
      answer.refused = true;
      answer.message = "drive left refuses it: PKW error 2";
      return answer;
    }
    if (name == used_up_at) {
      ParameterAnswer answer;
      answer.refused = answer.used_up = true;
      answer.message = "the budget is used up";
      return answer;
    }
    if (before_write) before_write(name);
    ParameterAnswer answer = access(name);
    if (!answer.success) return answer;
    written.push_back(name + (persistent ? " = " : " ~ ") + std::to_string(asked.request.raw));
    if (values[name] != asked.request.raw) values[name] = asked.request.raw;
    answer.raw = asked.request.raw;
    if (accesses_left == 0 && silent_after_carrying_out) throw Trouble("drive left does not answer");
    return answer;
  }
  void pass(Duration /*time*/) override {}
  std::string whyNotWritten(std::uint16_t number) const override { return number == forbidden ? "forbidden" : ""; }
  const std::string& name() const override { return name_; }
  profile::Series series() const override { return profile::Series::kSk5xxe; }
  DriveIdentity identity() const override {
    DriveIdentity identity;
    identity.address = "PROFIBUS station 3";
    identity.module_saves = module_saves;
    return identity;
  }
  std::string notAtRest() override { return moving; }
  const catalogue::DriveCatalogue& known() const override {
    static const catalogue::DriveCatalogue kKnown =
        knownOf(catalogue::shippedCatalogues(), profile::Series::kSk5xxe, "");
    return kKnown;
  }

  std::map<std::string, std::int32_t> values;  ///< by "P102 set 1"
  std::set<std::string> refused;               ///< to write
  std::map<std::string, int> blocked;          ///< accesses that are refused for the moment; -1: all
  bool module_saves = false;                   ///< what is written to its module is saved
  std::uint16_t forbidden = 0;                 ///< by the configuration
  std::string used_up_at;                      ///< of the EEPROM's budget
  std::vector<std::string> written;            ///< "P102 set 1 ~ 250" to RAM, "P102 set 1 = 250" to the EEPROM
  int accesses_left = -1;                      ///< then it falls silent; -1: never
  bool silent_after_carrying_out = false;      ///< the last write of them is carried out, and not answered
  std::function<void(const std::string&)> before_write;
  std::string moving;  ///< why nothing may be written

 private:
  ParameterAnswer access(const std::string& name) {
    if (accesses_left == 0) throw Trouble("drive left does not answer");
    if (accesses_left > 0) --accesses_left;
    ParameterAnswer answer;
    if (blocked[name] != 0) {
      if (blocked[name] > 0) --blocked[name];
      answer.refused = answer.passing = true;
      answer.message = "drive left refuses " + name + ": PKW error 103";
      return answer;
    }
    const auto found = values.find(name);
    answer.success = found != values.end();
    answer.refused = answer.unknown = !answer.success;
    if (answer.success) answer.raw = found->second;
    if (!answer.success) answer.message = "drive left refuses " + name + ": PKW error 0, no such parameter";
    return answer;
  }

  std::string name_ = "left";
};

inline Dump dumpOf(const std::map<std::string, std::int32_t>& values) {
  Dump dump;
  for (const auto& [name, raw] : values) dump.values.push_back({parseParameterName(name), raw});
  return dump;
}

}  // namespace nord_driver::tools
