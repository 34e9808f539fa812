// A user's own files laid over those of the project.
#include <gtest/gtest.h>

#include <string>

#include "catalogue/parameter_text.h"
#include "catalogue/shipped.h"
#include "catalogue/temporary_file.h"

namespace nord_driver::catalogue {
namespace {

using profile::Series;

Catalogue with(const std::string& text) {
  const TemporaryFile file(text);
  std::vector<std::string> files = shippedParameterFiles();
  files.push_back(file.path());
  return Catalogue::load(files);
}

// One key is corrected, the others stay.
TEST(Overlay, CorrectsKeyByKey) {
  const Catalogue own = with(
      "devices: [sk5xxe]\nparameters:\n"
      "  - number: 513\n    range: [-0.1, 200.0]\n    source: measured on our drive\n");
  const ParameterEntry* entry = own.find(Series::kSk5xxe, 513);
  ASSERT_NE(nullptr, entry);
  EXPECT_EQ("Telegram timeout", entry->title());
  EXPECT_EQ(2000, entry->rawRange(1).second);
  EXPECT_EQ("s", entry->unitOf(1));
  EXPECT_EQ(std::vector<std::string>{"measured on our drive"}, entry->source);
  EXPECT_EQ(1000, own.find(Series::kSk54xe, 513)->rawRange(1).second);
}

// Who has measured what a step of it is, writes it in that.
TEST(Overlay, NamesAnUnknownUnit) {
  const Catalogue own = with("devices: [sk5xxe]\nparameters:\n  - number: 426\n    unit: s\n    resolution: 0.01\n");
  EXPECT_FALSE(own.find(Series::kSk5xxe, 426)->isUnitUnknown(1));
  EXPECT_EQ(10, rawFrom(*own.find(Series::kSk5xxe, 426), "0.1").raw);
  EXPECT_TRUE(own.find(Series::kSk54xe, 426)->isUnitUnknown(1));
  EXPECT_FALSE(own.find(Series::kSk54xe, 301) != nullptr && own.find(Series::kSk54xe, 301)->isUnitUnknown(1));
}

// Named values, elements and bits are corrected and added one by one.
TEST(Overlay, CorrectsNamesOneByOne) {
  const Catalogue own = with(
      "devices: [sk5xxe]\nparameters:\n"
      "  - number: 509\n    values: {8: EtherCAT, 11: Another bus}\n"
      "  - number: 740\n    elements: {5: Bits, 14: One more}\n"
      "  - number: 746\n    bits: {8..11: Low half, 3: New bit}\n");
  const ParameterEntry* source = own.find(Series::kSk5xxe, 509);
  EXPECT_EQ("P509 = 8 EtherCAT", assignment(*source, 8));
  EXPECT_EQ("P509 = 4 PROFIBUS", assignment(*source, 4));
  EXPECT_EQ(11, rawFrom(*source, "another bus").raw);
  const ParameterEntry* bus_in = own.find(Series::kSk5xxe, 740);
  EXPECT_EQ(14u, bus_in->elements);
  EXPECT_EQ("Control word", bus_in->element(1)->name);
  EXPECT_EQ("Bits", bus_in->element(5)->name);
  const ParameterEntry* state = own.find(Series::kSk5xxe, 746);
  EXPECT_EQ("0609h: Bus interface ready, New bit, Low half 6", valueText(*state, 0x0609));
}

// A bit takes the place of the group it belonged to.
TEST(Overlay, ABitReplacesItsGroup) {
  const Catalogue own = with("devices: [sk5xxe]\nparameters:\n  - number: 746\n    bits: {9: My bit}\n");
  EXPECT_EQ("0603h: Bus interface ready, Connected to the master, My bit",
            valueText(*own.find(Series::kSk5xxe, 746), 0x0603));
}

// A value in the middle of reserved ones gets a name of its own.
TEST(Overlay, NamesAReservedValue) {
  const Catalogue own = with("devices: [sk5xxe]\nparameters:\n  - number: 543\n    values: {14: My value}\n");
  const ParameterEntry* entry = own.find(Series::kSk5xxe, 543);
  EXPECT_EQ("14 My value", valueText(*entry, 14));
  EXPECT_EQ("13 reserved", valueText(*entry, 13));
}

TEST(Overlay, AddsParameters) {
  const Catalogue own = with(
      "devices: [sk5xxe, sk54xe]\nparameters:\n"
      "  - number: 719\n    name: Actual current\n    unit: A\n    resolution: 0.1\n    read_only: true\n"
      "    source: manual of the inverter\n");
  EXPECT_EQ("P719 = 12.3 A", assignment(*own.find(Series::kSk54xe, 719), 123));
  EXPECT_EQ(nullptr, own.find(Series::kSk2xxe, 719));
  EXPECT_EQ(nullptr, shipped().find(Series::kSk54xe, 719));
}

// What two files say together must fit: the sentence names the last one.
TEST(Overlay, IsCheckedWithWhatLiesBelow) {
  const TemporaryFile file("devices: [sk5xxe]\nparameters:\n  - number: 507\n    default: 5\n");
  std::vector<std::string> files = shippedParameterFiles();
  files.push_back(file.path());
  try {
    Catalogue::load(files);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_EQ(
        file.path() + ":3: number 507: default: 5 is not valid, expected a value of 1 ... 4 or one that has a name",
        error.what());
  }
}

TEST(Overlay, FaultsAsWell) {
  const TemporaryFile file(
      "codes: p700\nresolution: 0.1\ndevices: [sk5xxe]\nfaults:\n"
      "  - {number: 10.2, remedy: ask Otto}\n"
      "  - {number: 77.7, name: own fault, source: our drive}\n");
  std::vector<std::string> files = shippedFaultFiles();
  files.push_back(file.path());
  const FaultCatalogue own = FaultCatalogue::load(files);
  const FaultEntry* fault = own.find(FaultCodes::kP700, 102, Series::kSk5xxe);
  ASSERT_NE(nullptr, fault);
  EXPECT_EQ("bus timeout of the option", fault->name);
  EXPECT_EQ("ask Otto", fault->remedy);
  EXPECT_NE("ask Otto", own.find(FaultCodes::kP700, 102, Series::kSk54xe)->remedy);
  EXPECT_NE(nullptr, own.find(FaultCodes::kP700, 777, Series::kSk5xxe));
  EXPECT_EQ(nullptr, own.find(FaultCodes::kP700, 777, Series::kSk2xxe));
}

}  // namespace
}  // namespace nord_driver::catalogue
