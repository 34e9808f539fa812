#include "tools/config_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "config/setting_checks.h"

namespace nord_driver::tools {

namespace {

struct Branch {
  std::string text;
  std::vector<Branch> twigs;
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, std::abs(value) < 1000.0 ? "%.3g" : "%.0f", value);
  return text;
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void grow(const std::vector<Branch>& branches, const std::string& margin, bool lines, std::string& text) {
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const bool last = i + 1 == branches.size();
    text += margin + (lines ? (last ? "└─ " : "├─ ") : (last ? "`- " : "|- ")) + branches[i].text + "\n";
    grow(branches[i].twigs, margin + (last ? "   " : lines ? "│  " : "|  "), lines, text);
  }
}

/// "up to 6 rad/s, 3 rad/s^2"; empty: none.
std::string limitsText(const robot::SpeedLimits& limits, const std::string& unit) {
  std::string text;
  const auto add = [&](bool is_there, double max, double min, const std::string& per) {
    if (!is_there) return;
    text += text.empty() ? "" : ", ";
    text += (min == -max ? number(max) : number(min) + " to " + number(max)) + " " + unit + per;
  };
  add(limits.has_velocity_limits, limits.max_velocity, limits.minVelocity(), "/s");
  add(limits.has_acceleration_limits, limits.max_acceleration, limits.minAcceleration(), "/s^2");
  add(limits.has_jerk_limits, limits.max_jerk, limits.minJerk(), "/s^3");
  return text;
}

Branch branchOf(const CheckedDrive& drive, bool shares) {
  Branch branch;
  branch.text = (shares ? "inverter " + std::to_string(drive.inverter) + ": " : "") + drive.name + ", " +
                profile::toString(drive.series) + ", " +
                counted(static_cast<std::size_t>(drive.pole_pairs), "pole pair") + ", gear ratio " +
                shortNumber(drive.gear_ratio) + (drive.inverted ? ", inverted: " : ": ") + number(drive.max_velocity) +
                " " + drive.unit + "/s at " + (drive.joint.empty() ? "its joint" : drive.joint);
  if (drive.of_base) return branch;
  if (!drive.leader.empty()) {
    branch.twigs.push_back({"follows " + drive.leader, {}});
    return branch;
  }
  const std::string limits = drive.positions ? drive.targets : limitsText(drive.limits, "rad");
  branch.twigs.push_back({"~" + drive.name + (drive.positions ? "/position_command, " : "/command, ") +
                              (limits.empty() ? "no limits" : "limits: " + limits),
                          {}});
  return branch;
}

std::string protection(const CheckedModule& module) {
  return "when this computer dies: " +
         (module.protected_by.empty() ? "nothing of this bus stops a drive" : module.protected_by);
}

/// They say what protects them where it is not the same for all.
Branch branchOf(const CheckedModule& module, bool protected_alike) {
  Branch branch{module.address + ", parameters: " + module.parameter_channel, {}};
  const bool shares = module.drives.size() > 1;
  for (const CheckedDrive& drive : module.drives) branch.twigs.push_back(branchOf(drive, shares));
  if (!protected_alike) branch.twigs.push_back({protection(module), {}});
  return branch;
}

Branch branchOfBus(const CheckedConfig& config) {
  std::string text = "bus: " + config.transport + (config.where.empty() ? "" : " at " + config.where) + ", " +
                     number(config.cycle_rate) + " cycles/s";
  for (const auto& [key, value] : config.bus) text += ", " + key + " " + value;
  Branch branch{text, {}};
  const std::vector<CheckedModule>& modules = config.modules;
  const bool alike = std::all_of(modules.begin(), modules.end(), [&](const CheckedModule& module) {
    return module.protected_by == modules.front().protected_by;
  });
  for (const CheckedModule& module : modules) branch.twigs.push_back(branchOf(module, alike));
  if (alike) branch.twigs.push_back({protection(modules.front()), {}});
  return branch;
}

/// Where the frequencies of 100 % come from.
std::string frequencyText(const CheckedConfig& config) {
  std::vector<std::string> typed;
  bool factory = false;
  for (const CheckedModule& module : config.modules) {
    for (const CheckedDrive& drive : module.drives) {
      if (drive.frequency_typed) typed.push_back(drive.name + " " + number(drive.max_frequency) + " Hz");
      factory = factory || !drive.frequency_typed;
    }
  }
  std::string text = "speeds are those of 100 %: ";
  if (!typed.empty()) text += "with max_frequency of " + listed(typed) + (factory ? ", else " : "");
  if (factory) {
    text +=
        "with P105 = " + number(kFactoryMaxFrequency) + " Hz, as from the factory; the driver reads it from the drive";
  }
  return text;
}

Branch axis(const char* name, double full, const robot::SpeedLimits& limits, const char* unit) {
  std::string text = std::string(name) + ": " + number(full) + " " + unit + "/s";
  const std::string configured = limitsText(limits, unit);
  text += configured.empty() ? ", no limits" : ", limits: " + configured;
  if (limits.has_velocity_limits && full > 0.0) {
    text += " (" + number(std::round(100.0 * limits.max_velocity / full)) + " % of what the drives can)";
  }
  return {text, {}};
}

std::string corrected(double multiplier) {
  return multiplier == 1.0 ? "" : " x " + number(multiplier);
}

Branch branchOfSteered(const CheckedBase& base) {
  Branch branch{"base, steered", {}};
  for (const CheckedAxle& axle : base.axles) {
    branch.twigs.push_back({(&axle == &base.axles.front() ? "front: " : "rear: ") + axle.wheel + ", steered by " +
                                axle.steering + " from " + number(axle.sizes.min_angle) + " to " +
                                number(axle.sizes.max_angle) + " rad, at x " + number(axle.sizes.x) + " m, y " +
                                number(axle.sizes.y) + " m, wheel radius " + number(axle.sizes.wheel_radius) + " m",
                            {}});
  }
  branch.twigs.push_back({"drives while its wheels stand within " + number(base.angle_tolerance) + " rad", {}});
  branch.twigs.push_back(axis("straight on", base.linear_x, base.limits.linear_x, "m"));
  branch.twigs.push_back(axis("sideways", base.linear_y, base.limits.linear_y, "m"));
  branch.twigs.push_back(axis("on the spot", base.angular_z, base.limits.angular_z, "rad"));
  return branch;
}

Branch branchOf(const CheckedBase& base) {
  if (base.kind == robot::BaseKind::kSteered) return branchOfSteered(base);
  const bool mecanum = base.kind == robot::BaseKind::kMecanum;
  const robot::BaseGeometry& sizes = base.geometry;
  Branch branch{mecanum ? "base, mecanum" : base.left.size() > 1 ? "base, skid steer" : "base, two wheels", {}};
  branch.twigs.push_back({"left: " + listed(base.left), {}});
  branch.twigs.push_back({"right: " + listed(base.right), {}});
  branch.twigs.push_back({"wheel radius " + number(sizes.left_wheel_radius) + " m" +
                              corrected(sizes.left_wheel_radius_multiplier) + ", separation " +
                              number(sizes.wheel_separation) + " m" + corrected(sizes.wheel_separation_multiplier) +
                              (mecanum ? ", wheel base " + number(sizes.wheel_base) + " m" : ""),
                          {}});
  branch.twigs.push_back(axis("straight on", base.linear_x, base.limits.linear_x, "m"));
  if (mecanum) branch.twigs.push_back(axis("sideways", base.linear_y, base.limits.linear_y, "m"));
  branch.twigs.push_back(axis("on the spot", base.angular_z, base.limits.angular_z, "rad"));
  return branch;
}

std::string findingText(const CheckedConfig& config, const char* kind, const Finding& finding) {
  std::string place = config.files.size() == 1 ? config.files.front() + ":" : "";
  if (finding.line > 0) place += std::to_string(finding.line) + ":";
  return place + (place.empty() ? "" : " ") + kind + ": " + finding.text + "\n";
}

}  // namespace

std::string configPicture(const CheckedConfig& config, bool lines) {
  std::string text = listed(config.files) + "\n";
  if (!config.modules.empty()) {
    std::vector<Branch> branches{branchOfBus(config)};
    branches.push_back(config.base ? branchOf(*config.base) : Branch{"no base: there is no left_wheel", {}});
    branches.push_back({frequencyText(config), {}});
    grow(branches, "", lines, text);
  }
  for (const Finding& finding : config.errors) text += findingText(config, "error", finding);
  for (const Finding& finding : config.warnings) text += findingText(config, "warning", finding);
  text += config.accepted() ? "fine" : "refused: " + counted(config.errors.size(), "error");
  if (!config.warnings.empty()) text += ", " + counted(config.warnings.size(), "warning");
  return text + "\n";
}

}  // namespace nord_driver::tools
