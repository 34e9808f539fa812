#include "config/yaml_merge.h"

#include <set>
#include <utility>
#include <vector>

#include "nord_driver/config/settings.h"

namespace nord_driver {

namespace {

using Members = std::vector<std::pair<YAML::Node, YAML::Node>>;  // in the order of the file

std::string printed(const YAML::Node& node) {
  if (node.IsNull()) return "nothing";
  if (node.IsScalar()) return "\"" + node.Scalar() + "\"";
  return node.IsSequence() ? "a list in the list" : "a group";
}

/// Reads only: by its aliases a node may stand in several groups. To assign to a YAML::Node, as std::reverse does and insert() in the
/// middle of a vector, is to change the tree it is of.
class Merger {
 public:
  explicit Merger(const std::string& place) : place_(place) {}

  // Also in groups that another one takes the place of: rosparam refuses the file as a whole.
  void check(const YAML::Node& node) const {
    if (node.IsSequence()) {
      for (const YAML::Node& item : node) check(item);
    } else if (node.IsMap()) {
      for (const auto& member : node) {
        if (isMergeKey(member.first)) sourcesOf(member.first, member.second);
        check(member.second);
      }
    }
  }

  // Cloned throughout, so that what is done to one group is not done to another.
  YAML::Node merged(const YAML::Node& node) const {
    if (node.IsSequence()) {
      YAML::Node list{YAML::NodeType::Sequence};
      for (const YAML::Node& item : node) list.push_back(merged(item));
      return list;
    }
    if (!node.IsMap()) return YAML::Clone(node);
    YAML::Node group{YAML::NodeType::Map};
    for (const auto& [key, value] : membersOf(node)) group.force_insert(YAML::Clone(key), merged(value));
    return group;
  }

 private:
  // With those it merges; of all others the values are as they were read.
  Members membersOf(const YAML::Node& group) const {
    Members own, taken;
    std::vector<std::vector<YAML::Node>> merge_keys;
    std::set<std::string> known;
    for (const auto& member : group) {
      if (isMergeKey(member.first)) {
        merge_keys.push_back(sourcesOf(member.first, member.second));
      } else {
        own.emplace_back(member.first, member.second);
        known.insert(member.first.Scalar());
      }
    }
    // What counts more comes first: of two merge keys the later one, of one that stands twice in a group the last.
    for (auto sources = merge_keys.rbegin(); sources != merge_keys.rend(); ++sources) {
      for (const YAML::Node& source : *sources) {
        const Members theirs = membersOf(source);
        for (auto member = theirs.rbegin(); member != theirs.rend(); ++member) {
          if (known.insert(member->first.Scalar()).second) taken.push_back(*member);
        }
      }
    }
    Members all(taken.rbegin(), taken.rend());
    for (const auto& member : own) all.push_back(member);
    return all;
  }

  std::vector<YAML::Node> sourcesOf(const YAML::Node& key, const YAML::Node& value) const {
    if (value.IsMap()) return {value};
    if (!value.IsSequence()) throw wrong(key, value);
    std::vector<YAML::Node> sources;
    for (const YAML::Node& item : value) {
      if (!item.IsMap()) throw wrong(key, item);
      sources.push_back(item);
    }
    return sources;
  }

  ConfigError wrong(const YAML::Node& key, const YAML::Node& value) const {
    return ConfigError(place_ + ": line " + std::to_string(key.Mark().line + 1) + ": " + key.Scalar() + ": " +
                       printed(value) + " is not valid, expected a group or a list of groups, whose keys are taken");
  }

  const std::string& place_;
};

}  // namespace

bool isMergeKey(const YAML::Node& key) {
  if (!key.IsScalar()) return false;
  return key.Tag() == "tag:yaml.org,2002:merge" || (key.Tag() == "?" && key.Scalar() == "<<");
}

YAML::Node withKeysMerged(const YAML::Node& root, const std::string& place) {
  const Merger merger{place};
  merger.check(root);
  return merger.merged(root);
}

}  // namespace nord_driver
