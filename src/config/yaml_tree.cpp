#include "config/yaml_tree.h"

#include <cstddef>

namespace nord_driver {

namespace {

constexpr unsigned kDeepest = 50;
constexpr std::size_t kMost = 100'000;  // values; the largest file of the project has some thousand

std::string walk(const YAML::Node& node, unsigned depth, std::size_t& values) {
  if (depth > kDeepest) return "it is more than " + std::to_string(kDeepest) + " groups and lists deep";
  if (++values > kMost) return "it has more than " + std::to_string(kMost) + " values";
  std::string why;
  if (node.IsSequence()) {
    for (auto item = node.begin(); item != node.end() && why.empty(); ++item) why = walk(*item, depth + 1, values);
  } else if (node.IsMap()) {
    for (auto member = node.begin(); member != node.end() && why.empty(); ++member) {
      if (member->first.IsSequence() || member->first.IsMap()) {
        return "line " + std::to_string(member->first.Mark().line + 1) + ": a key is a list or a group";
      }
      why = walk(member->second, depth + 1, values);
    }
  }
  return why;
}

}  // namespace

std::string whyNotWalkable(const YAML::Node& node) {
  std::size_t values = 0;
  return walk(node, 0, values);
}

}  // namespace nord_driver
