#include "tools/commissioning_check.h"

#include <algorithm>

#include "nord_driver/config/settings.h"
#include "tools/patient_access.h"

namespace nord_driver::tools {

namespace {

constexpr std::uint16_t kMaxFrequency = 105;  // of every series, and of every parameter set

catalogue::ParameterAddress addressOf(const commissioning::ParameterKey& key) {
  catalogue::ParameterAddress address;
  address.number = key.number;
  address.parameter_set = key.set;
  address.index = key.index;
  return address;
}

void refuseUnknown(const std::vector<std::string>& names, const std::vector<commissioning::AskedDrive>& drives) {
  for (const std::string& name : names) {
    const auto same = [&name](const commissioning::AskedDrive& drive) { return drive.name == name; };
    if (std::any_of(drives.begin(), drives.end(), same)) continue;
    std::string known;
    for (const commissioning::AskedDrive& drive : drives) known += (known.empty() ? "" : ", ") + drive.name;
    throw ConfigError("drive \"" + name + "\" is not in the configuration, expected one of " + known);
  }
}

}  // namespace

std::vector<CommissionedDrive> drivesToCheck(const node::NodeConfig& config,
                                             const std::vector<DriveIdentity>& identities,
                                             const std::vector<std::string>& names,
                                             const catalogue::Catalogues& catalogues) {
  const auto all = commissioning::askedDrives(config.cycle, identities, config.transport, config.read_only);
  refuseUnknown(names, all);
  std::vector<CommissionedDrive> drives;
  for (const commissioning::AskedDrive& asked : all) {
    if (!names.empty() && std::find(names.begin(), names.end(), asked.name) == names.end()) continue;
    const bool module_in_front = asked.identity.timeout_owner == TimeoutOwner::kModule;
    drives.push_back({asked,
                      catalogue::driveCatalogue(catalogues, asked.series, asked.transport, module_in_front),
                      std::nullopt,
                      1,
                      {}});
  }
  return drives;
}

void readFacts(CommissionedDrive& drive, DriveParameters& parameters, const std::atomic<bool>& end_asked) {
  // Its answer tells the set in force.
  const ParameterAnswer maximum = parameters.read(addressOf({kMaxFrequency, 0, 0}));
  if (maximum.set != 0) drive.set_in_force = maximum.set;
  commissioning::CommissioningFacts facts;
  for (const commissioning::ParameterKey& key :
       commissioning::valuesToRead(drive.asked, drive.known, drive.set_in_force)) {
    if (end_asked) throw Trouble("ended before everything was read");
    const ParameterAnswer answer = askPatiently(parameters, [&] { return parameters.read(addressOf(key)); });
    if (answer.success) {
      facts.store(key, answer.raw);
    } else if (answer.refused) {
      facts.storeUnreadable(key);
    } else {
      throw Trouble(answer.message);
    }
  }
  drive.facts = facts;
}

commissioning::Findings findingsIn(const std::vector<CommissionedDrive>& drives) {
  commissioning::Drives checked;
  for (const CommissionedDrive& drive : drives) {
    if (drive.facts) checked.emplace_back(drive.asked, drive.known, *drive.facts, drive.set_in_force);
  }
  return commissioning::check(checked);
}

std::vector<Fix> fixesFor(const CommissionedDrive& drive, const commissioning::Findings& findings, bool persistent) {
  std::vector<Fix> fixes;
  for (const commissioning::Finding& finding : findings) {
    if (finding.drive != drive.asked.name || !finding.remedy) continue;
    const auto same = [&finding](const Fix& fix) { return fix.finding.key == finding.key; };
    if (std::any_of(fixes.begin(), fixes.end(), same)) continue;
    Fix fix{finding, catalogue::accessTo(addressOf(finding.key), drive.known)};
    if (!fix.access.error.empty()) throw Trouble(fix.access.error);
    const std::string wrong = catalogue::setRaw(fix.access, finding.remedy->raw, persistent);
    if (!wrong.empty()) throw Trouble(wrong);
    fixes.push_back(fix);
  }
  std::stable_partition(fixes.begin(), fixes.end(), [](const Fix& fix) { return fix.finding.selects_bus; });
  return fixes;
}

}  // namespace nord_driver::tools
