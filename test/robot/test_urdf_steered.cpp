// Where a description has the wheel of a steered axle, and which joints may steer it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "robot/urdf_geometry.h"
#include "robot/urdf_robots.h"

namespace nord_driver::robot {
namespace {

using testing::HasSubstr;

/// An axle with its steering joint at `origin` of base_link; the wheel hangs at `wheel` of what that joint carries.
std::string steeredAxle(const std::string& origin, const std::string& type = "continuous",
                        const std::string& axis = "0 0 1", const std::string& wheel = "0 0 -0.1") {
  return urdfLink("fork") + "<joint name=\"steering\" type=\"" + type +
         "\"><parent link=\"base_link\"/><child link=\"fork\"/><origin " + origin + "/><axis xyz=\"" + axis +
         "\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>" +
         urdfWheel("wheel", wheel, "fork");
}

std::string robotWith(const std::string& axle) {
  return urdfRobot(urdfLink("base_link") + axle);
}

std::string refusalOf(const std::string& axle, const std::string& steering = "steering") {
  try {
    UrdfGeometry(robotWith(axle)).steeredWheel(steering, "wheel_joint");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(UrdfSteered, TheWheelStandsUnderItsAxis) {
  const Place2d place =
      UrdfGeometry(robotWith(steeredAxle("xyz=\"0.45 -0.2 0.3\""))).steeredWheel("steering", "wheel_joint");
  EXPECT_NEAR(0.45, place.x, 1e-12);
  EXPECT_NEAR(-0.2, place.y, 1e-12);
}

// Wherever the root of the description has the base, and however it lies there: seen from the base nothing changes.
TEST(UrdfSteered, PlacesAreThoseSeenFromTheBase) {
  for (const char* origin :
       {"xyz=\"1 2 3\"", "xyz=\"1 2 3\" rpy=\"0 0 1.2\"", "xyz=\"-1 0.5 2\" rpy=\"0.4 -0.7 2.5\""}) {
    const UrdfGeometry geometry(urdfRobot(urdfLink("world") +
                                          urdfJoint("stand", "fixed", "world", "base_link", origin) +
                                          urdfLink("base_link") + steeredAxle("xyz=\"0.45 -0.2 0.3\"") +
                                          urdfWheel("left", "0.1 0.25 0.1") + urdfWheel("right", "0.1 -0.35 0.1")));
    const Place2d place = geometry.steeredWheel("steering", "wheel_joint");
    EXPECT_NEAR(0.45, place.x, 1e-9) << origin;
    EXPECT_NEAR(-0.2, place.y, 1e-9) << origin;
    EXPECT_NEAR(0.6, geometry.wheelSeparation({"left_joint"}, {"right_joint"}), 1e-9) << origin;
  }
}

TEST(UrdfSteered, AJointThatTurnsMaySteer) {
  for (const char* type : {"revolute", "continuous"})
    EXPECT_EQ("accepted", refusalOf(steeredAxle("xyz=\"0 0 0\"", type)));
  for (const char* type : {"prismatic", "fixed"}) {
    EXPECT_THAT(
        refusalOf(steeredAxle("xyz=\"0 0 0\"", type)),
        HasSubstr("joint \"steering\" is " + std::string{type} + ", expected the revolute joint of a steered wheel"));
  }
  EXPECT_THAT(refusalOf(steeredAxle("xyz=\"0 0 0\""), "no_joint"), HasSubstr("there is no joint \"no_joint\""));
}

// A steering angle grows counter-clockwise seen from above; a degree beside that is within what a drawing may have.
TEST(UrdfSteered, ItsAxisPointsUp) {
  for (const char* axis : {"0 0 -1", "0 1 0", "0.05 0 1", "1 0 1", "0.03 0 0.5"}) {
    EXPECT_THAT(refusalOf(steeredAxle("xyz=\"0 0 0\"", "continuous", axis)), HasSubstr("expected 0 0 1")) << axis;
  }
  for (const char* axis : {"0 0 1", "0 0 0.5", "0 0 2", "0.01 0 1"}) {
    EXPECT_EQ("accepted", refusalOf(steeredAxle("xyz=\"0 0 0\"", "continuous", axis, "0 0 0"))) << axis;
  }
  EXPECT_EQ("accepted", refusalOf(steeredAxle("xyz=\"0 0 0\" rpy=\"0.01 0 0\"", "continuous", "0 0 1", "0 0 0")));
}

TEST(UrdfSteered, AWheelBesideItsAxisIsRefused) {
  EXPECT_EQ("accepted", refusalOf(steeredAxle("xyz=\"0 0 0\"", "continuous", "0 0 1", "0.0005 0 0")));
  EXPECT_THAT(refusalOf(steeredAxle("xyz=\"0 0 0\"", "continuous", "0 0 1", "0 0.02 0")),
              HasSubstr("stands 0.02 m beside the axis"));
}

// A wheel on the base, and one on a ring of links beside the tree: a steering joint turns neither of them.
TEST(UrdfSteered, AWheelThatHangsElsewhereIsRefused) {
  const std::string fork = urdfLink("fork") + urdfJoint("steering", "continuous", "base_link", "fork", "xyz=\"0 0 0\"");
  const std::string expected = "joint \"steering\" does not carry joint \"wheel_joint\"";
  EXPECT_THAT(refusalOf(fork + urdfWheel("wheel", "0 0 0", "base_link")), HasSubstr(expected));
  const std::string ring = urdfLink("a") + urdfLink("b") + urdfJoint("forth", "fixed", "a", "b", "xyz=\"0 0 0\"") +
                           urdfJoint("back", "fixed", "b", "a", "xyz=\"0 0 0\"");
  EXPECT_THAT(refusalOf(fork + ring + urdfWheel("wheel", "0 0 0", "a")), HasSubstr(expected));
}

}  // namespace
}  // namespace nord_driver::robot
