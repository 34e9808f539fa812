#include "devicenet/eds_file.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "devicenet/eds_entries.h"

namespace nord_driver::devicenet {

namespace {

constexpr std::uint32_t kWord = 0xFFFF;
constexpr std::uint32_t kAnyMask = 0xFFFFFFFF;

/// "20 04 24 64 30 03": class 4, instance 100, attribute 3. Nothing for a path of another form.
std::optional<std::uint8_t> assemblyOf(const std::string& path) {
  std::istringstream words{path};
  std::vector<std::uint32_t> bytes;
  for (std::string word; words >> word;) {
    const auto byte = word.size() == 2 ? edsNumber("0x" + word) : std::nullopt;
    if (!byte) return std::nullopt;
    bytes.push_back(*byte);
  }
  if (bytes.size() < 4 || bytes[0] != 0x20 || bytes[1] != 0x04 || bytes[2] != 0x24) return std::nullopt;
  return static_cast<std::uint8_t>(bytes[3]);
}

class Reader {
 public:
  explicit Reader(const std::string& text) : entries_(splitEds(text, file_.problems)) {}

  EdsFile read() {
    for (const EdsEntry& entry : entries_) {
      if (entry.section == "device") device(entry);
      if (entry.section == "io_info") io(entry);
    }
    if (!has_device_) problem(1, "no section [Device]: this may be no EDS file of DeviceNet");
    std::stable_sort(file_.problems.begin(), file_.problems.end(),
                     [](const EdsProblem& a, const EdsProblem& b) { return a.line < b.line; });
    return std::move(file_);
  }

 private:
  void problem(std::size_t line, std::string text) { file_.problems.push_back({line, std::move(text)}); }

  void device(const EdsEntry& entry) {
    if (entry.key.empty()) has_device_ = true;
    if (entry.key == "vendcode") take(entry, "VendCode", kWord, file_.vendor_id);
    if (entry.key == "prodtype") take(entry, "ProdType", kWord, file_.device_type);
    if (entry.key == "prodcode") take(entry, "ProdCode", kWord, file_.product_code);
    if (entry.key == "prodname" && file_.product.empty()) file_.product = entry.fields[0].text;
  }

  void io(const EdsEntry& entry) {
    if (entry.key.empty() && !file_.io_line) file_.io_line = entry.line;
    if (entry.key == "pollinfo") take(entry, "PollInfo", kAnyMask, file_.poll);
    if (entry.key == "strobeinfo") take(entry, "StrobeInfo", kAnyMask, file_.strobe);
    if (entry.key == "cosinfo") take(entry, "COSInfo", kAnyMask, file_.change_of_state);
    if (entry.key == "cyclicinfo") take(entry, "CyclicInfo", kAnyMask, file_.cyclic);
    if (isNumbered(entry.key, "input")) data(entry, "Input", file_.inputs);
    if (isNumbered(entry.key, "output")) data(entry, "Output", file_.outputs);
  }

  static bool isNumbered(const std::string& key, const std::string& name) {
    return key.compare(0, name.size(), name) == 0 && edsNumber(key.substr(name.size())).has_value();
  }

  /// The first field of an entry. Of two equal ones the first holds.
  void take(const EdsEntry& entry, const char* name, std::uint32_t most, std::optional<EdsNumber>& place) {
    if (place) {
      problem(entry.line,
              std::string{name} + " stands twice; the first one (line " + std::to_string(place->line) + ") holds");
      return;
    }
    const auto value = number(entry, 0, name, most);
    if (value) place = EdsNumber{*value, entry.line};
  }

  std::optional<std::uint32_t> number(const EdsEntry& entry, std::size_t index, const std::string& name,
                                      std::uint32_t most) {
    if (index >= entry.fields.size() || entry.fields[index].text.empty()) {
      problem(entry.line, name + " has no value in field " + std::to_string(index + 1));
      return std::nullopt;
    }
    const EdsField& field = entry.fields[index];
    const auto value = edsNumber(field.text);
    if (value && *value <= most) return value;
    problem(field.line, name + ": \"" + field.text + "\" is no number from 0 to " + std::to_string(most));
    return std::nullopt;
  }

  /// Bytes, bits in use, kinds, name, length of the path, path, help.
  void data(const EdsEntry& entry, const char* what, std::vector<EdsProcessData>& list) {
    constexpr std::size_t kBytes = 0, kKinds = 2, kPath = 5;
    const std::string name = what + entry.key.substr(std::string{what}.size());
    EdsProcessData made;
    made.line = entry.line;
    const auto bytes = number(entry, kBytes, name, kWord);
    const auto kinds = number(entry, kKinds, name, kAnyMask);
    if (!bytes || !kinds) return;
    made.bytes = *bytes;
    made.kinds = *kinds;
    if (entry.fields.size() > kPath) made.assembly = assemblyOf(entry.fields[kPath].text);
    list.push_back(made);
  }

  EdsFile file_;
  std::vector<EdsEntry> entries_;
  bool has_device_ = false;
};

}  // namespace

EdsFile parseEds(const std::string& text) {
  return Reader{text}.read();
}

}  // namespace nord_driver::devicenet
