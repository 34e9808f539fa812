// P509 and P510: who commands the inverter.
#include "commissioning/bus_selection.h"
#include "commissioning/rules.h"
#include "profile/leading_function.h"

namespace nord_driver::commissioning {

namespace {

constexpr std::uint16_t kControlWordSource = 509, kSetpointSource = 510;

bool isLed(const DriveUnderCheck& drive) {
  return profile::isLed(drive.asked().series, drive.raw(drive.key(kControlWordSource)),
                        drive.raw(drive.key(kSetpointSource, 0, 1)));
}

}  // namespace

void busHasControl(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const ParameterKey key = drive.key(kControlWordSource);
  const auto raw = drive.raw(key);
  const BusSelection selection = busSelection(drive);
  if (!raw || selection.controlWordFits(*raw)) return;
  if (drive.asked().follows && profile::isBroadcastControlWord(drive.asked().series, *raw)) return;
  const bool control_word_only = profile::isControlWordAlone(drive.asked().series, *raw);
  Finding finding =
      drive.finding(key, Severity::kError,
                    control_word_only ? "the setpoint comes from the terminals: the drive is not enabled, since "
                                        "setpoint 0 of this driver would not stop it"
                                      : "this bus has no control: the drive does not become ready, and its terminals "
                                        "may turn the motor",
                    selection.source);
  finding.selects_bus = true;
  if (selection.control_word) {
    finding.remedy = Remedy{*selection.control_word, drive.valueText(key, *selection.control_word)};
  } else {
    finding.advice =
        "choose this bus on the inverter's display: the manuals at hand print no number of it for this series";
  }
  to.push_back(finding);
}

void busGivesSetpoint(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const ParameterKey key = drive.key(kSetpointSource, 0, 1);
  const auto raw = drive.raw(key);
  if (drive.asked().follows && isLed(drive)) return;
  if (raw && drive.asked().follows) {
    Finding finding = drive.finding(key, Severity::kError,
                                    "the drive is to follow another one, and hears this bus instead: it is not enabled",
                                    drive.isDecentral() ? "BU 0280, 5.1.3" : "BU 0020, 6.2.2");
    finding.selects_bus = true;
    finding.advice = "choose the broadcast here, or in P509; or take `follows` out of the configuration";
    to.push_back(finding);
    return;
  }
  if (!raw || busSelection(drive).setpointFits(*raw)) return;
  // SK 300E, 700E and 750E: the auxiliary setpoint alone; the main one comes from P509 (BU 0020 6.1.2).
  const bool auxiliary = drive.isOlderSeries();
  Finding finding =
      drive.finding(key, auxiliary ? Severity::kWarning : Severity::kError,
                    auxiliary ? "the auxiliary setpoint comes from somewhere else than this driver"
                              : "the setpoint comes from somewhere else: the drive does not follow its commands",
                    drive.isOlderSeries() ? "" : "BU 2700, 7.2");
  finding.selects_bus = true;
  finding.remedy = drive.remedy(key, 0);
  to.push_back(finding);
}

}  // namespace nord_driver::commissioning
