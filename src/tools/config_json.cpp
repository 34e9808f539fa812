#include "tools/config_picture.h"
#include "tools/json_text.h"

namespace nord_driver::tools {

namespace {

void writeList(JsonText& json, const std::string& name, const std::vector<std::string>& texts) {
  json.key(name).begin('[');
  for (const std::string& text : texts) json.text(text);
  json.end(']');
}

void writeFindings(JsonText& json, const std::string& name, const std::vector<Finding>& findings) {
  json.key(name).begin('[');
  for (const Finding& finding : findings) {
    json.begin('{').key("line").number(finding.line).key("text").text(finding.text).end('}');
  }
  json.end(']');
}

/// Those that hold.
void writeLimits(JsonText& json, const std::string& name, const robot::SpeedLimits& limits) {
  json.key(name).begin('{');
  const auto write = [&](bool is_there, const std::string& what, double max, double min) {
    if (is_there) json.key("max_" + what).number(max).key("min_" + what).number(min);
  };
  write(limits.has_velocity_limits, "velocity", limits.max_velocity, limits.minVelocity());
  write(limits.has_acceleration_limits, "acceleration", limits.max_acceleration, limits.minAcceleration());
  write(limits.has_jerk_limits, "jerk", limits.max_jerk, limits.minJerk());
  json.end('}');
}

void write(JsonText& json, const CheckedDrive& drive) {
  json.begin('{');
  json.key("name").text(drive.name).key("series").text(profile::toString(drive.series));
  json.key("inverter").number(drive.inverter).key("joint").text(drive.joint);
  json.key("gear_ratio").number(drive.gear_ratio).key("pole_pairs").number(drive.pole_pairs);
  json.key("inverted").boolean(drive.inverted).key("of_base").boolean(drive.of_base);
  if (!drive.leader.empty()) json.key("follows").text(drive.leader);
  json.key("max_frequency").number(drive.max_frequency).key("max_frequency_typed").boolean(drive.frequency_typed);
  json.key("max_velocity").number(drive.max_velocity);
  json.key("mode").text(drive.positions ? "position" : "velocity");
  if (drive.positions) {
    json.key("targets").begin('{').key("by").text(drive.by_element ? "array" : "words").key("unit").text(drive.unit);
    if (drive.lower) json.key("lower").number(*drive.lower);
    if (drive.upper) json.key("upper").number(*drive.upper);
    json.end('}');
  }
  writeLimits(json, "limits", drive.limits);
  json.end('}');
}

void write(JsonText& json, const std::vector<CheckedAxle>& axles) {
  json.begin('[');
  for (const CheckedAxle& axle : axles) {
    json.begin('{').key("wheel").text(axle.wheel).key("steering").text(axle.steering);
    json.key("x").number(axle.sizes.x).key("y").number(axle.sizes.y);
    json.key("min_angle").number(axle.sizes.min_angle).key("max_angle").number(axle.sizes.max_angle);
    json.key("wheel_radius").number(axle.sizes.wheel_radius).end('}');
  }
  json.end(']');
}

void write(JsonText& json, const CheckedBase& base) {
  const bool mecanum = base.kind == robot::BaseKind::kMecanum;
  const bool sideways = base.kind != robot::BaseKind::kDifferential;
  json.begin('{').key("type").text(robot::nameOf(base.kind));
  if (base.kind == robot::BaseKind::kSteered) {
    write(json.key("axles"), base.axles);
    json.key("angle_tolerance").number(base.angle_tolerance);
  } else {
    writeList(json, "left", base.left);
    writeList(json, "right", base.right);
    json.key("wheel_radius").number(base.geometry.left_wheel_radius);
    json.key("wheel_separation").number(base.geometry.wheel_separation);
  }
  if (mecanum) json.key("wheel_base").number(base.geometry.wheel_base);
  json.key("max_velocity").begin('{').key("linear/x").number(base.linear_x);
  if (sideways) json.key("linear/y").number(base.linear_y);
  json.key("angular/z").number(base.angular_z).end('}');
  json.key("limits").begin('{');
  writeLimits(json, "linear/x", base.limits.linear_x);
  if (sideways) writeLimits(json, "linear/y", base.limits.linear_y);
  writeLimits(json, "angular/z", base.limits.angular_z);
  json.end('}').end('}');
}

}  // namespace

std::string configJson(const CheckedConfig& config) {
  JsonText json;
  json.begin('{');
  writeList(json, "files", config.files);
  json.key("accepted").boolean(config.accepted());
  writeFindings(json, "errors", config.errors);
  writeFindings(json, "warnings", config.warnings);
  if (!config.modules.empty()) {
    json.key("transport").text(config.transport).key("where").text(config.where);
    json.key("cycle_rate").number(config.cycle_rate);
    json.key("bus").begin('{');
    for (const auto& [key, value] : config.bus) json.key(key).text(value);
    json.end('}').key("modules").begin('[');
    for (const CheckedModule& module : config.modules) {
      json.begin('{').key("address").text(module.address).key("parameter_channel").text(module.parameter_channel);
      json.key("protected_by").text(module.protected_by).key("drives").begin('[');
      for (const CheckedDrive& drive : module.drives) write(json, drive);
      json.end(']').end('}');
    }
    json.end(']');
    if (config.base) write(json.key("base"), *config.base);
  }
  return json.end('}').str() + "\n";
}

}  // namespace nord_driver::tools
