#include "sim/config_body.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/config_group.h"

namespace nord_driver::sim {

namespace {

/// The drive of this name (or joint), written at `key`.
std::size_t member(const Group& group, const std::string& key, const std::string& wanted,
                   const std::vector<DriveConfig>& drives, bool by_joint) {
  const auto match = std::find_if(drives.begin(), drives.end(), [&](const DriveConfig& drive) {
    return (by_joint ? drive.joint : drive.name) == wanted;
  });
  if (match == drives.end()) {
    refuse(group.keyName(key), YAML::Node(wanted), by_joint ? "the joint of a drive" : "the name of a drive");
  }
  return static_cast<std::size_t>(match - drives.begin());
}

/// The drives whose name (or joint) is listed.
std::vector<std::size_t> members(const Group& group, const std::string& key, const std::vector<DriveConfig>& drives,
                                 bool by_joint) {
  std::vector<std::size_t> found;
  for (const std::string& wanted : group.texts(key)) found.push_back(member(group, key, wanted, drives, by_joint));
  if (found.empty()) refuse(group.keyName(key), group[key], "at least one name");
  return found;
}

BodyKind readKind(const Group& group, const char* key) {
  const char* const kKinds = "differential, mecanum or steered";
  const std::string name = group.get<std::string>(key, "differential", kKinds);
  if (name == "differential") return BodyKind::kDiffDrive;
  if (name == "mecanum") return BodyKind::kMecanum;
  if (name == "steered") return BodyKind::kSteered;
  refuse(group.keyName(key), group[key], kKinds);
}

/// `own`: the keys of a body, which name drives; otherwise the driver's, which name joints. Nothing where they are not
/// all there.
std::optional<SteeredAxleConfig> readAxle(const Group& axle, const std::vector<DriveConfig>& drives, bool own) {
  const char* wheel = own ? "wheel" : "wheel_joint";
  const char* steering = own ? "steering" : "steering_joint";
  if (!axle.has(wheel) || !axle.has(steering) || !axle.has("x")) return std::nullopt;
  const auto name = [&](const char* key) { return axle.get<std::string>(key, "", "the name of a drive or joint"); };
  const auto place = [&](const char* key) {
    return axle.get<double>(key, 0.0, "a number", [](const double& value) { return std::isfinite(value); });
  };
  SteeredAxleConfig read;
  read.wheel = member(axle, wheel, name(wheel), drives, !own);
  read.steering = member(axle, steering, name(steering), drives, !own);
  read.x = place("x");
  read.y = place("y");
  return read;
}

std::optional<BodyConfig> readSteered(const YAML::Node& node, const std::vector<DriveConfig>& drives, bool own) {
  const Group sizes(own ? node["body"] : node, own ? "body" : "");
  const std::string name = own ? "body" : "steered";
  const YAML::Node axles = node[name];
  const Group group(axles, name);
  const auto axle = [&](const char* key) -> std::optional<SteeredAxleConfig> {
    if (!group.has(key)) return std::nullopt;
    return readAxle(Group(axles[key], group.keyName(key)), drives, own);
  };
  const auto front = axle("front");
  const auto rear = axle("rear");
  if (!front || !rear || !sizes.has("wheel_radius")) {
    if (!own) return std::nullopt;
    throw ConfigError(
        "body: something is missing; a steered one has wheel_radius, front and rear, these two wheel, "
        "steering and x");
  }
  if (std::hypot(front->x - rear->x, front->y - rear->y) < 1e-3) {
    refuse(group.keyName("rear"), axles["rear"], "another place than that of front");
  }
  BodyConfig body;
  body.kind = BodyKind::kSteered;
  body.front = *front;
  body.rear = *rear;
  body.wheel_radius = sizes.positive("wheel_radius", 0.0);
  return body;
}

}  // namespace

std::optional<BodyConfig> readBody(const YAML::Node& node, const std::vector<DriveConfig>& drives) {
  const Group root(node, "");
  const bool own = root.has("body");
  const Group group = own ? Group(node["body"], "body") : root;
  const char* left = own ? "left" : "left_wheel";
  const char* right = own ? "right" : "right_wheel";
  BodyConfig body;
  body.kind = readKind(group, own ? "kind" : "base_type");
  if (body.kind == BodyKind::kSteered) return readSteered(node, drives, own);
  std::vector<const char*> needed{left, right, "wheel_radius", "wheel_separation"};
  if (body.kind == BodyKind::kMecanum) needed.push_back("wheel_base");
  for (const char* key : needed) {
    if (group.has(key)) continue;
    if (!own) return std::nullopt;
    throw ConfigError(group.keyName(key) +
                      " is missing; a body has left, right, wheel_radius, wheel_separation, of the kind mecanum "
                      "wheel_base, too");
  }
  body.left = members(group, left, drives, !own);
  body.right = members(group, right, drives, !own);
  body.wheel_radius = group.positive("wheel_radius", 0.0);
  body.wheel_separation = group.positive("wheel_separation", 0.0);
  if (body.kind == BodyKind::kMecanum) {
    body.wheel_base = group.positive("wheel_base", 0.0);
    if (body.left.size() != 2) refuse(group.keyName(left), group[left], "two of them, the front one first");
    if (body.right.size() != 2) refuse(group.keyName(right), group[right], "two of them, the front one first");
  }
  return body;
}

}  // namespace nord_driver::sim
