#include "node/drive_protection.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "config/setting_checks.h"

namespace nord_driver::node {

namespace {

using Level = ProtectionReport::Level;

void warn(ProtectionReport& report, const std::string& text) {
  report.level = Level::kWarning;
  report.text += "; " + text;
}

// Nothing is told before everything has been asked for.
void sayUnknown(ProtectionReport& report, const cycle::DeviceData& device, const std::string& text) {
  if (device.complete) return warn(report, text);
  report.text += "; " + text;
}

// P151: BU 2700 8.3. P513: SK 300E, 7x0E by BU 0020 8.1, SK 1x0E, 2xxE by BU 0220 6.2.1; for SK 5xxE and 54xE, BU 2700 8.3
// has E10.3 and BU 0020 8.1 E10.0.
const char* faultOfTimeout(bool by_module, profile::Series series) noexcept {
  if (by_module) return "E10.3";
  return series == profile::Series::kSk5xxe || series == profile::Series::kSk54xe ? "E10" : "E10.0";
}

}  // namespace

DriveProtection::DriveProtection(DriveIdentity identity, profile::Series series, Duration cmd_vel_timeout,
                                 Duration period, bool looks_on)
    : identity_(std::move(identity)),
      series_(series),
      cmd_vel_timeout_(cmd_vel_timeout),
      period_(period),
      looks_on_(looks_on) {}

// "System bus timeout" in the table of BU 2700 8.1, columns SK CU4 and SK TU4.
void DriveProtection::assessWayToModule(const cycle::DeviceData& device, ProtectionReport& report) const {
  if (series_ == profile::Series::kSk5xxe) {
    if (!device.telegram_timeout) {
      sayUnknown(report, device, "P513, by which the inverter watches its bus module, is not known");
    } else if (*device.telegram_timeout == 0.0) {
      warn(report, "P513 = 0: the inverter does not notice a bus module that fails; set it above 0");
    }
    return;
  }
  if (!device.telegram_timeout) sayUnknown(report, device, "P513, which can switch this off, is not known");
  if (!device.option_monitoring) {
    sayUnknown(report, device, "P120, by which the inverter watches its bus module, is not known");
  } else if (*device.option_monitoring == 0) {
    warn(report, "P120 = 0: the inverter does not notice a bus module that fails; set it to 1 or 2");
  }
}

// Where the drive is told nothing (a gateway, or a profile that has no word to be ignored by), no time-out judges the words of this
// node.
ProtectionReport DriveProtection::assessLookingOn(const std::optional<double>& own, const std::string& name) const {
  ProtectionReport report{Level::kFine, "this node looks on and commands nothing"};
  if (own && *own > 0.0 && identity_.timeout_notices && identity_.nord_profile) {
    const bool by_module = identity_.timeout_owner == TimeoutOwner::kModule;
    warn(report, name + " of " + shortNumber(*own) + " s: by its words 0000 the inverter trips " +
                     faultOfTimeout(by_module, series_) + " and the motor coasts; set it to 0 while it looks on");
  }
  return report;
}

ProtectionReport DriveProtection::assess(const cycle::DeviceData& device) const {
  const bool by_module = identity_.timeout_owner == TimeoutOwner::kModule;
  const std::optional<double>& own = by_module ? device.module_timeout : device.telegram_timeout;
  const std::string name = by_module ? "P151 of the bus module" : "P513";
  if (looks_on_) return assessLookingOn(own, name);
  if (device.telegram_timeout && *device.telegram_timeout < 0.0) {
    return {Level::kError,
            "nothing: P513 = -0.1 lets the inverter ignore every bus error, it would run on; set P513 to 0 or more"};
  }
  if (own && *own < 0.0) {
    return {Level::kError,
            "nothing: P151 = -1 lets the bus module ignore a lost master, the inverter would run on; set P151 to 0 or "
            "more"};
  }
  // With 0 the drive itself watches nothing, but heeds what the bus notices (BU 2700 7.1.1).
  const bool own_acts = own && *own > 0.0;
  const bool bus_acts = !identity_.protected_by.empty();
  if (!bus_acts && !identity_.timeout_notices) {
    return {Level::kError,
            "nothing that is known: what stands between this computer and the drive may repeat the last "
            "control words for ever, and " +
                name + " does not notice that"};
  }
  if (bus_acts && identity_.timeout_needed && own && *own <= 0.0) {
    return {Level::kError, "nothing: " + identity_.protected_by + ", but " + name + " = 0: it would run on"};
  }
  if (!own_acts && !bus_acts) {
    if (own) return {Level::kError, "nothing: the bus watches nothing, and " + name + " = 0: it would run on"};
    if (identity_.parameter_channel == "none") {
      return {
          Level::kError,
          "nothing that is known: the bus watches nothing, and there is no parameter channel to read " + name + " by"};
    }
    return {Level::kWarning, "not known: the bus watches nothing, and " + name + " could not be read"};
  }

  ProtectionReport report;
  if (bus_acts) report.text = identity_.protected_by;
  if (own_acts) {
    report.text += std::string(bus_acts ? "; " : "") + name + " of " + shortNumber(*own) +
                   (identity_.timeout_notices ? std::string(" s: the inverter trips ") +
                                                    faultOfTimeout(by_module, series_) + " and the motor coasts"
                                              : " s after that");
  }
  if (!own) {
    const char* const matters =
        identity_.timeout_needed ? ", without which it would run on" : ", which can switch this off";
    sayUnknown(report, device, name + matters + ", is not known");
  }
  if (by_module) assessWayToModule(device, report);

  double latest = bus_acts ? identity_.protection_time : *own;
  if (own_acts && latest > 0.0) latest = identity_.timeout_notices ? std::min(latest, *own) : latest + *own;
  if (cmd_vel_timeout_ > Duration::zero() && seconds(latest) > cmd_vel_timeout_) {
    warn(report, "that is " + shortNumber(latest) + " s after the last telegram, later than cmd_vel_timeout (" +
                     shortNumber(toSeconds(cmd_vel_timeout_)) + " s)");
  }
  if (own_acts && *own < identity_.worst_cycle) {
    warn(report, name + " is shorter than a bus cycle may be, " + shortNumber(identity_.worst_cycle) +
                     " s while a drive is silent: it trips without a reason");
  } else if (own_acts && *own < 2.0 * identity_.longest_pause) {
    warn(report, name + " is shorter than two pauses between telegrams, which may be " +
                     shortNumber(identity_.longest_pause) + " s long each: it trips without a reason");
  } else if (own_acts && seconds(*own) < 2 * period_) {
    warn(report, name + " is shorter than two bus cycles: it trips without a reason (BU 0220 4.2.3.2)");
  }
  return report;
}

}  // namespace nord_driver::node
