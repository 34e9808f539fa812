#include "catalogue/catalogue.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "catalogue/parameter_text.h"
#include "config/nearest_name.h"

namespace nord_driver::catalogue {

namespace {

std::string lowerCase(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

}  // namespace

Catalogue Catalogue::load(const std::vector<std::string>& files) {
  Catalogue catalogue;
  for (const std::string& file : files) {
    const ParameterFile content = readParameterFile(file);
    for (const Device& device : content.devices) {
      auto& entries = catalogue.entries_[device];
      for (const ParameterEntry& upper : content.entries) {
        const auto lower = entries.find(upper.number);
        ParameterEntry empty;
        empty.number = upper.number;
        ParameterEntry merged = laidOver(lower == entries.end() ? empty : lower->second, upper);
        checkEntry(merged);
        entries[upper.number] = merged;
      }
    }
  }
  return catalogue;
}

const ParameterEntry* Catalogue::find(const Device& device, std::uint16_t number) const {
  const auto entries = entries_.find(device);
  if (entries == entries_.end()) return nullptr;
  const auto entry = entries->second.find(number);
  return entry == entries->second.end() ? nullptr : &entry->second;
}

std::vector<const ParameterEntry*> Catalogue::all(const Device& device) const {
  std::vector<const ParameterEntry*> list;
  const auto entries = entries_.find(device);
  if (entries == entries_.end()) return list;
  for (const auto& [number, entry] : entries->second) list.push_back(&entry);
  return list;
}

Lookup lookIn(const std::vector<const ParameterEntry*>& entries, const std::string& text, const std::string& whose) {
  const bool prefixed = text.size() > 1 && (text[0] == 'P' || text[0] == 'p');
  if (const auto number = wholeNumber(prefixed ? text.substr(1) : text)) {
    for (const ParameterEntry* entry : entries) {
      if (entry->number == *number) return {entry, {}};
    }
    return {nullptr, "\"" + text + "\" is not described for " + whose + ", expected a number of its catalogue"};
  }
  std::vector<const ParameterEntry*> found;
  std::vector<std::string> names;
  for (const ParameterEntry* entry : entries) {
    names.push_back(lowerCase(entry->title()));
    if (names.back() == lowerCase(text)) found.push_back(entry);
  }
  if (found.size() == 1) return {found[0], {}};
  if (found.size() > 1) {
    return {nullptr, "\"" + text + "\" is not valid, expected a number: " + label(*found[0]) + " and " +
                         label(*found[1]) + " have this name"};
  }
  const std::string nearest = nearestName(lowerCase(text), names);
  std::string expected = "the number or the name of a parameter of " + whose;
  for (const ParameterEntry* entry : entries) {
    if (!nearest.empty() && lowerCase(entry->title()) == nearest) expected = "perhaps \"" + entry->title() + "\"";
  }
  return {nullptr, "\"" + text + "\" is not valid, expected " + expected};
}

std::vector<std::string> yamlFilesIn(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& item : std::filesystem::directory_iterator(folder, error)) {
    if (item.path().extension() == ".yaml") files.push_back(item.path().string());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) throw ConfigError(folder + ": holds no YAML file, expected the files of the catalogue");
  return files;
}

}  // namespace nord_driver::catalogue
