#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "robot/urdf_geometry.h"
#include "robot/urdf_robots.h"

namespace nord_driver::robot {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Names = std::vector<std::string>;

const Names kLeft{"left_joint"};
const Names kRight{"right_joint"};

/// The sentence `ask` is refused with.
template <typename Ask>
std::string refusalOf(Ask ask) {
  try {
    ask();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusalOfText(const std::string& urdf) {
  return refusalOf([&] { UrdfGeometry{urdf}; });
}

std::string refusalOfSeparation(const std::string& urdf, const Names& left = kLeft, const Names& right = kRight) {
  return refusalOf([&] { UrdfGeometry(urdf).wheelSeparation(left, right); });
}

std::string refusalOfRadius(const std::string& shapes) {
  const UrdfGeometry geometry(urdfRobot(urdfLink("base_link") + urdfWheel("left", "0 0 0", "base_link", shapes)));
  return refusalOf([&] { geometry.wheelRadius(kLeft); });
}

double radiusOf(const std::string& shapes) {
  return UrdfGeometry(urdfRobot(urdfLink("base_link") + urdfWheel("left", "0 0 0", "base_link", shapes)))
      .wheelRadius(kLeft);
}

/// Two wheels a side; `rear_left` moves one of them.
std::string fourWheels(const std::string& rear_left = "-0.3 0.25 0") {
  return urdfRobot(urdfLink("base_link") + urdfWheel("front_left", "0.3 0.25 0") + urdfWheel("rear_left", rear_left) +
                   urdfWheel("front_right", "0.3 -0.25 0") + urdfWheel("rear_right", "-0.3 -0.25 0"));
}
const Names kLefts{"front_left_joint", "rear_left_joint"};
const Names kRights{"front_right_joint", "rear_right_joint"};

TEST(UrdfGeometry, TwoWheelsOnTheBase) {
  const UrdfGeometry geometry(urdfTwoWheels());
  EXPECT_NEAR(0.5, geometry.wheelSeparation(kLeft, kRight), 1e-12);
  EXPECT_NEAR(0.1, geometry.wheelRadius(kLeft), 1e-12);
}

// The wheels hang on links of their own 0.2 m beside the base, one of them turned by a half turn: relative to their
// parents the joints would be 0.1 m or nothing apart, in base_link they are 0.6 m.
TEST(UrdfGeometry, SeparationIsTakenInTheBaseNotInTheParents) {
  const UrdfGeometry geometry(urdfRobot(
      urdfLink("base_link") + urdfLink("left_arm") + urdfLink("right_arm") +
      urdfJoint("left_mount", "fixed", "base_link", "left_arm", "xyz=\"0 0.2 0\"") +
      urdfJoint("right_mount", "fixed", "base_link", "right_arm", "xyz=\"0 -0.2 0\" rpy=\"0 0 3.14159265358979\"") +
      urdfWheel("left", "0 0.1 0", "left_arm") + urdfWheel("right", "0 0.1 0", "right_arm")));
  EXPECT_NEAR(0.6, geometry.wheelSeparation(kLeft, kRight), 1e-9);
}

// base_link below base_footprint, the wheels on a chassis turned by a right angle: what lies along the chassis' x lies
// along the base's y.
TEST(UrdfGeometry, FollowsTheWholeChainOfJoints) {
  const UrdfGeometry geometry(
      urdfRobot(urdfLink("base_footprint") + urdfLink("base_link") + urdfLink("chassis") +
                urdfJoint("foot", "fixed", "base_footprint", "base_link", "xyz=\"1 2 3\" rpy=\"0 0 0.7\"") +
                urdfJoint("mount", "fixed", "base_link", "chassis", "xyz=\"0 0 0.2\" rpy=\"0 0 1.57079632679490\"") +
                urdfWheel("left", "0.4 0.1 0", "chassis") + urdfWheel("right", "-0.4 0.1 0", "chassis")));
  EXPECT_NEAR(0.8, geometry.wheelSeparation(kLeft, kRight), 1e-9);
}

// The link asked for need not carry the wheels, only hang on the same tree; rviz' leading slash is dropped.
TEST(UrdfGeometry, BaseLinkMayBeALeaf) {
  const UrdfGeometry geometry(
      urdfRobot(urdfLink("chassis") + urdfLink("base_footprint") +
                urdfJoint("foot", "fixed", "chassis", "base_footprint", "xyz=\"0 0 -0.1\"") +
                urdfWheel("left", "0 0.25 0", "chassis") + urdfWheel("right", "0 -0.25 0", "chassis")),
      "/base_footprint");
  EXPECT_NEAR(0.5, geometry.wheelSeparation(kLeft, kRight), 1e-12);
}

TEST(UrdfGeometry, SeveralWheelsASide) {
  const UrdfGeometry geometry(fourWheels());
  EXPECT_NEAR(0.5, geometry.wheelSeparation(kLefts, kRights), 1e-12);
  EXPECT_NEAR(0.6, geometry.wheelBase(kLefts, kRights), 1e-12);
  EXPECT_NEAR(0.1, geometry.wheelRadius(kLefts), 1e-12);
}

// Wheels of one side that disagree are named, both.
TEST(UrdfGeometry, RefusesWheelsOfASideThatDisagree) {
  EXPECT_THAT(refusalOfSeparation(fourWheels("-0.3 0.28 0"), kLefts, kRights),
              AllOf(HasSubstr("\"front_left_joint\" stands at y = 0.25 m"),
                    HasSubstr("\"rear_left_joint\" at y = 0.28 m"), HasSubstr("wheel_separation typed in")));
  const UrdfGeometry sizes(
      urdfRobot(urdfLink("base_link") + urdfWheel("left", "0 0.25 0") +
                urdfWheel("rear", "-1 0.25 0", "base_link", urdfShape("collision", "<sphere radius=\"0.11\"/>"))));
  EXPECT_THAT(refusalOf([&] {
                sizes.wheelRadius({"left_joint", "rear_joint"});
              }),
              AllOf(HasSubstr("\"left_joint\" has a radius of 0.1 m"), HasSubstr("\"rear_joint\" of 0.11 m")));
}

// 0.1 mm is told as the same: twice as much as 0.1 mm is so to the last bit.
TEST(UrdfGeometry, WheelsOfASideMayDifferByATenthOfAMillimetre) {
  const auto radius = [](const char* first, const char* second) {
    const auto sphere = [](const char* size) {
      return urdfShape("collision", std::string("<sphere radius=\"") + size + "\"/>");
    };
    const UrdfGeometry sizes(urdfRobot(urdfLink("base_link") +
                                       urdfWheel("left", "0 0.25 0", "base_link", sphere(first)) +
                                       urdfWheel("rear", "-1 0.25 0", "base_link", sphere(second))));
    return sizes.wheelRadius({"left_joint", "rear_joint"});
  };
  EXPECT_EQ(0.0001, radius("0.0001", "0.0002"));
  EXPECT_EQ(0.0002, radius("0.0002", "0.0001"));
  EXPECT_THAT(refusalOf([&] { radius("0.1", "0.10011"); }), HasSubstr("a radius of 0.1 m"));
}

// Mecanum: the front wheel first, as far apart on both sides.
TEST(UrdfGeometry, RefusesAWheelBaseThatIsNone) {
  const UrdfGeometry askew(fourWheels("-0.4 0.25 0"));
  EXPECT_THAT(refusalOf([&] { askew.wheelBase(kLefts, kRights); }),
              AllOf(HasSubstr("0.7 m apart"), HasSubstr("0.6 m, expected the same on both sides")));
  const UrdfGeometry geometry(fourWheels());
  EXPECT_THAT(refusalOf([&] {
                geometry.wheelBase({"rear_left_joint", "front_left_joint"}, kRights);
              }),
              HasSubstr("expected the front wheel first"));
  EXPECT_THAT(refusalOf([&] { geometry.wheelBase(kLefts, {"front_right_joint"}); }), HasSubstr("two a side"));
}

TEST(UrdfGeometry, RadiusOfCylinderOrSphere) {
  EXPECT_NEAR(0.1, radiusOf(urdfShape("collision", kCylinder)), 1e-12);
  EXPECT_NEAR(0.2, radiusOf(urdfShape("collision", "<sphere radius=\"0.2\"/>")), 1e-12);
  EXPECT_NEAR(0.1, radiusOf(urdfShape("visual", kCylinder)), 1e-12);
}

// The collision counts before the visual, whatever the order; a collision that does not roll leaves it to the visual.
TEST(UrdfGeometry, CollisionBeforeVisual) {
  const std::string sphere = "<sphere radius=\"0.2\"/>";
  const std::string box = "<box size=\"1 1 1\"/>";
  EXPECT_NEAR(0.1, radiusOf(urdfShape("visual", sphere) + urdfShape("collision", kCylinder)), 1e-12);
  EXPECT_NEAR(0.2, radiusOf(urdfShape("visual", sphere) + urdfShape("collision", box)), 1e-12);
}

// A hub in the tyre: the tyre rolls.
TEST(UrdfGeometry, TheLargestOfSeveralShapesRolls) {
  EXPECT_NEAR(0.15,
              radiusOf(urdfShape("collision", kCylinder) +
                       urdfShape("collision", "<cylinder radius=\"0.15\" length=\"0.04\"/>")),
              1e-12);
}

TEST(UrdfGeometry, RefusesAWheelThatDoesNotRoll) {
  EXPECT_THAT(refusalOfRadius(urdfShape("collision", "<box size=\"1 1 1\"/>")),
              AllOf(HasSubstr("\"left_link\""), HasSubstr("\"left_joint\""), HasSubstr("has a box"),
                    HasSubstr("expected a cylinder or a sphere")));
  EXPECT_THAT(refusalOfRadius(urdfShape("visual", "<mesh filename=\"wheel.stl\"/>")), HasSubstr("has a mesh"));
  EXPECT_THAT(refusalOfRadius(""), HasSubstr("has no shape"));
  EXPECT_THAT(refusalOfRadius(urdfShape("collision", "<sphere radius=\"0\"/>")), HasSubstr("greater than 0"));
}

TEST(UrdfGeometry, RefusesAJointThatIsMissing) {
  const std::string sentence = refusalOfSeparation(urdfTwoWheels(), {"wheel_joint"});
  EXPECT_EQ("robot_description: there is no joint \"wheel_joint\", expected the continuous joint of a wheel", sentence);
  const UrdfGeometry geometry(urdfTwoWheels());
  EXPECT_THAT(refusalOf([&] { geometry.wheelRadius({"wheel_joint"}); }), HasSubstr("no joint \"wheel_joint\""));
  EXPECT_THAT(refusalOf([&] { geometry.maxVelocities({"wheel_joint"}); }), HasSubstr("no joint \"wheel_joint\""));
  EXPECT_THAT(refusalOf([&] { geometry.wheelRadius({}); }), HasSubstr("no joint was named"));
  EXPECT_THAT(refusalOfSeparation(urdfTwoWheels(), {}), HasSubstr("no joint was named"));
}

// A wheel turns without end; a joint that cannot is named with its type.
TEST(UrdfGeometry, RefusesAJointThatIsNotContinuous) {
  const auto with = [](const std::string& type) {
    return refusalOfSeparation(urdfRobot(urdfLink("base_link") + urdfLink("left_link") +
                                         urdfWheel("right", "0 -0.25 0") +
                                         urdfJoint("left_joint", type, "base_link", "left_link", "xyz=\"0 0.25 0\"",
                                                   "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>")));
  };
  EXPECT_THAT(with("fixed"), HasSubstr("joint \"left_joint\" is fixed, expected the continuous joint of a wheel"));
  EXPECT_THAT(with("revolute"), HasSubstr("is revolute"));
  EXPECT_THAT(with("prismatic"), HasSubstr("is prismatic"));
  EXPECT_THAT(with("floating"), HasSubstr("is floating"));
}

// Two links that are each other's parents, beside a tree that is in order: the joint is there and hangs on nothing.
TEST(UrdfGeometry, RefusesAJointThatHangsOnNothing) {
  const std::string ring = urdfRobot(urdfLink("base_link") + urdfWheel("right", "0 -0.25 0") + urdfLink("a") +
                                     urdfLink("b") + urdfJoint("left_joint", "continuous", "a", "b", "xyz=\"0 1 0\"") +
                                     urdfJoint("back", "fixed", "b", "a", "xyz=\"0 0 0\""));
  EXPECT_THAT(refusalOfSeparation(ring), HasSubstr("joint \"left_joint\" does not hang on the tree of links"));
  EXPECT_THAT(refusalOf([&] { UrdfGeometry(ring, "a").wheelSeparation(kRight, kLeft); }),
              HasSubstr("link \"a\" does not hang on the tree"));
}

// Wheels in line have no separation; exchanged wheels would turn the base the wrong way.
TEST(UrdfGeometry, RefusesWheelsInLineAndExchangedWheels) {
  const std::string in_line =
      urdfRobot(urdfLink("base_link") + urdfWheel("left", "0.2 0.1 0") + urdfWheel("right", "-0.2 0.1 0"));
  EXPECT_THAT(refusalOfSeparation(in_line), AllOf(HasSubstr("\"left_joint\" stands at y = 0.1 m"),
                                                  HasSubstr("\"right_joint\" at y = 0.1 m"), HasSubstr("in line")));
  EXPECT_THAT(refusalOfSeparation(urdfTwoWheels(), kRight, kLeft), HasSubstr("left and right are exchanged"));
}

TEST(UrdfGeometry, RefusesWhatIsNoUrdf) {
  for (const std::string& text : {std::string{}, std::string{"left_wheel"}, std::string{"<robot name=\"a\"><link"},
                                  std::string{"<?xml version=\"1.0\"?><html/>"}, urdfRobot("")}) {
    EXPECT_THAT(refusalOfText(text), HasSubstr("robot_description: expected the XML of a URDF")) << text;
  }
  // A wheel on a link that is nowhere.
  EXPECT_THAT(refusalOfText(urdfRobot(urdfLink("base_link") + urdfWheel("left", "0 1 0", "chassis"))),
              HasSubstr("expected the XML of a URDF"));
  EXPECT_THAT(refusalOfText(urdfRobot(urdfLink("base_link") + urdfWheel("left", "0 wide 0"))),
              HasSubstr("expected the XML of a URDF"));
}

// What is seen from the base needs its link; what a joint or a wheel says of itself does not.
TEST(UrdfGeometry, TheBaseLinkIsAskedForOnlyWhereItCounts) {
  const UrdfGeometry geometry(urdfTwoWheels(), "base");
  EXPECT_THAT(refusalOf([&] { geometry.wheelSeparation(kLeft, kRight); }), HasSubstr("there is no link \"base\""));
  EXPECT_THAT(refusalOf([&] { geometry.inLine(kLeft, kRight); }), HasSubstr("there is no link \"base\""));
  EXPECT_THAT(refusalOf([&] { geometry.wheelBase(kLefts, kRights); }), HasSubstr("there is no link \"base\""));
  EXPECT_NEAR(0.1, geometry.wheelRadius(kLeft), 1e-12);
  EXPECT_NEAR(0.5, geometry.jointDistance("left_joint", "right_joint"), 1e-12);
  EXPECT_EQ(1u, geometry.maxVelocities(kLeft).size());
}

// Two wheels a side on both ends of x: what differs in y within a side is the same on both.
TEST(UrdfGeometry, WheelsAlongX) {
  const UrdfGeometry turned(urdfRobot(urdfLink("base_link") + urdfWheel("a", "0.3 0.35 0") +
                                      urdfWheel("b", "0.3 -0.35 0") + urdfWheel("c", "-0.2 0.35 0") +
                                      urdfWheel("d", "-0.2 -0.35 0")));
  EXPECT_TRUE(turned.inLine({"a_joint", "b_joint"}, {"c_joint", "d_joint"}));
  EXPECT_NEAR(0.5, turned.jointDistance("a_joint", "c_joint"), 1e-12);
  EXPECT_FALSE(UrdfGeometry(urdfTwoWheels()).inLine(kLeft, kRight));
  EXPECT_THAT(refusalOf([&] { turned.jointDistance("a_joint", "a_joint"); }), HasSubstr("stand in one place"));
}

// The velocity limit is the joint's own; without one there is none.
TEST(UrdfGeometry, JointVelocityLimits) {
  const auto with = [](const std::string& limit) {
    return UrdfGeometry(urdfRobot(urdfLink("base_link") + urdfWheel("left", "0 0.25 0", "base_link", "", limit) +
                                  urdfWheel("right", "0 -0.25 0")));
  };
  const UrdfGeometry geometry = with("<limit effort=\"10\" velocity=\"12.5\"/>");
  EXPECT_EQ((std::vector<double>{std::numeric_limits<double>::infinity(), 12.5}),
            geometry.maxVelocities({"right_joint", "left_joint"}));
  const UrdfGeometry never = with("<limit effort=\"10\" velocity=\"0\"/>");
  EXPECT_THAT(refusalOf([&] { never.maxVelocities({"left_joint"}); }),
              AllOf(HasSubstr("velocity limit of joint \"left_joint\" is 0 rad/s"), HasSubstr("greater than 0")));
}

// What is typed in is not asked for: a description with a box for a wheel still gives the separation.
TEST(UrdfGeometry, ABoxDoesNotHideTheSeparation) {
  const std::string box = urdfShape("collision", "<box size=\"1 1 1\"/>");
  const UrdfGeometry geometry(urdfRobot(urdfLink("base_link") + urdfWheel("left", "0 0.25 0", "base_link", box) +
                                        urdfWheel("right", "0 -0.25 0", "base_link", box)));
  EXPECT_NEAR(0.5, geometry.wheelSeparation(kLeft, kRight), 1e-12);
}

}  // namespace
}  // namespace nord_driver::robot
