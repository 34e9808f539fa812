// The project's files as text, for rules that read them.
#pragma once

#include <string>
#include <vector>

namespace nord_driver::rules {

struct SourceFile {
  std::string path;  ///< relative to the project, with '/'
  std::string text;
};

/// Sentences, each beginning with the path (and line) it is about. Empty: the rule holds.
using Violations = std::vector<std::string>;

/// Every text file of the project by its known endings, sorted by path. Hidden folders other than .ci and everything a
/// build makes (folders out, out-*, build, devel, install) are left out.
/// Throws std::runtime_error when `root` is no folder.
std::vector<SourceFile> readTree(const std::string& root);

bool startsWith(const std::string& text, const std::string& start);
bool endsWith(const std::string& text, const std::string& end);
/// A C++ header or source.
bool isCpp(const SourceFile& file);
std::vector<std::string> linesOf(const std::string& text);
/// "src/robot/ramp.cpp" -> {"src", "robot", "ramp.cpp"}.
std::vector<std::string> partsOf(const std::string& path);
/// The same lines with what stands in comments blanked; strings stay.
std::string withoutComments(const std::string& text);

}  // namespace nord_driver::rules
