// Parameters as the parameter server hands them out, written down in a line.
#pragma once

#include <XmlRpcValue.h>

#include <string>
#include <vector>

namespace nord_driver::node {

template <typename T>
XmlRpc::XmlRpcValue listOf(const std::vector<T>& items) {
  XmlRpc::XmlRpcValue list;
  list.setSize(static_cast<int>(items.size()));
  for (int i = 0; i < list.size(); ++i) list[i] = items[static_cast<std::size_t>(i)];
  return list;
}

/// Two drives that can be configured, and the base they carry.
inline XmlRpc::XmlRpcValue robotParameters() {
  XmlRpc::XmlRpcValue value;
  for (const char* name : {"left", "right"}) {
    XmlRpc::XmlRpcValue drive;
    drive["address"] = name == std::string{"left"} ? 3 : 4;
    drive["series"] = std::string{"sk5xxe"};
    drive["pole_pairs"] = 2;
    drive["joint"] = std::string{name} + "_wheel_joint";
    value["drives"][name] = drive;
  }
  value["bus"]["device"] = std::string{"/dev/ttyUSB0"};
  value["left_wheel"] = std::string{"left_wheel_joint"};
  value["right_wheel"] = std::string{"right_wheel_joint"};
  value["wheel_separation"] = 0.5;
  value["wheel_radius"] = 0.1;
  return value;
}

}  // namespace nord_driver::node
