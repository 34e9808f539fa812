#include "robot/urdf_geometry.h"

#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace nord_driver::robot {
namespace {

using Names = std::vector<std::string>;

constexpr double kSamePlace = 1e-3;   // m
constexpr double kSameRadius = 1e-4;  // m

template <typename... Words>
[[noreturn]] void refuse(const Words&... words) {
  std::ostringstream text;
  text << "robot_description: ";
  (text << ... << words);
  throw std::invalid_argument(text.str());
}

std::string quoted(const std::string& name) {
  return "\"" + name + "\"";
}

const char* nameOf(int joint_type) {
  switch (joint_type) {
    case urdf::Joint::REVOLUTE:
      return "revolute";
    case urdf::Joint::CONTINUOUS:
      return "continuous";
    case urdf::Joint::PRISMATIC:
      return "prismatic";
    case urdf::Joint::FLOATING:
      return "floating";
    case urdf::Joint::PLANAR:
      return "planar";
    case urdf::Joint::FIXED:
      return "fixed";
    default:
      return "of no known type";
  }
}

const urdf::Joint& wheelJoint(const urdf::ModelInterface& model, const std::string& name) {
  const auto joint = model.getJoint(name);
  if (!joint) refuse("there is no joint ", quoted(name), ", expected the continuous joint of a wheel");
  if (joint->type != urdf::Joint::CONTINUOUS) {
    refuse("joint ", quoted(name), " is ", nameOf(joint->type), ", expected the continuous joint of a wheel");
  }
  return *joint;
}

const urdf::Joint& steeringJoint(const urdf::ModelInterface& model, const std::string& name) {
  const auto joint = model.getJoint(name);
  if (!joint) refuse("there is no joint ", quoted(name), ", expected the revolute joint of a steered wheel");
  if (joint->type != urdf::Joint::REVOLUTE && joint->type != urdf::Joint::CONTINUOUS) {
    refuse("joint ", quoted(name), " is ", nameOf(joint->type), ", expected the revolute joint of a steered wheel");
  }
  return *joint;
}

/// `inner`, given in the frame that stands at `outer`, in the frame `outer` is given in.
urdf::Pose compose(urdf::Pose outer, const urdf::Pose& inner) {  // a copy: its operators are not const
  urdf::Pose pose;
  pose.position = outer.position + outer.rotation * inner.position;
  pose.rotation = outer.rotation * inner.rotation;
  return pose;
}

/// Where `link` stands in the root link's frame; nothing when its chain of parents does not end there.
std::optional<urdf::Pose> poseInRoot(const urdf::ModelInterface& model, const std::string& link) {
  urdf::Pose pose;
  std::string at = link;
  // A description may hold a ring of links beside its tree; the count ends the walk.
  for (std::size_t i = 0; i <= model.links_.size(); ++i) {
    if (model.getRoot() && at == model.getRoot()->name) return pose;
    const auto here = model.getLink(at);
    if (!here || !here->parent_joint) return std::nullopt;
    pose = compose(here->parent_joint->parent_to_joint_origin_transform, pose);
    at = here->parent_joint->parent_link_name;
  }
  return std::nullopt;
}

/// `link` is `carrier`, or hangs on it.
bool carries(const urdf::ModelInterface& model, const std::string& carrier, const std::string& link) {
  std::string at = link;
  for (std::size_t i = 0; i <= model.links_.size(); ++i) {  // as in poseInRoot
    if (at == carrier) return true;
    const auto here = model.getLink(at);
    if (!here || !here->parent_joint) return false;
    at = here->parent_joint->parent_link_name;
  }
  return false;
}

/// Where a wheel's joint stands in the root link's frame. The joint's frame is its child link's.
urdf::Vector3 positionOf(const urdf::ModelInterface& model, const std::string& name) {
  const auto wheel = poseInRoot(model, wheelJoint(model, name).child_link_name);
  if (!wheel) refuse("joint ", quoted(name), " does not hang on the tree of links");
  const urdf::Vector3& at = wheel->position;
  if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z)) {
    refuse("joint ", quoted(name), " stands at no finite place");
  }
  return at;
}

urdf::Pose baseIn(const urdf::ModelInterface& model, const std::string& base_link) {
  if (!model.getLink(base_link)) refuse("there is no link ", quoted(base_link), ", expected the link of the base");
  const auto pose = poseInRoot(model, base_link);
  if (!pose) refuse("link ", quoted(base_link), " does not hang on the tree of links");
  return *pose;
}

/// A wheel as seen from `base_link`.
struct Place {
  std::string joint;
  double x = 0.0;
  double y = 0.0;
};

/// `at`, seen from `base`; both in the root link's frame.
Place2d seenFrom(urdf::Pose base, const urdf::Vector3& at) {  // a copy: its operators are not const
  const urdf::Vector3 away(at.x - base.position.x, at.y - base.position.y, at.z - base.position.z);
  const urdf::Vector3 seen = base.rotation.GetInverse() * away;
  return {seen.x, seen.y};
}

Place placeOf(const urdf::ModelInterface& model, const std::string& base_link, const std::string& name) {
  const urdf::Pose base = baseIn(model, base_link);
  const Place2d seen = seenFrom(base, positionOf(model, name));
  return {name, seen.x, seen.y};
}

std::vector<Place> placesOf(const urdf::ModelInterface& model, const std::string& base_link, const Names& joints) {
  if (joints.empty()) refuse("no joint was named, expected at least one wheel a side");
  std::vector<Place> places;
  for (const std::string& joint : joints) places.push_back(placeOf(model, base_link, joint));
  return places;
}

double meanY(const std::vector<Place>& side) {
  double sum = 0.0;
  for (const Place& wheel : side) sum += wheel.y;
  return sum / static_cast<double>(side.size());
}

/// The y all wheels of a side have in common.
double lineOf(const std::vector<Place>& side) {
  for (const Place& wheel : side) {
    if (std::abs(wheel.y - side.front().y) > kSamePlace) {
      refuse("joint ", quoted(side.front().joint), " stands at y = ", side.front().y, " m and joint ",
             quoted(wheel.joint), " at y = ", wheel.y,
             " m, expected the wheels of one side in one line (or wheel_separation typed in)");
    }
  }
  return meanY(side);
}

const char* nameOf(const urdf::GeometrySharedPtr& geometry) {
  if (!geometry) return "nothing";
  switch (geometry->type) {
    case urdf::Geometry::SPHERE:
      return "a sphere";
    case urdf::Geometry::BOX:
      return "a box";
    case urdf::Geometry::CYLINDER:
      return "a cylinder";
    case urdf::Geometry::MESH:
      return "a mesh";
    default:
      return "an unknown shape";
  }
}

double radiusOf(const urdf::GeometrySharedPtr& geometry) {
  if (const auto cylinder = std::dynamic_pointer_cast<const urdf::Cylinder>(geometry)) return cylinder->radius;
  if (const auto sphere = std::dynamic_pointer_cast<const urdf::Sphere>(geometry)) return sphere->radius;
  return 0.0;
}

/// The largest of the shapes that roll; 0 without one. What else there is goes into `seen`.
template <typename Shapes>
double largestRadius(const Shapes& shapes, std::string& seen) {
  double radius = 0.0;
  for (const auto& shape : shapes) {
    if (!shape) continue;
    seen = nameOf(shape->geometry);
    radius = std::max(radius, radiusOf(shape->geometry));
  }
  return radius;
}

double radiusOfWheel(const urdf::ModelInterface& model, const std::string& name) {
  const std::string& link_name = wheelJoint(model, name).child_link_name;
  const auto link = model.getLink(link_name);
  std::string seen = "no shape";
  double radius = link ? largestRadius(link->collision_array, seen) : 0.0;
  if (!(radius > 0.0) && link) radius = largestRadius(link->visual_array, seen);
  if (radius > 0.0 && std::isfinite(radius)) return radius;
  refuse("the wheel link ", quoted(link_name), " of joint ", quoted(name), " has ", seen,
         ", expected a cylinder or a sphere with a radius greater than 0 (or wheel_radius typed in)");
}

}  // namespace

UrdfGeometry::UrdfGeometry(const std::string& urdf, const std::string& base_link)
    : base_link_(base_link.substr(std::min(base_link.find_first_not_of('/'), base_link.size()))) {
  try {
    model_ = urdf::parseURDF(urdf);
  } catch (const std::exception& error) {
    refuse("expected the XML of a URDF, and reading it failed: ", error.what());
  }
  if (!model_) refuse("expected the XML of a URDF: one tree of links and joints, each complete");
}

double UrdfGeometry::wheelSeparation(const Names& left, const Names& right) const {
  const double left_line = lineOf(placesOf(*model_, base_link_, left));
  const double right_line = lineOf(placesOf(*model_, base_link_, right));
  const double separation = left_line - right_line;
  if (separation > kSamePlace) return separation;
  const bool in_line = std::abs(separation) <= kSamePlace;
  refuse("joint ", quoted(left.front()), " stands at y = ", left_line, " m and joint ", quoted(right.front()),
         " at y = ", right_line, " m in ", quoted(base_link_), ": ",
         in_line ? "the wheels stand in line, expected some distance between left and right"
                 : "left and right are exchanged, expected y to grow to the left",
         " (or wheel_separation typed in)");
}

bool UrdfGeometry::inLine(const Names& left, const Names& right) const {
  return std::abs(meanY(placesOf(*model_, base_link_, left)) - meanY(placesOf(*model_, base_link_, right))) <=
         kSamePlace;
}

double UrdfGeometry::jointDistance(const std::string& one, const std::string& other) const {
  const urdf::Vector3 a = positionOf(*model_, one);
  const urdf::Vector3 b = positionOf(*model_, other);
  const double distance = std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
  if (distance > kSamePlace) return distance;
  refuse("joint ", quoted(one), " and joint ", quoted(other),
         " stand in one place, expected some distance between left and right (or wheel_separation typed in)");
}

double UrdfGeometry::wheelBase(const Names& left, const Names& right) const {
  if (left.size() != 2 || right.size() != 2) {
    refuse("there are ", left.size(), " left and ", right.size(),
           " right wheels, expected two a side, the front one first");
  }
  const auto distance = [this](const Names& side) {
    const std::vector<Place> places = placesOf(*model_, base_link_, side);
    const double length = places[0].x - places[1].x;
    if (length > kSamePlace) return length;
    refuse("joint ", quoted(side[0]), " stands at x = ", places[0].x, " m and joint ", quoted(side[1]),
           " at x = ", places[1].x, " m, expected the front wheel first and the rear wheel behind it");
  };
  const double of_left = distance(left);
  const double of_right = distance(right);
  if (std::abs(of_left - of_right) > kSamePlace) {
    refuse("the joints ", quoted(left[0]), " and ", quoted(left[1]), " stand ", of_left, " m apart, but ",
           quoted(right[0]), " and ", quoted(right[1]), " ", of_right,
           " m, expected the same on both sides (or wheel_base typed in)");
  }
  return (of_left + of_right) / 2.0;
}

double UrdfGeometry::wheelRadius(const Names& joints) const {
  if (joints.empty()) refuse("no joint was named, expected at least one wheel a side");
  const double radius = radiusOfWheel(*model_, joints.front());
  for (const std::string& joint : joints) {
    const double other = radiusOfWheel(*model_, joint);
    if (std::abs(other - radius) > kSameRadius) {
      refuse("the wheel of joint ", quoted(joints.front()), " has a radius of ", radius, " m and that of joint ",
             quoted(joint), " of ", other,
             " m, expected the same for the wheels of one side (or wheel_radius typed in)");
    }
  }
  return radius;
}

Place2d UrdfGeometry::steeredWheel(const std::string& steering, const std::string& wheel) const {
  const urdf::Joint& joint = steeringJoint(*model_, steering);
  if (!carries(*model_, joint.child_link_name, wheelJoint(*model_, wheel).parent_link_name)) {
    refuse("joint ", quoted(steering), " does not carry joint ", quoted(wheel));
  }
  const auto pose = poseInRoot(*model_, joint.child_link_name);
  if (!pose) refuse("joint ", quoted(steering), " does not hang on the tree of links");
  urdf::Pose base = baseIn(*model_, base_link_);
  urdf::Rotation turned = pose->rotation;
  const urdf::Vector3 axis = base.rotation.GetInverse() * (turned * joint.axis);
  constexpr double kOneDegree = 0.99985;  // its cosine
  // The parser takes an axis of any length.
  const double length = std::hypot(axis.x, axis.y, axis.z);
  if (!(length > 0.0 && axis.z >= kOneDegree * length)) {
    refuse("the axis of joint ", quoted(steering), " is ", axis.x, " ", axis.y, " ", axis.z, " in ", quoted(base_link_),
           ", expected 0 0 1: a steering angle grows counter-clockwise seen from above");
  }
  const Place2d stands = seenFrom(base, positionOf(*model_, wheel));
  const Place2d turns = seenFrom(base, pose->position);
  const double beside = std::hypot(stands.x - turns.x, stands.y - turns.y);
  if (beside > kSamePlace) {
    refuse("joint ", quoted(wheel), " stands ", beside, " m beside the axis of joint ", quoted(steering),
           ", expected the wheel of a steered axle on it (or x and y typed in)");
  }
  return stands;
}

std::vector<double> UrdfGeometry::maxVelocities(const Names& joints) const {
  std::vector<double> velocities;
  for (const std::string& name : joints) {
    const auto& limits = wheelJoint(*model_, name).limits;
    const double velocity = limits ? limits->velocity : std::numeric_limits<double>::infinity();
    if (!(velocity > 0.0)) {
      refuse("the velocity limit of joint ", quoted(name), " is ", velocity,
             " rad/s, expected a number greater than 0, or no limit at all");
    }
    velocities.push_back(velocity);
  }
  return velocities;
}

std::optional<JointRange> UrdfGeometry::range(const std::string& name) const {
  const auto joint = model_->getJoint(name);
  if (!joint) return std::nullopt;
  JointRange range;
  range.is_prismatic = joint->type == urdf::Joint::PRISMATIC;
  if (joint->type == urdf::Joint::CONTINUOUS) return range;
  if (joint->type != urdf::Joint::REVOLUTE && !range.is_prismatic) {
    refuse("joint ", quoted(name), " is ", nameOf(joint->type), ", expected one that turns or slides");
  }
  if (!joint->limits) return range;
  range.lower = joint->limits->lower;
  range.upper = joint->limits->upper;
  return range;
}

}  // namespace nord_driver::robot
