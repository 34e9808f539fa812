#include "node/late_protection.h"

#include <algorithm>

#include "config/setting_checks.h"

namespace nord_driver::node {

namespace {

constexpr double kLate = 3.0;  // s

}  // namespace

std::vector<std::string> lateProtection(const Settings& bus, const std::vector<DriveIdentity>& identities) {
  std::vector<std::string> sentences;
  for (const DriveIdentity& identity : identities) {
    if (identity.protected_by.empty() || identity.protection_time <= kLate) continue;
    const std::string way = identity.protected_by.substr(0, identity.protected_by.find(':'));
    const std::string sentence = bus.fullName("") + ": a drive runs on for " + shortNumber(identity.protection_time) +
                                 " s when this computer dies (" + way + ")";
    const bool told = std::find(sentences.begin(), sentences.end(), sentence) != sentences.end();
    if (!told) sentences.push_back(sentence);
  }
  return sentences;
}

}  // namespace nord_driver::node
