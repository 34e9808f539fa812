#include "rules/document_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <set>

namespace nord_driver::rules {
namespace {

bool isWordCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// All that documents may name.
class Code {
 public:
  explicit Code(const std::vector<SourceFile>& files) {
    for (const SourceFile& file : files) {
      paths_.push_back(file.path);
      if (endsWith(file.path, ".msg") || endsWith(file.path, ".srv")) words_.insert(stemOf(file.path));
      if (isCpp(file) && !startsWith(file.path, "test/rules/")) add(withoutComments(file.text));
    }
  }

  bool hasWord(const std::string& word) const { return words_.count(word) != 0; }
  bool hasFunction(const std::string& name) const { return functions_.count(name) != 0; }
  /// Declared in a class of that name, or in the file of one, or defined as such.
  bool hasMember(const std::string& type, const std::string& name) const { return members_.count({type, name}) != 0; }
  bool hasPath(const std::string& path) const {
    return std::any_of(paths_.begin(), paths_.end(), [&path](const std::string& one) {
      return one == path || startsWith(one, path + "/") || endsWith(one, "/" + path);
    });
  }

 private:
  static std::string stemOf(const std::string& path) {
    const std::string name = partsOf(path).back();
    return name.substr(0, name.rfind('.'));
  }

  void add(const std::string& code) {
    std::set<std::string> types, functions;
    std::string before;  // the word before, joined by "::" or after class, struct, namespace
    bool qualified = false, declares = false;
    for (std::size_t at = 0; at < code.size();) {
      if (!isWordCharacter(code[at])) {
        qualified = code.compare(at, 2, "::") == 0 && !before.empty();
        at += qualified ? 2 : 1;
        continue;
      }
      const std::size_t begin = at;
      while (at < code.size() && isWordCharacter(code[at])) ++at;
      const std::string word = code.substr(begin, at - begin);
      words_.insert(word);
      if (at < code.size() && code[at] == '(') functions.insert(word);
      if (qualified) members_.insert({before, word});
      if (declares) types.insert(word);
      declares = word == "class" || word == "struct" || word == "namespace";
      qualified = false;
      before = word;
    }
    for (const std::string& type : types) {
      for (const std::string& function : functions) members_.insert({type, function});
    }
    functions_.insert(functions.begin(), functions.end());
  }

  std::vector<std::string> paths_;
  std::set<std::string> words_, functions_;
  std::set<std::pair<std::string, std::string>> members_;
};

bool looksLikeAPath(const std::string& name) {
  static const std::array<std::string, 4> kRoots{"src/", "test/", "include/", "scripts/"};
  static const std::regex kPath("[\\w./-]+");
  if (!std::regex_match(name, kPath)) return false;
  const bool below_root =
      std::any_of(kRoots.begin(), kRoots.end(), [&name](const std::string& root) { return startsWith(name, root); });
  return below_root || endsWith(name, ".h") || endsWith(name, ".cpp");
}

std::string withoutEnd(std::string text, char end) {
  while (!text.empty() && text.back() == end) text.pop_back();
  return text;
}

/// Looks like code of ours, and is none.
bool isUnknown(const std::string& name, const Code& code) {
  static const std::regex kMember("(?:\\w+::)*(\\w+)::(\\w+)(?:\\(\\))?");
  static const std::regex kFunction("([A-Za-z]\\w*)\\(\\)");
  static const std::regex kType("[A-Z][A-Za-z0-9]*[a-z][A-Za-z0-9]*");
  static const std::regex kCamel("[a-z][a-z0-9]*[A-Z][A-Za-z0-9]*");
  std::smatch match;
  if (looksLikeAPath(name)) return !code.hasPath(withoutEnd(name, '/'));
  if (std::regex_match(name, match, kMember)) return !code.hasMember(match[1], match[2]);
  if (std::regex_match(name, match, kFunction)) return !code.hasFunction(match[1]);
  const bool word = std::regex_match(name, kType) || std::regex_match(name, kCamel);
  return word && !code.hasWord(name);
}

std::vector<std::string> quotedIn(const std::string& line) {
  static const std::regex kQuoted("`([^`]+)`");
  std::vector<std::string> names;
  for (std::sregex_iterator use(line.begin(), line.end(), kQuoted), end; use != end; ++use) {
    names.push_back((*use)[1]);
  }
  return names;
}

}  // namespace

const std::map<std::string, std::string>& foreignNames() {
  static const std::map<std::string, std::string> kForeign{
      {"ttyAMA0", "the kernel's name of a serial port"},
  };
  return kForeign;
}

Violations checkDocuments(const std::vector<SourceFile>& files, const std::map<std::string, std::string>& foreign) {
  const Code code{files};
  Violations violations;
  std::set<std::string> used;
  std::size_t read = 0;
  for (const SourceFile& file : files) {
    const bool document = startsWith(file.path, "doc/") && endsWith(file.path, ".md");
    if (!document && file.path != "README.md") continue;
    ++read;
    bool fenced = false;
    const std::vector<std::string> lines = linesOf(file.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].find("```") != std::string::npos) fenced = !fenced;
      if (fenced) continue;
      for (const std::string& name : quotedIn(lines[i])) {
        if (!isUnknown(name, code)) continue;
        if (foreign.count(name) != 0) {
          used.insert(name);
        } else {
          violations.push_back(file.path + ":" + std::to_string(i + 1) + ": `" + name + "` is nowhere in the code");
        }
      }
    }
  }
  for (const auto& [name, whose] : foreign) {
    if (used.count(name) == 0) violations.push_back("the list of foreign names: no document needs " + name);
  }
  if (read == 0) violations.emplace_back("no document");
  return violations;
}

}  // namespace nord_driver::rules
