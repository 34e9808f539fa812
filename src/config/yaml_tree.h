// Whether a YAML file is small enough to be walked through: by its aliases a few lines can be a tree without end.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace nord_driver {

/// Empty; or a clause on why nobody should walk through it: "it is more than 50 groups and lists deep", which one that
/// holds itself is ("a: &a [*a]"), "it has more than 100000 values", "line 3: a key is a list or a group".
std::string whyNotWalkable(const YAML::Node& node);

}  // namespace nord_driver
