#include "node/ros_settings.h"

#include <sstream>
#include <utility>

namespace nord_driver::node {

using XmlRpc::XmlRpcValue;

namespace {

std::string written(const XmlRpcValue& value) {
  std::ostringstream text;
  value.write(text);
  return text.str();
}

SettingValue valueOf(XmlRpcValue value) {  // a copy: only one that is not const tells what it holds
  switch (value.getType()) {
    case XmlRpcValue::TypeInvalid:
      return {};
    case XmlRpcValue::TypeString:
      return SettingValue::ofText(static_cast<std::string>(value));
    case XmlRpcValue::TypeInt:
      return SettingValue::ofInteger(static_cast<int>(value), written(value));
    case XmlRpcValue::TypeDouble:
      return SettingValue::ofFraction(static_cast<double>(value), written(value));
    case XmlRpcValue::TypeBoolean: {
      const bool flag = static_cast<bool>(value);
      return SettingValue::ofBoolean(flag, flag ? "true" : "false");
    }
    case XmlRpcValue::TypeArray: {
      SettingValue list = SettingValue::list();
      for (int i = 0; i < value.size(); ++i) list.items.push_back(valueOf(value[i]));
      return list;
    }
    case XmlRpcValue::TypeStruct: {
      SettingValue group = SettingValue::group();
      for (auto& member : value) group.add(member.first, valueOf(member.second));
      return group;
    }
    default:
      return SettingValue::other(written(value));
  }
}

}  // namespace

RosSettings::RosSettings(std::string prefix, const XmlRpcValue& value)
    : TreeSettings(std::move(prefix), valueOf(value)) {}

}  // namespace nord_driver::node
