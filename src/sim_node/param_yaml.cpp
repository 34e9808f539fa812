#include "sim_node/param_yaml.h"

#include <string>

namespace nord_driver::sim_node {

namespace {

YAML::Node toYaml(XmlRpc::XmlRpcValue& value) {
  using Value = XmlRpc::XmlRpcValue;
  YAML::Node node;
  switch (value.getType()) {
    case Value::TypeBoolean:
      node = static_cast<bool>(value);
      break;
    case Value::TypeInt:
      node = static_cast<int>(value);
      break;
    case Value::TypeDouble:
      node = static_cast<double>(value);
      break;
    case Value::TypeString:
      node = static_cast<std::string>(value);
      break;
    case Value::TypeArray:
      node = YAML::Node(YAML::NodeType::Sequence);
      for (int i = 0; i < value.size(); ++i) node.push_back(toYaml(value[i]));
      break;
    case Value::TypeStruct:
      node = YAML::Node(YAML::NodeType::Map);
      for (auto& member : value) node[member.first] = toYaml(member.second);
      break;
    default:
      break;
  }
  return node;
}

}  // namespace

YAML::Node readParameters(const ros::NodeHandle& handle) {
  XmlRpc::XmlRpcValue value;
  if (!handle.getParam(handle.getNamespace(), value)) return YAML::Node(YAML::NodeType::Map);
  return toYaml(value);
}

}  // namespace nord_driver::sim_node
