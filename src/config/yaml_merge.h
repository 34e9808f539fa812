// The merge keys of YAML 1.1, "<<: *left": rosparam resolves them while it reads a file, yaml-cpp leaves them keys of that name.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace nord_driver {

/// Whether the key of a group is one; quoted it is a key as any other.
bool isMergeKey(const YAML::Node& key);

/// A copy of `root`, which is walkable (whyNotWalkable), where each group has the keys of the groups that it merges: what it has
/// itself counts, then what an earlier one of a list has. Each key as a whole: groups of one name do not become one. Throws
/// ConfigError that begins with `place`, what `root` was read from.
YAML::Node withKeysMerged(const YAML::Node& root, const std::string& place);

}  // namespace nord_driver
