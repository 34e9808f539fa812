#include "commissioning/bus_selection.h"

#include <map>

namespace nord_driver::commissioning {

namespace {

constexpr std::int32_t kTerminalsOrKeyboard = 0, kTerminals = 1;
constexpr std::int32_t kSystemBus = 3;  // SK 1x0E and 2xxE
constexpr std::int32_t kCanopen = 6;    // SK 5xxE and 54xE, and their system bus
// SK 300E, 700E and 750E: the setpoint alone, the control word alone, or both.
constexpr std::int32_t kFirstProfibus = 8, kLastProfibus = 10, kFirstInterbus = 12, kLastInterbus = 14;

struct Numbers {
  std::int32_t control_word, setpoint;
};

/// BU 0020 6.2.2 and BU 0070 5.1.
const std::map<std::string, Numbers>& ofOption() {
  static const std::map<std::string, Numbers> kNumbers{{"profibus_dp", {4, 4}},
                                                       {"profibus_ms2", {4, 4}},
                                                       {"interbus", {5, 5}},
                                                       {"canopen", {6, 6}},
                                                       {"devicenet", {7, 7}}};
  return kNumbers;
}

/// BU 0020 6.1.2 and BU 0070 5.1; P510 of these series counts otherwise than their P509.
const std::map<std::string, Numbers>& ofOlderSeries() {
  static const std::map<std::string, Numbers> kNumbers{
      {"profibus_dp", {10, 3}}, {"profibus_ms2", {10, 3}}, {"interbus", {14, 4}}};
  return kNumbers;
}

/// P510 of these series where P509 is not printed (BU 0020 6.1.2).
const std::map<std::string, std::int32_t>& setpointsOfOlderSeries() {
  static const std::map<std::string, std::int32_t> kNumbers{{"canopen", 5}, {"devicenet", 6}};
  return kNumbers;
}

}  // namespace

bool BusSelection::controlWordFits(std::int32_t raw) const noexcept {
  if (control_word) return raw == *control_word;
  if (raw == kTerminalsOrKeyboard || raw == kTerminals) return false;
  if (!known_wrong_only) return true;
  return !(raw >= kFirstProfibus && raw <= kLastProfibus) && !(raw >= kFirstInterbus && raw <= kLastInterbus);
}

bool BusSelection::setpointFits(std::int32_t raw) const noexcept {
  return raw == 0 || !setpoint || raw == *setpoint;
}

BusSelection busSelection(const DriveUnderCheck& drive) {
  BusSelection selection;
  const std::string& transport = drive.asked().transport;
  if (ofOption().count(transport) == 0) return selection;
  if (drive.isDecentral()) return {kSystemBus, kSystemBus, false, "BU 2700, 7.2"};
  if (drive.isOlderSeries()) {
    const auto found = ofOlderSeries().find(transport);
    if (found != ofOlderSeries().end()) return {found->second.control_word, found->second.setpoint, false, ""};
    selection.setpoint = setpointsOfOlderSeries().at(transport);
    selection.known_wrong_only = true;
    return selection;
  }
  if (drive.asked().identity.timeout_owner == TimeoutOwner::kModule) return {kCanopen, kCanopen, false, "BU 2700, 7.2"};
  const Numbers& numbers = ofOption().at(transport);
  return {numbers.control_word, numbers.setpoint, false, ""};
}

}  // namespace nord_driver::commissioning
