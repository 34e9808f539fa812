// Drives as they should be, for tests that spoil one value of them.
#pragma once

#include <string>
#include <vector>

#include "catalogue/shipped.h"
#include "commissioning/bus_selection.h"
#include "commissioning/check.h"

namespace nord_driver::commissioning {

/// SK 1x0E and 2xxE behind SK CU4, the others with an option of their own, on PROFIBUS with PPO 2.
inline AskedDrive askedDrive(profile::Series series, const std::string& transport = "profibus_dp") {
  AskedDrive asked;
  asked.name = "left";
  asked.series = series;
  asked.transport = transport;
  asked.identity.process_values = 3;
  asked.identity.protected_by = "the bus";
  asked.identity.worst_cycle = 0.02;
  const bool decentral = series == profile::Series::kSk1x0e || series == profile::Series::kSk2xxe;
  if (decentral) asked.identity.timeout_owner = TimeoutOwner::kModule;
  asked.of_base = true;
  asked.top_frequency = 44.6;
  asked.top_of = "linear/x/max_velocity";
  return asked;
}

inline const catalogue::DriveCatalogue& knownOf(const AskedDrive& asked) {
  static std::vector<std::unique_ptr<catalogue::DriveCatalogue>> all;
  all.push_back(std::make_unique<catalogue::DriveCatalogue>(
      catalogue::driveCatalogue(catalogue::shippedCatalogues(), asked.series, asked.transport,
                                asked.identity.timeout_owner == TimeoutOwner::kModule)));
  return *all.back();
}

/// Every value a rule looks at, as it should be.
inline CommissioningFacts rightFacts(const AskedDrive& asked, const catalogue::DriveCatalogue& known) {
  const DriveUnderCheck drive{asked, known, {}, 1};
  CommissioningFacts facts;
  for (const ParameterKey& key : valuesToRead(asked, known, 1)) facts.store(key, 0);
  for (std::uint8_t set = 1; set <= 4; ++set) {
    facts.store(drive.key(105, set), 500);
    facts.store(drive.functionKey(543, 0, set), 1);
    facts.store(drive.functionKey(546, 0, set), 1);
  }
  facts.store(drive.key(509), busSelection(drive).control_word.value_or(20));
  facts.store(drive.key(560), 1);
  if (asked.words.positions) {
    facts.store(drive.key(607), 1);
    facts.store(drive.key(608), 1);
  }
  facts.store(drive.key(102), 200);
  facts.store(drive.key(103), 200);
  if (asked.identity.timeout_owner == TimeoutOwner::kModule) {
    facts.store(drive.key(120), 1);
    if (asked.series == profile::Series::kSk5xxe) facts.store(drive.key(513), 5);
  }
  return facts;
}

/// A drive that is as it should be; `spoil` is laid over it.
inline DriveUnderCheck drive(const AskedDrive& asked,
                             const std::vector<std::pair<ParameterKey, std::int32_t>>& spoil = {},
                             std::uint8_t set_in_force = 1) {
  const catalogue::DriveCatalogue& known = knownOf(asked);
  CommissioningFacts facts = rightFacts(asked, known);
  for (const auto& [key, raw] : spoil) facts.store(key, raw);
  return {asked, known, facts, set_in_force};
}

/// "bus_has_control error P509 -> 4"; without an arrow where nothing can be named.
inline std::string shortly(const Finding& finding) {
  std::string text = finding.rule + " " + toString(finding.severity);
  const std::string& name = finding.parameter;
  const std::size_t set = name.find(" set ");
  text += " " + (set == std::string::npos ? name.substr(0, name.find(' ')) : name.substr(0, set + 6));
  if (finding.remedy) text += " -> " + std::to_string(finding.remedy->raw);
  return text;
}

inline std::vector<std::string> shortly(const Findings& findings) {
  std::vector<std::string> texts;
  for (const Finding& finding : findings) texts.push_back(shortly(finding));
  return texts;
}

}  // namespace nord_driver::commissioning
