// What a robot description (URDF) says of the wheels of a base: where they stand, how large they are, how fast they may
// turn.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace urdf {
class ModelInterface;
}

namespace nord_driver::robot {

/// m, in a plane.
struct Place2d {
  double x = 0.0;
  double y = 0.0;
};

/// Of a joint that goes to positions.
struct JointRange {
  bool is_prismatic = false;    ///< m; otherwise rad
  std::optional<double> lower;  ///< none: a continuous joint, or one without a limit
  std::optional<double> upper;
};

/// Answers are computed when they are asked for, so a value the user typed is not looked up: what the description says
/// of it may then be wrong or missing.
///
/// Every refusal is a std::invalid_argument with one sentence that begins with "robot_description", names the joint and
/// says what was expected. A joint is the wheel's when it is continuous and its chain of parents ends at the root that
/// carries `base_link` too; joints between (suspension, steering) are taken at their zero position.
class UrdfGeometry {
 public:
  /// Reads the XML. `base_link`: the link the base's motion is told of, x forward and y left (REP-103); a leading slash
  /// is dropped. Throws when the text is no URDF. That there is such a link is asked only by what is seen from it:
  /// `wheelSeparation`, `inLine` and `wheelBase` throw without it.
  explicit UrdfGeometry(const std::string& urdf, const std::string& base_link = "base_link");

  /// Distance (m) between the left and the right wheels across the direction of travel: the difference of the joints' y
  /// in `base_link`. (diff_drive_controller takes each joint relative to its own parent link, which is wrong as soon as
  /// the parents differ.) Throws also when the wheels stand in line, the left ones stand on the right, or wheels of one
  /// side stand more than 1 mm apart in y.
  double wheelSeparation(const std::vector<std::string>& left, const std::vector<std::string>& right) const;

  /// True when left and right do not differ in y of `base_link` by more than 1 mm: of a robot that was drawn with its
  /// wheels along x.
  bool inLine(const std::vector<std::string>& left, const std::vector<std::string>& right) const;

  /// Distance (m) between two wheel joints, whatever lies between them. Throws also when it is 1 mm or less.
  double jointDistance(const std::string& one, const std::string& other) const;

  /// Distance (m) between the front and the rear axle, for a base with two wheels a side, the front one first: the
  /// difference of the joints' x in `base_link`. Throws also when the sides differ by more than 1 mm.
  double wheelBase(const std::vector<std::string>& left, const std::vector<std::string>& right) const;

  /// Radius (m) of the wheels of one side, from a cylinder or sphere: of the wheel link's collision where it has one,
  /// otherwise of its visual; the largest where there are several. Throws also when there is none (a box or a mesh does
  /// not roll on a radius) and when wheels differ by more than 0.1 mm.
  double wheelRadius(const std::vector<std::string>& joints) const;

  /// Where the wheel on a steered axle stands in `base_link`, steered to 0. Throws also when the steering joint is no
  /// joint that turns, does not carry the wheel, its axis does not point upward (by more than a degree), or the wheel
  /// does not stand on that axis (by more than 1 mm).
  Place2d steeredWheel(const std::string& steering, const std::string& wheel) const;

  /// The `velocity` of each joint's `limit` (rad/s, positive), infinity where the joint has no limit. Throws also for a
  /// limit that is zero or negative: such a wheel could never turn.
  std::vector<double> maxVelocities(const std::vector<std::string>& joints) const;

  /// How far a joint goes; none: there is no such joint. Throws when it can neither turn nor slide.
  std::optional<JointRange> range(const std::string& joint) const;

 private:
  std::shared_ptr<const urdf::ModelInterface> model_;
  std::string base_link_;
};

}  // namespace nord_driver::robot
