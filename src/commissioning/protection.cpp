// P513, P151 and P120: whether the drive stops when this computer dies. The end of a node that looks on changes nothing.
#include <algorithm>
#include <cmath>

#include "commissioning/rules.h"
#include "profile/cycle_parameters.h"

namespace nord_driver::commissioning {

namespace {

constexpr std::uint16_t kOptionMonitoring = 120, kModuleTimeout = 151, kTelegramTimeout = 513;
constexpr double kUsualTimeout = 0.5;  // s, as commands time out
constexpr double kAuto = 1;            // P120
constexpr double kStep = 0.1;          // s, of P513

bool isBehindModule(const DriveUnderCheck& drive) {
  return drive.asked().identity.timeout_owner == TimeoutOwner::kModule;
}

/// P151 of some modules is in no file of the catalogue.
std::optional<double> timeoutOf(const DriveUnderCheck& drive, const ParameterKey& key) {
  const auto raw = drive.facts().raw(key);
  const auto* info = profile::findCycleParameter(key.number, drive.asked().series);
  if (!raw || info == nullptr) return std::nullopt;
  return profile::toValue(*info, *raw);
}

ParameterKey ownTimeout(const DriveUnderCheck& drive) {
  return drive.key(isBehindModule(drive) ? kModuleTimeout : kTelegramTimeout);
}

/// s; shorter ones trip without a reason (BU 0220 4.2.3.2).
double shortestTimeout(const DriveUnderCheck& drive) {
  const DriveIdentity& identity = drive.asked().identity;
  return std::max({2.0 * drive.asked().period, identity.worst_cycle, 2.0 * identity.longest_pause});
}

Remedy timeoutRemedy(const DriveUnderCheck& drive, const ParameterKey& key) {
  const double shortest = std::ceil(shortestTimeout(drive) / kStep) * kStep;
  const double value = std::max(kUsualTimeout, shortest);
  const auto* info = profile::findCycleParameter(key.number, drive.asked().series);
  const auto raw = static_cast<std::int32_t>(std::lround(value / (info != nullptr ? info->resolution : 1.0)));
  return {raw, drive.valueText(key, raw)};
}

/// The bus stops the drive by itself, without a time-out of the drive's own.
bool busStopsIt(const DriveUnderCheck& drive) {
  const DriveIdentity& identity = drive.asked().identity;
  return !identity.protected_by.empty() && !identity.timeout_needed;
}

Remedy heedingRemedy(const DriveUnderCheck& drive, const ParameterKey& key) {
  return busStopsIt(drive) ? drive.remedy(key, 0) : timeoutRemedy(drive, key);
}

/// Of a time-out that is not the drive's own. Behind a module P513 of an SK 5xxE is the "system bus timeout" (BU 2700 8.1),
/// and 0 would be none (moduleIsWatched()).
Remedy otherRemedy(const DriveUnderCheck& drive, const ParameterKey& key) {
  const bool watches_module = isBehindModule(drive) && drive.asked().series == profile::Series::kSk5xxe;
  return watches_module ? timeoutRemedy(drive, key) : drive.remedy(key, 0);
}

/// What the words 0000 of a node that looks on do (BU 2700, 7.1.1). Through a gateway it sends none, nor with a profile that
/// has no word to be ignored by.
void assessLookingOn(const DriveUnderCheck& drive, const ParameterKey& key, double timeout, Findings& to) {
  const DriveIdentity& identity = drive.asked().identity;
  if (timeout <= 0.0 || !identity.timeout_notices || !identity.nord_profile) return;
  Finding finding =
      drive.finding(key, Severity::kWarning,
                    "the words of a node that looks on (read_only) are 0000: it trips E10.x by them", "BU 2700, 7.1.1");
  finding.advice = "set it to 0 while the node looks on";  // who drives later may need it
  to.push_back(finding);
}

}  // namespace

void busErrorsAreHeeded(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  if (drive.asked().looks_on) return;
  const char* const source = "BU 2700, 7.1.1 and 8.1";
  for (const std::uint16_t number : {kTelegramTimeout, kModuleTimeout}) {
    const ParameterKey key = drive.key(number);
    const bool own = key == ownTimeout(drive);
    const auto timeout = timeoutOf(drive, key);
    if (!timeout || (number == kModuleTimeout && !own)) continue;
    if (*timeout < 0.0) {
      Finding finding = drive.finding(key, Severity::kError,
                                      "every bus error is ignored: when this computer dies, the motor runs on", source);
      finding.remedy = own ? heedingRemedy(drive, key) : otherRemedy(drive, key);
      to.push_back(finding);
    } else if (own && *timeout == 0.0 && !busStopsIt(drive)) {
      Finding finding = drive.finding(key, Severity::kError,
                                      drive.asked().identity.protected_by.empty()
                                          ? "the bus watches nothing either: when this computer dies, the motor runs on"
                                          : "what watches the bus ends its words, and nothing in the drive heeds that: "
                                            "the motor runs on",
                                      source);
      finding.remedy = timeoutRemedy(drive, key);
      to.push_back(finding);
    }
  }
}

void timeoutIsLongEnough(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const ParameterKey key = ownTimeout(drive);
  const auto timeout = timeoutOf(drive, key);
  if (!timeout) return;
  if (drive.asked().looks_on) return assessLookingOn(drive, key, *timeout, to);
  if (*timeout <= 0.0 || *timeout >= shortestTimeout(drive)) return;
  Finding finding =
      drive.finding(key, Severity::kWarning, "shorter than the bus may be silent: it trips E10.x without a reason",
                    "BU 0220, 4.2.3.2");
  finding.remedy = timeoutRemedy(drive, key);
  to.push_back(finding);
}

// "System bus timeout" in the table of BU 2700 8.1, columns SK CU4 and SK TU4.
void moduleIsWatched(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  if (!isBehindModule(drive) || drive.asked().looks_on) return;
  const bool by_telegrams = drive.asked().series == profile::Series::kSk5xxe;
  const ParameterKey key = drive.key(by_telegrams ? kTelegramTimeout : kOptionMonitoring);
  const auto raw = drive.raw(key);
  if (!raw || *raw != 0) return;
  Finding finding =
      drive.finding(key, Severity::kWarning,
                    "the inverter does not notice a bus module that fails, and the motor runs on", "BU 2700, 8.1");
  finding.remedy = by_telegrams ? timeoutRemedy(drive, key) : drive.remedy(key, kAuto);
  to.push_back(finding);
}

}  // namespace nord_driver::commissioning
