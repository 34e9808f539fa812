// 60 entries, drawn by a fixed seed from all files, against what their manuals print, typed by hand from there.
//
// Drawn are entries of parameters, faults and error codes that name one of the five manuals at hand. Those with a range
// stand in the first table, whose draw is older and has more of them; all others in the second.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "catalogue/shipped.h"
#include "catalogue/yaml_map.h"

namespace nord_driver::catalogue {
namespace {

constexpr int kSeed = 20150;
constexpr std::size_t kDrawn = 60;
constexpr const char* kManuals[] = {"BU 0020", "BU 0070", "BU 0220", "BU 0280", "BU 2700"};
constexpr int kNone = -99999;  // the manual prints no factory setting

/// One parameter as the manual prints it. Numbers are raw: P513 = -0.1 ... 100.0 s is -1 ... 1000.
struct Printed {
  const char* device;
  std::uint16_t number;
  const char* manual;
  const char* place;  ///< section, and the page it begins on; the copy of BU 2700 has no pages
  int lowest;
  int highest;
  int factory;        ///< of [-01], or of all elements
  unsigned elements;  ///< 0: no array
  char set;         ///< 'P': in the column of the parameter set, '-': the column is empty, '?': there is no such column
  char supervisor;  ///< 'S' or '-'
  int value;        ///< a value, bit or element of the list, with a word of its text
  const char* kind;  ///< "value", "bit", "element" or ""
  const char* word;
};

const std::vector<Printed> kPrinted{
    // clang-format off
    // BU 0280 5.2.1 to 5.2.4
    {"module_devicenet", 150, "BU 0280", "5.2.1, p. 56", 0, 4, 0, 0, '-', '-', 3, "value", "Output 2 on"},
    {"module_devicenet", 152, "BU 0280", "5.2.1, p. 56", 0, 1, 0, 0, '-', '-', 1, "value", "Load factory settings"},
    {"module_devicenet", 162, "BU 0280", "5.2.2, p. 56", 0, 8, 0, 3, '-', '-', 0, "value", "FI does not exist"},
    {"module_devicenet", 165, "BU 0280", "5.2.2, p. 56", 0, 8, 0, 3, '-', '-', 2, "element", "control values"},
    // 0.0 ... 9999.9 is printed, a word ends at 6553.5
    {"module_devicenet", 171, "BU 0280", "5.2.3, p. 59", 0, 65535, 0, 3, '-', '-', 2, "element", "Software revision"},
    {"module_devicenet", 172, "BU 0280", "5.2.3, p. 59", 0, 2, 0, 0, '-', '-', 1, "value", "external module"},
    {"module_devicenet", 181, "BU 0280", "5.2.4, p. 62", 0, 2, 0, 0, '-', '-', 1, "value", "250 kBaud"},
    // BU 2700 7.1
    {"module_profibus", 150, "BU 2700", "7.1.1", 0, 4, 0, 0, '-', '-', 2, "value", "Output 1 On (DO1)"},
    {"module_profibus", 151, "BU 2700", "7.1.1", -1, 32767, 0, 0, '-', '-', -1, "value", "Monitoring Off"},
    {"module_profibus", 152, "BU 2700", "7.1.1", 0, 1, 0, 0, '-', '-', 1, "value", "Load factory setting"},
    {"module_profibus", 153, "BU 2700", "7.1.1", 0, 250, 10, 2, '-', '-', 2, "element", "TxPDO Inhibit Time"},
    {"module_profibus", 160, "BU 2700", "7.1.2", 3, 125, 126, 0, '-', '-', 0, "", ""},
    {"module_profibus", 170, "BU 2700", "7.1.3", 0, 9999, kNone, 2, '-', '-', 2, "element", "Last error"},
    {"module_profibus", 172, "BU 0220", "5.2.2, p. 51", 0, 2, kNone, 0, '-', '-', 2, "value", "Bus TB"},
    {"module_profibus", 173, "BU 2700", "7.1.3", 0, 65535, kNone, 0, '-', '-', 5, "bit", "PROFIBUS DP Watchdog active"},
    {"module_profibus", 180, "BU 2700", "7.1.4", 3, 125, kNone, 0, '-', '-', 0, "", ""},
    {"module_profibus", 181, "BU 2700", "7.1.4", 0, 15, kNone, 0, '-', '-', 4, "value", "500 kbit/s"},
    {"module_profibus", 182, "BU 2700", "7.1.4", 0, 255, kNone, 5, '-', '-', 241, "value", "PPO 3"},
    // BU 0220 5.1, BU 0280 5.1
    {"sk1x0e", 420, "BU 0220", "5.1.2, p. 42", 0, 77, 1, 4, '-', '-', 14, "value", "Remote control"},
    {"sk1x0e", 480, "BU 0280", "5.1.2, p. 48", 0, 72, 1, 12, '-', '-', 11, "element", "Bit 8"},
    {"sk1x0e", 482, "BU 0280", "5.1.2, p. 48", -400, 400, 100, 8, '-', '-', 0, "", ""},
    {"sk1x0e", 701, "BU 0280", "5.1.4, p. 54", 0, 214, kNone, 5, '-', '-', 0, "", ""},
    {"sk1x0e", 748, "BU 0220", "5.1.4, p. 48", 0, 65535, kNone, 0, '-', '-', 3, "bit", "Bus module is online"},
    {"sk1x0e", 749, "BU 0220", "5.1.4, p. 48", 0, 511, kNone, 0, '-', '-', 8, "bit", "EEPROM memory module"},
    // BU 0020 6.1; P551: BU 0070 5.1
    {"sk300e", 481, "BU 0020", "6.1.1, p. 54", 0, 38, 0, 8, '-', 'S', 8, "element", "Bit 7"},
    {"sk300e", 508, "BU 0020", "6.1.2, p. 55", 1, 126, 1, 0, '-', '-', 0, "", ""},
    {"sk300e", 509, "BU 0020", "6.1.2, p. 55", 0, 21, 0, 0, '-', '-', 9, "value", "Profibus control word"},
    {"sk300e", 544, "BU 0020", "6.1.2, p. 55", 0, 12, 0, 0, 'P', 'S', 9, "value", "Error number"},
    {"sk300e", 545, "BU 0020", "6.1.2, p. 55", 0, 12, 0, 0, 'P', 'S', 12, "value", "Out Bits 0...7"},
    {"sk300e", 546, "BU 0020", "6.1.2, p. 55", 0, 7, 1, 0, 'P', 'S', 7, "value", "In Bits 0-7"},
    {"sk300e", 551, "BU 0070", "5.1, p. 15", 0, 1, 0, 0, '-', '-', 1, "value", "DRIVECOM 21"},
    {"sk300e", 741, "BU 0020", "6.1.3, p. 59", 0, 65535, kNone, 5, '-', 'S', 5, "element", "Out Bit"},
    {"sk300e", 745, "BU 0020", "6.1.3, p. 59", 0, 32767, kNone, 0, '-', '-', 0, "", ""},
    {"sk300e", 746, "BU 0020", "6.1.3, p. 59", 0, 65535, kNone, 0, '-', 'S', 0, "bit", "Module ready"},
    // BU 0020 6.2; the range of P513 is that of BU 0280 5.1.3, its page in BU 0020 is damaged
    {"sk54xe", 481, "BU 0020", "6.2.1, p. 61", 0, 39, 0, 10, '-', 'S', 6, "element", "DO2 of the first SK xU4-IOE"},
    {"sk54xe", 508, "BU 0020", "6.2.2, p. 63", 1, 126, 1, 0, '-', '-', 0, "", ""},
    {"sk54xe", 509, "BU 0020", "6.2.2, p. 63", 0, 10, 0, 0, '-', '-', 6, "value", "CANopen"},
    {"sk54xe", 513, "BU 0280", "5.1.3, p. 50", -1, 1000, kNone, 0, '-', '-', -1, "value", "no error"},
    {"sk54xe", 546, "BU 0020", "6.2.2, p. 63", 0, 57, 1, 5, 'P', 'S', 48, "value", "Motor temperature"},
    {"sk54xe", 740, "BU 0020", "6.2.3, p. 67", 0, 65535, kNone, 23, '-', 'S', 18, "element", "PLC control word"},
    // BU 0020 6.2; P510: BU 0070 5.1, where the factory setting of P543 stands too
    {"sk5xxe", 482, "BU 0020", "6.2.1, p. 61", -400, 400, 100, 10, '-', 'S', 0, "", ""},
    {"sk5xxe", 508, "BU 0020", "6.2.2, p. 63", 1, 126, 1, 0, '-', '-', 0, "", ""},
    {"sk5xxe", 510, "BU 0070", "5.1, p. 15", 0, 8, 0, 2, '-', '-', 4, "value", "Profibus"},
    {"sk5xxe", 543, "BU 0020", "6.2.2, p. 63", 0, 24, 1, 0, 'P', 'S', 17, "value", "Value analog input 1"},
    {"sk5xxe", 544, "BU 0020", "6.2.2, p. 63", 0, 24, 0, 0, 'P', 'S', 23, "value", "Actual frequency with slip"},
    {"sk5xxe", 740, "BU 0020", "6.2.3, p. 67", 0, 65535, kNone, 13, '-', 'S', 6, "element", "Parameter data In 1"},
    {"sk5xxe", 741, "BU 0020", "6.2.3, p. 67", 0, 65535, kNone, 13, '-', 'S', 4, "element", "Actual value 3"},
    {"sk5xxe", 745, "BU 0020", "6.2.3, p. 67", 0, 9999, kNone, 0, '-', '-', 0, "", ""},
    {"sk5xxe", 746, "BU 2700", "7.2", 0, 65535, kNone, 0, '-', 'S', 5, "bit", "Timeout error"},
    // BU 0020 6.1; P560: BU 0280 5.1.3 has the range
    {"sk700e", 481, "BU 0020", "6.1.1, p. 54", 0, 38, 0, 8, '-', 'S', 1, "element", "Bit 0"},
    {"sk700e", 483, "BU 0020", "6.1.1, p. 54", 1, 100, 10, 8, '-', 'S', 0, "", ""},
    {"sk700e", 507, "BU 0020", "6.1.2, p. 55", 1, 4, 1, 0, '-', '-', 0, "", ""},
    {"sk700e", 508, "BU 0020", "6.1.2, p. 55", 1, 126, 1, 0, '-', '-', 0, "", ""},
    {"sk700e", 510, "BU 0020", "6.1.2, p. 55", 0, 8, 0, 2, '-', 'S', 6, "value", "DeviceNet"},
    {"sk700e", 513, "BU 0020", "6.1.2, p. 55", -1, 10000, 0, 0, '-', 'S', -1, "value", "No error"},
    {"sk700e", 545, "BU 0020", "6.1.2, p. 55", 0, 12, 0, 0, 'P', 'S', 6, "value", "Actual position"},
    {"sk700e", 546, "BU 0020", "6.1.2, p. 55", 0, 7, 1, 0, 'P', 'S', 3, "value", "32 Bit setpoint position"},
    {"sk700e", 560, "BU 0280", "5.1.3, p. 50", 0, 1, kNone, 0, '-', '-', 0, "", ""},
    {"sk700e", 741, "BU 0020", "6.1.3, p. 59", 0, 65535, kNone, 6, '-', 'S', 3, "element", "Actual value 1 High byte"},
    {"sk700e", 746, "BU 0020", "6.1.3, p. 59", 0, 65535, kNone, 3, '-', 'S', 2, "element", "Customer unit"},
    // clang-format on
};

/// An entry without a range: what the manual tells of it.
struct Told {
  const char* device;    ///< or the codes of a file of faults, with the device it is for
  std::uint32_t number;  ///< raw: 105 for 10.5
  const char* manual;
  const char* place;    ///< as above
  const char* name;     ///< words of the name
  const char* further;  ///< words of the cause or remedy, the unit, or of the name of a value; may be empty
  bool read_only;
};

const std::vector<Told> kTold{
    // clang-format off
    // A FI that is not connected is answered for with "Resource unavailable"; the number is DeviceNet's.
    {"devicenet_general", 0x02, "BU 0280", "4.1.2, p. 35", "resource unavailable", "not connected", false},
    {"drivecom", 0x2310, "BU 0070", "6.4.2, p. 31", "constant output overcurrent", "", false},
    {"drivecom", 0x5110, "BU 0070", "6.4.2, p. 31", "low voltage supply", "", false},
    {"drivecom", 0x7112, "BU 0070", "6.4.2, p. 31", "brake chopper overcurrent", "", false},
    {"drivecom", 0x7306, "BU 0070", "6.4.2, p. 31", "incremental encoder 2", "", false},
    {"emcy", 0x5520, "BU 0070", "6.4.2, p. 31", "EPROM", "", false},
    {"module_interbus", 0x603F, "BU 0070", "6.3.2, p. 29", "error code", "", true},
    {"module_interbus", 0x6044, "BU 0070", "6.3.2, p. 29", "actual speed value", "rpm", true},
    {"p170 module_devicenet", 1020, "BU 0280", "6.2.2, p. 65", "system bus timeout", "P151", false},
    {"p170 module_profibus", 5000, "BU 0220", "6.2.2, p. 57", "PROFIBUS ASIC", "ASIC", false},
    // Only the range of P700 and P701 tells of it: 0.0 ... 21.4.
    {"p700", 214, "BU 0220", "5.1.4, p. 48", "21.4", "", false},
    {"p700 sk300e", 102, "BU 0020", "8.1, p. 89", "bus timeout", "external connection", false},
    {"p700 sk300e", 104, "BU 0020", "8.1, p. 89", "init", "P746", false},
    {"p700 sk300e", 105, "BU 0020", "8.1, p. 89", "system error", "system failure", false},
    {"p700 sk5xxe", 101, "BU 0020", "8.1, p. 89", "system error", "system failure", false},
    {"pkw", 1, "BU 2700", "6.5.1.1", "parameter value cannot be changed", "", false},
    {"pkw", 103, "BU 2700", "6.5.1.1", "blocked by another bus participant", "exists", false},
    {"sk1x0e", 400, "BU 0280", "5.1.3, p. 50", "analog input 1", "", false},
    {"sk1x0e", 405, "BU 0280", "5.1.3, p. 50", "analog input 2", "", false},
    {"sk1x0e", 506, "BU 0280", "6.1, p. 63", "acknowledgement", "", false},
    {"sk1x0e", 707, "BU 0020", "10.5, p. 97", "software version", "", true},
    {"sk300e", 105, "BU 0020", "7.3.5, p. 77", "maximum frequency", "Hz", false},
    {"sk300e", 112, "BU 0020", "6.1.2, p. 55", "torque current limit", "", false},
    {"sk300e", 422, "BU 0020", "6.1.1, p. 54", "digital input", "", false},
    {"sk300e", 424, "BU 0020", "6.1.1, p. 54", "digital input", "", false},
    {"sk300e", 425, "BU 0020", "6.1.1, p. 54", "digital input", "", false},
    {"sk300e", 542, "BU 0020", "6.1.2, p. 55", "set analog output", "", false},
    {"sk54xe", 102, "BU 0020", "9.3, p. 94", "acceleration time", "s", false},
    {"sk54xe", 105, "BU 0020", "7.3.5, p. 77", "maximum frequency", "Hz", false},
    {"sk54xe", 514, "BU 2700", "7.2", "CAN bus baud rate", "250 kBaud", false},
    {"sk54xe", 536, "BU 0020", "6.2.2, p. 63", "current limit", "", false},
    {"sk54xe", 744, "BU 2700", "7.2", "configuration", "", true},
    {"sk5xxe", 300, "BU 0020", "6.2.2, p. 63", "servo mode", "", false},
    {"sk5xxe", 506, "BU 0020", "8, p. 88", "acknowledgement", "", false},
    {"sk5xxe", 536, "BU 0020", "6.2.2, p. 63", "current limit", "", false},
    {"sk5xxe", 610, "BU 0020", "7.3.5, p. 77", "setpoint mode", "", false},
    {"sk5xxe", 701, "BU 2700", "7.2", "last fault", "", true},
    {"sk700e", 112, "BU 0020", "6.1.2, p. 55", "torque current limit", "", false},
    {"sk700e", 300, "BU 0070", "5.1, p. 15", "servo mode", "", false},
    {"sk700e", 420, "BU 0020", "6.1.1, p. 54", "digital input", "", false},
    {"sk700e", 421, "BU 0020", "6.1.1, p. 54", "digital input", "", false},
    {"sk700e", 424, "BU 0020", "6.1.1, p. 54", "digital input", "", false},
    {"sk700e", 425, "BU 0020", "6.1.1, p. 54", "digital input", "", false},
    {"sk700e", 506, "BU 0020", "8, p. 88", "acknowledgement", "", false},
    // clang-format on
};

std::uint64_t hashOf(const std::string& text) {
  std::uint64_t hash = 0xCBF29CE484222325ull;
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001B3ull;
  hash = (hash ^ (hash >> 30)) * 0xBF58476D1CE4E5B9ull;
  hash = (hash ^ (hash >> 27)) * 0x94D049BB133111EBull;
  return hash ^ (hash >> 31);
}

using Key = std::pair<std::string, std::uint32_t>;

bool namesAManual(const std::vector<std::string>& sources) {
  return std::any_of(sources.begin(), sources.end(), [](const std::string& source) {
    return std::any_of(std::begin(kManuals), std::end(kManuals),
                       [&source](const char* manual) { return source.find(manual) != std::string::npos; });
  });
}

// The first device of a file stands for all of its devices.
std::vector<Key> allEntries() {
  std::vector<Key> keys;
  for (const std::string& file : shippedParameterFiles()) {
    const ParameterFile content = readParameterFile(file);
    for (const ParameterEntry& entry : content.entries) {
      if (namesAManual(entry.source)) keys.emplace_back(toString(content.devices.front()), entry.number);
    }
  }
  for (const std::string& file : shippedFaultFiles()) {
    YamlMap map(file, "", loadMap(file));
    const std::vector<Device> devices = readDevices(map);
    const std::string codes = map.text("codes").value_or("");
    const FaultCatalogue content = FaultCatalogue::load({file});
    for (const FaultCodes known : kAllFaultCodes) {
      if (codes != toString(known)) continue;
      const auto device = devices.empty() ? std::nullopt : std::optional<Device>(devices.front());
      for (const FaultEntry* entry : content.all(known, device)) {
        if (namesAManual(entry->source))
          keys.emplace_back(codes + (device ? " " + toString(*device) : ""), entry->number);
      }
    }
  }
  return keys;
}

// Those with the smallest hashes: an entry that is added later changes the draw little or not at all.
std::set<Key> drawn() {
  std::vector<std::pair<std::uint64_t, Key>> all;
  for (const Key& key : allEntries()) {
    all.push_back({hashOf(std::to_string(kSeed) + " " + key.first + " " + std::to_string(key.second)), key});
  }
  std::sort(all.begin(), all.end());
  std::set<Key> keys;
  for (std::size_t i = 0; i < std::min(kDrawn, all.size()); ++i) keys.insert(all[i].second);
  return keys;
}

bool holds(std::string text, std::string word) {
  for (std::string* both : {&text, &word}) {
    for (char& letter : *both) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return text.find(word) != std::string::npos;
}

std::string named(const ParameterEntry& entry, const Printed& printed) {
  const std::string kind = printed.kind;
  if (kind == "value") {
    const std::string* name = nameOf(entry.values, printed.value);
    return name == nullptr ? "" : *name;
  }
  if (kind == "bit") {
    const auto field = entry.bits.find(static_cast<unsigned>(printed.value));
    return field == entry.bits.end() ? "" : field->second.name;
  }
  const Element* element = entry.element(static_cast<unsigned>(printed.value));
  return element == nullptr ? "" : element->name;
}

TEST(DrawnFromManuals, TheTablesHoldTheDraw) {
  std::set<Key> typed;
  for (const Printed& printed : kPrinted) typed.insert({printed.device, printed.number});
  for (const Told& told : kTold) typed.insert({told.device, told.number});
  EXPECT_EQ(kPrinted.size() + kTold.size(), typed.size());
  const std::set<Key> keys = drawn();
  EXPECT_EQ(kDrawn, keys.size());
  for (const Key& key : keys) {
    EXPECT_EQ(1u, typed.count(key)) << key.first << " " << key.second << " is drawn: type it from its manual";
  }
}

/// What the catalogue says of an entry, of whichever kind.
struct Said {
  std::string name;
  std::string further;
  std::vector<std::string> source;
  bool read_only = false;
};

std::optional<Said> parameterSaid(const Told& told) {
  const auto device = deviceFrom(told.device);
  const ParameterEntry* entry = device ? shipped().find(*device, static_cast<std::uint16_t>(told.number)) : nullptr;
  if (entry == nullptr) return std::nullopt;
  Said said{entry->title(), entry->unit.value_or(""), entry->source, entry->read_only.value_or(false)};
  for (const auto& [first, value] : entry->values) said.further += " " + value.name;
  return said;
}

std::optional<Said> faultSaid(const Told& told) {
  const std::string key = told.device;
  const std::size_t space = key.find(' ');
  for (const FaultCodes codes : kAllFaultCodes) {
    if (key.substr(0, space) != toString(codes)) continue;
    const FaultEntry* entry = space == std::string::npos
                                  ? shippedFaults().find(codes, told.number)
                                  : shippedFaults().find(codes, told.number, *deviceFrom(key.substr(space + 1)));
    if (entry == nullptr) return std::nullopt;
    return Said{*entry->name, entry->cause.value_or("") + " " + entry->remedy.value_or(""), entry->source};
  }
  return std::nullopt;
}

TEST(DrawnFromManuals, EntriesSayWhatTheManualsTell) {
  for (const Told& told : kTold) {
    SCOPED_TRACE(std::string(told.device) + " " + std::to_string(told.number) + ", " + told.manual + ", " + told.place);
    auto said = parameterSaid(told);
    if (!said) said = faultSaid(told);
    ASSERT_TRUE(said);
    EXPECT_TRUE(holds(said->name, told.name)) << said->name << " / " << told.name;
    EXPECT_TRUE(holds(said->further, told.further)) << said->further << " / " << told.further;
    EXPECT_EQ(told.read_only, said->read_only);
    EXPECT_TRUE(std::any_of(said->source.begin(), said->source.end(),
                            [&told](const std::string& source) { return holds(source, told.manual); }));
  }
}

TEST(DrawnFromManuals, EntriesSayWhatTheManualsPrint) {
  for (const Printed& printed : kPrinted) {
    SCOPED_TRACE(std::string(printed.device) + " P" + std::to_string(printed.number) + ", " + printed.manual + ", " +
                 printed.place);
    const ParameterEntry* entry = shipped().find(*deviceFrom(printed.device), printed.number);
    ASSERT_NE(nullptr, entry);
    EXPECT_TRUE(entry->range);
    EXPECT_EQ(printed.lowest, entry->rawRange(1).first);
    EXPECT_EQ(printed.highest, entry->rawRange(1).second);
    const auto factory = entry->defaultOf(1);
    EXPECT_EQ(printed.factory, factory ? entry->rawOf(*factory) : kNone);
    EXPECT_EQ(printed.elements, entry->elements.value_or(0));
    EXPECT_EQ(printed.set == 'P', entry->per_set.value_or(false));
    EXPECT_EQ(printed.set == '?', !entry->per_set);
    EXPECT_EQ(printed.supervisor == 'S', entry->supervisor.value_or(false));
    EXPECT_TRUE(holds(named(*entry, printed), printed.word)) << named(*entry, printed) << " / " << printed.word;
    EXPECT_TRUE(std::any_of(entry->source.begin(), entry->source.end(), [&printed](const std::string& source) {
      return holds(source, printed.manual);
    })) << printed.manual;
  }
}

}  // namespace
}  // namespace nord_driver::catalogue
