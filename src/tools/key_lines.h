// Where a key stands in a configuration's files: the line to look at for a sentence that names it.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace nord_driver::tools {

class KeyLines {
 public:
  /// Of readable YAML files. Lines are told for one file only: of several a number alone would mislead.
  explicit KeyLines(const std::vector<std::string>& files);

  /// The line (from 1) of the key a sentence begins with ("drives/left/address: ..."), or of the group where it should
  /// be; 0: of none.
  int lineOf(const std::string& sentence) const;
  /// One sentence for each key that stands in its group twice: the last one counts for the parameter server.
  const std::vector<std::string>& keysTwice() const noexcept { return twice_; }

 private:
  std::vector<YAML::Node> roots_;
  std::vector<std::string> twice_;
};

}  // namespace nord_driver::tools
