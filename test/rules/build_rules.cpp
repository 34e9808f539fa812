#include "rules/build_rules.h"

#include <cctype>
#include <map>
#include <string>

namespace nord_driver::rules {
namespace {

const std::string kList = "CMakeLists.txt";

std::string folderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string{} : path.substr(0, slash);
}

std::string join(const std::string& folder, const std::string& name) {
  return folder.empty() ? name : folder + "/" + name;
}

/// `name` stands in `text` as a word of its own: not as the end of another file's name.
bool names(const std::string& text, const std::string& name) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const auto part_of_word = [&text](std::size_t i) {
      return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_' ||
                                 text[i] == '-' || text[i] == '.');
    };
    if ((at == 0 || !part_of_word(at - 1)) && !part_of_word(at + name.size())) return true;
  }
  return false;
}

}  // namespace

Violations checkSourceLists(const std::vector<SourceFile>& files) {
  Violations violations;
  std::map<std::string, std::string> lists;  // by folder
  for (const SourceFile& file : files) {
    if (file.path == kList || endsWith(file.path, "/" + kList)) lists[folderOf(file.path)] = file.text;
  }
  const auto demand = [&](const std::string& path) {
    std::string folder = folderOf(path);
    while (lists.count(folder) == 0 && !folder.empty()) folder = folderOf(folder);
    const auto list = lists.find(folder);
    const std::string name = folder.empty() ? path : path.substr(folder.size() + 1);
    const std::string last = path.substr(path.rfind('/') + 1);
    if (list == lists.end() || !(names(list->second, name) || names(list->second, last))) {
      violations.push_back(path + ": not named in " + join(folder, kList));
    }
  };
  std::size_t read = 0;
  for (const SourceFile& file : files) {
    if (!startsWith(file.path, "src/") && !startsWith(file.path, "test/")) continue;
    if (endsWith(file.path, ".cpp")) {
      ++read;
      demand(file.path);
    } else if (endsWith(file.path, "/" + kList)) {
      demand(folderOf(file.path));
    }
  }
  if (read == 0) violations.emplace_back("no .cpp under src and test");
  return violations;
}

Violations checkBuildFolders(const std::vector<SourceFile>& files) {
  Violations violations;
  std::size_t folders = 0;
  for (const SourceFile& file : files) {
    if (!startsWith(file.path, "scripts/") || !endsWith(file.path, ".sh")) continue;
    for (const std::string& line : linesOf(file.text)) {
      const std::size_t at = line.find("out=");
      if (at == std::string::npos || line.find("$root/", at) == std::string::npos) continue;
      ++folders;
      if (file.path == "scripts/demo.sh" || line.find("$root/build/", at) != std::string::npos) continue;
      violations.push_back(file.path + ": builds where rosrun looks, expected a folder below build/: " + line);
    }
  }
  if (folders == 0) violations.emplace_back("no script that builds");
  return violations;
}

}  // namespace nord_driver::rules
