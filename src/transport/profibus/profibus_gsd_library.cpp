#include "transport/profibus/profibus_gsd_library.h"

#include <algorithm>
#include <cctype>

#include "config/text_file.h"

namespace nord_driver {

namespace {

/// "PPO", anything but digits, and this one digit.
bool isPpoName(const std::string& name, std::uint8_t type) {
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const std::size_t at = upper.find("PPO");
  if (at == std::string::npos) return false;
  const std::size_t digit = upper.find_first_of("0123456789", at);
  if (digit == std::string::npos || upper[digit] != static_cast<char>('0' + type)) return false;
  return digit + 1 == upper.size() || std::isdigit(static_cast<unsigned char>(upper[digit + 1])) == 0;
}

}  // namespace

ProfibusGsdLibrary::ProfibusGsdLibrary(const Settings& bus, BaudRate baud, std::vector<std::string>& warnings)
    : baud_(baud), warnings_(warnings) {
  for (const std::string& path : bus.texts("gsd").value_or(std::vector<std::string>{})) load(bus, path);
}

GsdEntry& ProfibusGsdLibrary::load(const Settings& settings, const std::string& path) {
  for (GsdEntry& entry : entries_) {
    if (entry.path == path) return entry;
  }
  const std::string text = readTextFile(settings, "gsd", path, "a GSD file");
  entries_.push_back({path, profibus::parseGsd(text), false});
  for (const profibus::GsdProblem& problem : entries_.back().file.problems) {
    warnings_.push_back(path + ":" + std::to_string(problem.line) + ": " + problem.text);
  }
  return entries_.back();
}

const GsdEntry* ProfibusGsdLibrary::find(const Settings& drive, std::uint16_t ident) {
  if (const auto path = drive.text("gsd")) {
    GsdEntry& entry = load(drive, *path);
    entry.used = true;
    return &entry;
  }
  GsdEntry* found = nullptr;
  for (GsdEntry& entry : entries_) {
    if (entry.file.ident_number != ident) continue;
    entry.used = true;
    if (found == nullptr || (!supportsRate(found->file, baud_) && supportsRate(entry.file, baud_))) found = &entry;
  }
  return found;
}

void ProfibusGsdLibrary::warnOfUnused() {
  for (const GsdEntry& entry : entries_) {
    if (entry.used) continue;
    const std::string ident = entry.file.ident_number ? toHexWord(*entry.file.ident_number) + "h" : "none";
    warnings_.push_back(entry.path + " is not used: its ident number (" + ident + ") is that of no configured module");
  }
}

bool supportsRate(const profibus::GsdFile& file, BaudRate baud) {
  return std::any_of(file.rates.begin(), file.rates.end(), [&](const profibus::GsdRate& rate) {
    return rate.supported && rate.bits_per_second == baud.bitsPerSecond();
  });
}

const profibus::GsdModule* findPpoModule(const profibus::GsdFile& file, std::uint8_t type,
                                         const profile::PpoLayout& layout) {
  const profibus::GsdModule* named = nullptr;
  bool ambiguous = false;
  for (const profibus::GsdModule& module : file.modules) {
    if (!isPpoName(module.name, type)) continue;
    ambiguous = ambiguous || (named != nullptr && named->configuration != module.configuration);
    named = &module;
  }
  if (named != nullptr && !ambiguous) return named;
  for (const profibus::GsdModule& module : file.modules) {
    if (ByteView{module.configuration} == ByteView{layout.identifiers}) return &module;
  }
  return nullptr;
}

}  // namespace nord_driver
