// Any text as a file of parameters and of faults, laid over one that is fine: taken or refused with a sentence that names
// the line, and of what is taken every value can be said in words and every word be read back.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "catalogue/catalogue.h"
#include "catalogue/fault_catalogue.h"
#include "catalogue/parameter_text.h"
#include "fuzz.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::catalogue;
using fuzz::require;

/// A file without a disk: what the readers want is a path.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text) : descriptor_(::memfd_create("catalogue", MFD_CLOEXEC)) {
    require(descriptor_ >= 0);
    require(::write(descriptor_, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

constexpr char kParameters[] =
    "devices: [sk5xxe, module_profibus]\n"
    "parameters:\n"
    "  - {number: 102, name: Acceleration time, unit: s, resolution: 0.01, range: [0, 320.0], default: 2.0,\n"
    "     per_set: true, source: s}\n"
    "  - {number: 740, name: Process data, elements: {1: Word, 2: {name: Other, size: 32}}, bits: {0: Ready, 3..4: "
    "Two},\n"
    "     read_only: true, source: s}\n";
constexpr char kFaults[] =
    "codes: p700\nresolution: 0.1\nfaults:\n  - {number: 3.0, name: Overcurrent, cause: c, remedy: r, source: s}\n";

void checkSentence(const ConfigError& error, const MemoryFile& file) {
  const std::string sentence = error.what();
  require(sentence.compare(0, file.path().size() + 1, file.path() + ":") == 0);
  require(sentence.find("xpected") != std::string::npos);
}

void readEntry(const ParameterEntry& entry) {
  for (const unsigned index : {1u, 2u}) {
    const auto [lowest, highest] = entry.rawRange(index);
    require(lowest <= highest);
    for (const std::int64_t wanted :
         {lowest, highest, std::int64_t{0}, entry.rawOf(entry.defaultOf(index).value_or(0))}) {
      const auto raw = static_cast<std::int32_t>(std::clamp<std::int64_t>(wanted, INT32_MIN, INT32_MAX));
      require(!assignment(entry, raw, index).empty());
      const RawValue back = rawFrom(entry, valueText(entry, raw, index), index);
      require(back.raw.has_value() == back.error.empty());
      entry.takes(wanted, index);
    }
    require(!label(entry, index).empty());
    rangeText(entry, index);
  }
  stepText(entry);
  kindText(entry);
  require(!resetsDevice(entry.number) || !entry.mayWrite());
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const MemoryFile kLower{kParameters}, kLowerFaults{kFaults};
  const MemoryFile file{std::string(reinterpret_cast<const char*>(data), size)};
  try {
    const Catalogue all = Catalogue::load({kLower.path(), file.path()});
    for (const Device& device : allDevices()) {
      for (const ParameterEntry* entry : all.all(device)) readEntry(*entry);
    }
  } catch (const ConfigError& error) {
    checkSentence(error, file);
  }
  try {
    const FaultCatalogue all = FaultCatalogue::load({kLowerFaults.path(), file.path()});
    for (const FaultCodes codes : kAllFaultCodes) {
      for (const FaultEntry* fault : all.all(codes)) {
        require(fault->name && !fault->source.empty() && !faultLabel(codes, fault->number).empty());
      }
    }
  } catch (const ConfigError& error) {
    checkSentence(error, file);
  }
  return 0;
}
