#include "rules/name_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace nord_driver::rules {

namespace {

const std::array<std::string, 3> kFolders{"src/cycle/", "src/drive/", "src/node/"};
const std::array<std::string, 6> kBuses{"profibus", "canopen", "devicenet", "interbus", "modbus", "profinet"};

std::string inSmallLetters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

}  // namespace

const std::vector<NamedBus>& namedBuses() {
  static const std::vector<NamedBus> kNamed{};
  return kNamed;
}

Violations checkBusNames(const std::vector<SourceFile>& files, const std::vector<NamedBus>& allowed) {
  Violations violations;
  std::size_t read = 0;
  for (const SourceFile& file : files) {
    const auto holds = [&](const std::string& folder) { return startsWith(file.path, folder); };
    if (!isCpp(file) || std::none_of(kFolders.begin(), kFolders.end(), holds)) continue;
    ++read;
    const std::vector<std::string> lines = linesOf(file.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::string line = inSmallLetters(lines[i]);
      const auto named = std::find_if(kBuses.begin(), kBuses.end(),
                                      [&](const std::string& bus) { return line.find(bus) != std::string::npos; });
      if (named == kBuses.end()) continue;
      const bool may = std::any_of(allowed.begin(), allowed.end(), [&](const NamedBus& entry) {
        return entry.path == file.path && lines[i].find(entry.text) != std::string::npos;
      });
      if (!may) violations.push_back(file.path + ":" + std::to_string(i + 1) + ": names a bus, " + *named);
    }
  }
  if (read == 0) violations.emplace_back("no C++ file below src/cycle, src/drive and src/node");
  return violations;
}

}  // namespace nord_driver::rules
