#include "rules/source_tree.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace nord_driver::rules {
namespace {

namespace fs = std::filesystem;

bool isLeftOut(const std::string& folder) {
  static const std::array<std::string, 4> kMade{"out", "build", "devel", "install"};
  if (startsWith(folder, ".")) return folder != ".ci";
  return startsWith(folder, "out-") || std::find(kMade.begin(), kMade.end(), folder) != kMade.end();
}

bool isText(const fs::path& path) {
  static const std::array<std::string, 17> kEndings{".cpp", ".h",    ".txt",  ".cmake", ".md",    ".sh",
                                                    ".py",  ".yaml", ".yml",  ".xml",   ".msg",   ".srv",
                                                    ".cfg", ".test", ".urdf", ".rst",   ".launch"};
  const std::string ending = path.extension().string();
  // Programs without an ending: scripts such as .ci/run.
  return ending.empty() || std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

std::string readFile(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw std::runtime_error("cannot read " + path.string());
  return text.str();
}

}  // namespace

std::vector<SourceFile> readTree(const std::string& root) {
  if (!fs::is_directory(root)) throw std::runtime_error(root + " is no folder");
  std::vector<SourceFile> files;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator(); ++entry) {
    const fs::path& path = entry->path();
    const std::string name = path.filename().string();
    if (entry->is_directory()) {
      if (isLeftOut(name)) entry.disable_recursion_pending();
    } else if (entry->is_regular_file() && !startsWith(name, ".") && isText(path) && entry->file_size() > 0) {
      files.push_back({path.lexically_relative(root).generic_string(), readFile(path)});
    }
  }
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool isCpp(const SourceFile& file) {
  return endsWith(file.path, ".h") || endsWith(file.path, ".cpp");
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> partsOf(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream stream(path);
  for (std::string part; std::getline(stream, part, '/');) parts.push_back(part);
  return parts;
}

std::string withoutComments(const std::string& text) {
  enum class In { Code, Line, Block, Quotes, Character };
  In in = In::Code;
  std::string code = text;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const char next = i + 1 < text.size() ? text[i + 1] : '\0';
    const bool digit_separator = i > 0 && std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0;
    if (in == In::Code) {
      if (c == '/' && next == '/') in = In::Line;
      if (c == '/' && next == '*') in = In::Block;
      if (c == '"') in = In::Quotes;
      if (c == '\'' && !digit_separator) in = In::Character;
    } else if (in == In::Quotes || in == In::Character) {
      if (c == '\\') {
        ++i;
      } else if (c == (in == In::Quotes ? '"' : '\'') || c == '\n') {
        in = In::Code;
      }
      continue;
    }
    if (c == '\n' && in == In::Line) in = In::Code;
    if ((in == In::Line || in == In::Block) && c != '\n') code[i] = ' ';
    if (in == In::Block && c == '*' && next == '/') {
      code[++i] = ' ';
      in = In::Code;
    }
  }
  return code;
}

}  // namespace nord_driver::rules
