#include "node/commissioning_warnings.h"

#include <algorithm>
#include <array>
#include <utility>

#include "commissioning/check.h"
#include "commissioning/device_facts.h"

namespace nord_driver::node {

using commissioning::Finding;
using commissioning::Severity;

namespace {

/// DriveProtection's.
bool isProtection(const Finding& finding) {
  static const std::array<std::string, 3> kRules{"bus_errors_heeded", "timeout_long_enough", "module_watched"};
  if (std::find(kRules.begin(), kRules.end(), finding.rule) != kRules.end()) return true;
  static const std::array<unsigned, 3> kNumbers{120, 151, 513};
  return finding.rule == "readable" &&
         std::find(kNumbers.begin(), kNumbers.end(), finding.key.number) != kNumbers.end();
}

/// Without a parameter channel nothing at all can be read: one sentence then, not five.
commissioning::Findings withUnreadableAsOne(const commissioning::Findings& findings) {
  commissioning::Findings joined;
  for (const Finding& finding : findings) {
    const auto before = std::find_if(joined.begin(), joined.end(), [&finding](const Finding& other) {
      return other.rule == "readable" && other.drive == finding.drive;
    });
    if (finding.rule != "readable" || before == joined.end()) {
      joined.push_back(finding);
      joined.back().source = finding.rule == "readable" ? "" : finding.source;
    } else {
      before->parameter += ", " + finding.parameter;
    }
  }
  return joined;
}

}  // namespace

CommissioningWarnings::CommissioningWarnings(const NodeConfig& config, const std::vector<DriveIdentity>& identities,
                                             std::vector<catalogue::DriveCatalogue> known)
    : asked_(commissioning::askedDrives(config.cycle, identities, config.transport, config.read_only)),
      known_(std::move(known)),
      found_(asked_.size()) {}

std::vector<LogLine> CommissioningWarnings::update(const cycle::CycleSnapshot& snapshot) {
  commissioning::Drives drives;
  for (DriveIndex i = 0; i < asked_.size(); ++i) {
    const cycle::DriveSnapshot& drive = snapshot.drives[i];
    const bool is_known = drive.parameter_set >= 1 && drive.parameter_set <= 4;
    drives.emplace_back(asked_[i], known_[i], commissioning::deviceFacts(drive.device, asked_[i], known_[i]),
                        is_known ? drive.parameter_set : std::uint8_t{1});
    found_[i] = {};
  }
  commissioning::Findings findings;
  for (const Finding& finding : commissioning::check(drives)) {
    const auto same = [&finding](const commissioning::AskedDrive& drive) { return drive.name == finding.drive; };
    const auto index = std::find_if(asked_.begin(), asked_.end(), same) - asked_.begin();
    const cycle::DriveSnapshot& drive = snapshot.drives[static_cast<std::size_t>(index)];
    if (isProtection(finding) || !drive.device.complete) continue;
    // Our own write of a parameter is under way: it is told as what it is.
    if (finding.rule == "writes_saved" && drive.owes_eeprom_switch) continue;
    findings.push_back(finding);
  }
  std::vector<LogLine> news;
  for (const Finding& finding : withUnreadableAsOne(findings)) take(finding, news);
  return news;
}

void CommissioningWarnings::take(const Finding& finding, std::vector<LogLine>& news) {
  const bool is_note = finding.severity == Severity::kNote;
  const std::string text = toText(finding);
  for (DriveIndex i = 0; i < asked_.size(); ++i) {
    if (asked_[i].name == finding.drive) (is_note ? found_[i].notes : found_[i].warnings).push_back(text);
  }
  const std::string line = "drive " + finding.drive + ": " + text;
  if (!told_.insert(line).second) return;
  news.push_back({is_note ? LogLine::Level::kInfo : LogLine::Level::kWarn, line});
}

}  // namespace nord_driver::node
