// Robot descriptions for the tests of this folder, put together from pieces.
#pragma once

#include <string>

namespace nord_driver::robot {

inline std::string urdfRobot(const std::string& inside) {
  return "<?xml version=\"1.0\"?><robot name=\"robot\">" + inside + "</robot>";
}

inline std::string urdfLink(const std::string& name, const std::string& inside = "") {
  return "<link name=\"" + name + "\">" + inside + "</link>";
}

inline std::string urdfShape(const std::string& element, const std::string& geometry) {
  return "<" + element + "><geometry>" + geometry + "</geometry></" + element + ">";
}

inline const char* const kCylinder = "<cylinder radius=\"0.1\" length=\"0.05\"/>";

inline std::string urdfJoint(const std::string& name, const std::string& type, const std::string& parent,
                             const std::string& child, const std::string& origin, const std::string& inside = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent + "\"/><child link=\"" + child +
         "\"/><origin " + origin + "/><axis xyz=\"0 1 0\"/>" + inside + "</joint>";
}

/// A wheel link and its continuous joint at `xyz` of `parent`: "left" gives "left_link" and "left_joint".
inline std::string urdfWheel(const std::string& name, const std::string& xyz, const std::string& parent = "base_link",
                             const std::string& shapes = urdfShape("collision", kCylinder),
                             const std::string& inside = "") {
  return urdfLink(name + "_link", shapes) +
         urdfJoint(name + "_joint", "continuous", parent, name + "_link", "xyz=\"" + xyz + "\"", inside);
}

/// Two wheels of 0.1 m, 0.5 m apart.
inline std::string urdfTwoWheels() {
  return urdfRobot(urdfLink("base_link") + urdfWheel("left", "0 0.25 0.1") + urdfWheel("right", "0 -0.25 0.1"));
}

}  // namespace nord_driver::robot
