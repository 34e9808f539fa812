#include "rules/text_rules.h"

#include <array>
#include <string>

namespace nord_driver::rules {

Violations checkCppFiles(const std::vector<SourceFile>& files) {
  Violations violations;
  std::size_t read = 0;
  for (const SourceFile& file : files) {
    if (!isCpp(file)) continue;
    ++read;
    const std::vector<std::string> lines = linesOf(file.text);
    if (lines.size() > kMaxLines) {
      violations.push_back(file.path + ": " + std::to_string(lines.size()) + " lines, at most " +
                           std::to_string(kMaxLines));
    }
    if (!endsWith(file.path, ".h")) continue;
    if (!startsWith(file.text, "//")) {
      violations.push_back(file.path + ": does not begin with a comment that says what it is for");
    }
    if (file.text.find("\n#pragma once\n") == std::string::npos) {
      violations.push_back(file.path + ": has no #pragma once");
    }
  }
  if (read == 0) violations.emplace_back("no C++ file at all");
  return violations;
}

Violations checkLaunchFiles(const std::vector<SourceFile>& files) {
  Violations violations;
  std::size_t nodes = 0;
  for (const SourceFile& file : files) {
    if (!startsWith(file.path, "launch/")) continue;
    for (std::size_t at = file.text.find("<node "); at != std::string::npos; at = file.text.find("<node ", at + 1)) {
      const std::string tag = file.text.substr(at, file.text.find('>', at) - at);
      if (tag.find("pkg=\"nord_driver\"") == std::string::npos) continue;
      ++nodes;
      if (tag.find("clear_params=\"true\"") != std::string::npos) continue;
      violations.push_back(file.path + ": a node of this package without clear_params=\"true\"");
    }
  }
  if (nodes == 0) violations.emplace_back("no node in launch/ at all");
  return violations;
}

Violations checkWords(const std::vector<SourceFile>& files) {
  // Put together here, so that this file does not hold them.
  const std::array<std::string, 5> kWords{std::string("TO") + "DO", std::string("FIX") + "ME",
                                          std::string("../sha") + "red", std::string("/wo") + "rk/",
                                          std::string("fac") + "ts/"};
  Violations violations;
  if (files.empty()) violations.emplace_back("no file at all");
  for (const SourceFile& file : files) {
    const std::vector<std::string> lines = linesOf(file.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (const std::string& word : kWords) {
        if (lines[i].find(word) == std::string::npos) continue;
        violations.push_back(file.path + ":" + std::to_string(i + 1) + ": holds \"" + word + "\"");
      }
    }
  }
  return violations;
}

}  // namespace nord_driver::rules
