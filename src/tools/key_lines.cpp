#include "tools/key_lines.h"

#include <set>

#include "config/yaml_merge.h"

namespace nord_driver::tools {

namespace {

void findTwice(const YAML::Node& group, const std::string& path, std::vector<std::string>& sentences) {
  std::set<std::string> seen;
  for (const auto& member : group) {
    if (!member.first.IsScalar() || isMergeKey(member.first)) continue;  // of merge keys each counts
    const std::string key = path + member.first.Scalar();
    if (!seen.insert(key).second) {
      sentences.push_back(key + " is there twice, the second time in line " +
                          std::to_string(member.first.Mark().line + 1) + ": only one of them counts");
    }
    if (member.second.IsMap()) findTwice(member.second, key + "/", sentences);
  }
}

/// The line of the deepest group or key that is on the way to `path`; `line`: of `group` itself.
int deepest(const YAML::Node& group, const std::string& path, int line) {
  for (const auto& member : group) {
    const std::string& key = member.first.Scalar();
    const int here = member.first.Mark().line + 1;
    if (key == path) return here;
    if (path.compare(0, key.size() + 1, key + "/") != 0) continue;
    return member.second.IsMap() ? deepest(member.second, path.substr(key.size() + 1), here) : here;
  }
  return line;
}

}  // namespace

KeyLines::KeyLines(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    roots_.push_back(YAML::LoadFile(file));
    findTwice(roots_.back(), "", twice_);
  }
}

int KeyLines::lineOf(const std::string& sentence) const {
  if (roots_.size() != 1) return 0;
  std::string path = sentence.substr(0, sentence.find_first_of(": "));
  if (!path.empty() && path.front() == '~') path.erase(0, 1);
  return deepest(roots_.front(), path, 0);
}

}  // namespace nord_driver::tools
