// 60 entries, drawn by a fixed seed from those with a range, against what their manuals print, typed by hand from there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "catalogue/shipped.h"

namespace nord_driver::catalogue {
namespace {

constexpr int kSeed = 20150;
constexpr std::size_t kDrawn = 60;
constexpr int kNone = -99999;  // the manual prints no factory setting

/// One parameter as the manual prints it. Numbers are raw: P513 = -0.1 ... 100.0 s is -1 ... 1000.
struct Printed {
  const char* device;
  std::uint16_t number;
  const char* manual;
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
    {"module_devicenet", 150, "BU 0280", 0, 4, 0, 0, '-', '-', 3, "value", "Output 2 on"},
    {"module_devicenet", 152, "BU 0280", 0, 1, 0, 0, '-', '-', 1, "value", "Load factory settings"},
    {"module_devicenet", 162, "BU 0280", 0, 8, 0, 3, '-', '-', 0, "value", "FI does not exist"},
    {"module_devicenet", 165, "BU 0280", 0, 8, 0, 3, '-', '-', 2, "element", "control values"},
    // 0.0 ... 9999.9 is printed, a word ends at 6553.5
    {"module_devicenet", 171, "BU 0280", 0, 65535, 0, 3, '-', '-', 2, "element", "Software revision"},
    {"module_devicenet", 172, "BU 0280", 0, 2, 0, 0, '-', '-', 1, "value", "external module"},
    {"module_devicenet", 181, "BU 0280", 0, 2, 0, 0, '-', '-', 1, "value", "250 kBaud"},
    // BU 2700 7.1
    {"module_profibus", 150, "BU 2700", 0, 4, 0, 0, '-', '-', 2, "value", "Output 1 On (DO1)"},
    {"module_profibus", 151, "BU 2700", -1, 32767, 0, 0, '-', '-', -1, "value", "Monitoring Off"},
    {"module_profibus", 152, "BU 2700", 0, 1, 0, 0, '-', '-', 1, "value", "Load factory setting"},
    {"module_profibus", 153, "BU 2700", 0, 250, 10, 2, '-', '-', 2, "element", "TxPDO Inhibit Time"},
    {"module_profibus", 160, "BU 2700", 3, 125, 126, 0, '-', '-', 0, "", ""},
    {"module_profibus", 170, "BU 2700", 0, 9999, kNone, 2, '-', '-', 2, "element", "Last error"},
    {"module_profibus", 172, "BU 0220", 0, 2, kNone, 0, '-', '-', 2, "value", "Bus TB"},
    {"module_profibus", 173, "BU 2700", 0, 65535, kNone, 0, '-', '-', 5, "bit", "PROFIBUS DP Watchdog active"},
    {"module_profibus", 180, "BU 2700", 3, 125, kNone, 0, '-', '-', 0, "", ""},
    {"module_profibus", 181, "BU 2700", 0, 15, kNone, 0, '-', '-', 4, "value", "500 kbit/s"},
    {"module_profibus", 182, "BU 2700", 0, 255, kNone, 5, '-', '-', 241, "value", "PPO 3"},
    // BU 0220 5.1, BU 0280 5.1
    {"sk1x0e", 420, "BU 0220", 0, 77, 1, 4, '-', '-', 14, "value", "Remote control"},
    {"sk1x0e", 480, "BU 0280", 0, 72, 1, 12, '-', '-', 11, "element", "Bit 8"},
    {"sk1x0e", 482, "BU 0280", -400, 400, 100, 8, '-', '-', 0, "", ""},
    {"sk1x0e", 701, "BU 0280", 0, 214, kNone, 5, '-', '-', 0, "", ""},
    {"sk1x0e", 748, "BU 0220", 0, 65535, kNone, 0, '-', '-', 3, "bit", "Bus module is online"},
    {"sk1x0e", 749, "BU 0220", 0, 511, kNone, 0, '-', '-', 8, "bit", "EEPROM memory module"},
    // BU 0020 6.1; P551: BU 0070 5.1
    {"sk300e", 481, "BU 0020", 0, 38, 0, 8, '-', 'S', 8, "element", "Bit 7"},
    {"sk300e", 508, "BU 0020", 1, 126, 1, 0, '-', '-', 0, "", ""},
    {"sk300e", 509, "BU 0020", 0, 21, 0, 0, '-', '-', 9, "value", "Profibus control word"},
    {"sk300e", 544, "BU 0020", 0, 12, 0, 0, 'P', 'S', 9, "value", "Error number"},
    {"sk300e", 545, "BU 0020", 0, 12, 0, 0, 'P', 'S', 12, "value", "Out Bits 0...7"},
    {"sk300e", 546, "BU 0020", 0, 7, 1, 0, 'P', 'S', 7, "value", "In Bits 0-7"},
    {"sk300e", 551, "BU 0070", 0, 1, 0, 0, '-', '-', 1, "value", "DRIVECOM 21"},
    {"sk300e", 741, "BU 0020", 0, 65535, kNone, 5, '-', 'S', 5, "element", "Out Bit"},
    {"sk300e", 745, "BU 0020", 0, 32767, kNone, 0, '-', '-', 0, "", ""},
    {"sk300e", 746, "BU 0020", 0, 65535, kNone, 0, '-', 'S', 0, "bit", "Module ready"},
    // BU 0020 6.2; the range of P513 is that of BU 0280 5.1.3, its page in BU 0020 is damaged
    {"sk54xe", 481, "BU 0020", 0, 39, 0, 10, '-', 'S', 6, "element", "DO2 of the first SK xU4-IOE"},
    {"sk54xe", 508, "BU 0020", 1, 126, 1, 0, '-', '-', 0, "", ""},
    {"sk54xe", 509, "BU 0020", 0, 10, 0, 0, '-', '-', 6, "value", "CANopen"},
    {"sk54xe", 513, "BU 0280", -1, 1000, kNone, 0, '-', '-', -1, "value", "no error"},
    {"sk54xe", 546, "BU 0020", 0, 57, 1, 5, 'P', 'S', 48, "value", "Motor temperature"},
    {"sk54xe", 740, "BU 0020", 0, 65535, kNone, 23, '-', 'S', 18, "element", "PLC control word"},
    // BU 0020 6.2; P510: BU 0070 5.1, where the factory setting of P543 stands too
    {"sk5xxe", 482, "BU 0020", -400, 400, 100, 10, '-', 'S', 0, "", ""},
    {"sk5xxe", 508, "BU 0020", 1, 126, 1, 0, '-', '-', 0, "", ""},
    {"sk5xxe", 510, "BU 0070", 0, 8, 0, 2, '-', '-', 4, "value", "Profibus"},
    {"sk5xxe", 543, "BU 0020", 0, 24, 1, 0, 'P', 'S', 17, "value", "Value analog input 1"},
    {"sk5xxe", 544, "BU 0020", 0, 24, 0, 0, 'P', 'S', 23, "value", "Actual frequency with slip"},
    {"sk5xxe", 740, "BU 0020", 0, 65535, kNone, 13, '-', 'S', 6, "element", "Parameter data In 1"},
    {"sk5xxe", 741, "BU 0020", 0, 65535, kNone, 13, '-', 'S', 4, "element", "Actual value 3"},
    {"sk5xxe", 745, "BU 0020", 0, 9999, kNone, 0, '-', '-', 0, "", ""},
    {"sk5xxe", 746, "BU 2700", 0, 65535, kNone, 0, '-', 'S', 5, "bit", "Timeout error"},
    // BU 0020 6.1; P560: BU 0280 5.1.3 has the range
    {"sk700e", 481, "BU 0020", 0, 38, 0, 8, '-', 'S', 1, "element", "Bit 0"},
    {"sk700e", 483, "BU 0020", 1, 100, 10, 8, '-', 'S', 0, "", ""},
    {"sk700e", 507, "BU 0020", 1, 4, 1, 0, '-', '-', 0, "", ""},
    {"sk700e", 508, "BU 0020", 1, 126, 1, 0, '-', '-', 0, "", ""},
    {"sk700e", 510, "BU 0020", 0, 8, 0, 2, '-', 'S', 6, "value", "DeviceNet"},
    {"sk700e", 513, "BU 0020", -1, 10000, 0, 0, '-', 'S', -1, "value", "No error"},
    {"sk700e", 545, "BU 0020", 0, 12, 0, 0, 'P', 'S', 6, "value", "Actual position"},
    {"sk700e", 546, "BU 0020", 0, 7, 1, 0, 'P', 'S', 3, "value", "32 Bit setpoint position"},
    {"sk700e", 560, "BU 0280", 0, 1, kNone, 0, '-', '-', 0, "", ""},
    {"sk700e", 741, "BU 0020", 0, 65535, kNone, 6, '-', 'S', 3, "element", "Actual value 1 High byte"},
    {"sk700e", 746, "BU 0020", 0, 65535, kNone, 3, '-', 'S', 2, "element", "Customer unit"},
    // clang-format on
};

std::uint64_t hashOf(const std::string& text) {
  std::uint64_t hash = 0xCBF29CE484222325ull;
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001B3ull;
  hash = (hash ^ (hash >> 30)) * 0xBF58476D1CE4E5B9ull;
  hash = (hash ^ (hash >> 27)) * 0x94D049BB133111EBull;
  return hash ^ (hash >> 31);
}

using Key = std::pair<std::string, std::uint16_t>;

// Those with the smallest hashes: an entry that is added later changes the draw little or not at all.
std::set<Key> drawn() {
  std::vector<std::pair<std::uint64_t, Key>> all;
  for (const std::string& file : shippedParameterFiles()) {
    const ParameterFile content = readParameterFile(file);
    const std::string device = toString(content.devices.front());
    for (const ParameterEntry& entry : content.entries) {
      if (!entry.range) continue;
      const std::string text = std::to_string(kSeed) + " " + device + " " + std::to_string(entry.number);
      all.push_back({hashOf(text), {device, entry.number}});
    }
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

TEST(DrawnFromManuals, TheTableHoldsTheDraw) {
  std::set<Key> typed;
  for (const Printed& printed : kPrinted) typed.insert({printed.device, printed.number});
  EXPECT_EQ(kPrinted.size(), typed.size());
  const std::set<Key> keys = drawn();
  EXPECT_EQ(kDrawn, keys.size());
  for (const Key& key : keys) {
    EXPECT_EQ(1u, typed.count(key)) << key.first << " " << key.second << " is drawn: type it from its manual";
  }
}

TEST(DrawnFromManuals, EntriesSayWhatTheManualsPrint) {
  for (const Printed& printed : kPrinted) {
    SCOPED_TRACE(std::string(printed.device) + " P" + std::to_string(printed.number));
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
