// Values as people read and write them.
#include <gtest/gtest.h>

#include <string>

#include "catalogue/parameter_text.h"
#include "catalogue/shipped.h"

namespace nord_driver::catalogue {
namespace {

using profile::Series;

const ParameterEntry& entryOf(const Device& device, std::uint16_t number) {
  return *shipped().find(device, number);
}

std::string shown(const Device& device, std::uint16_t number, std::int32_t raw, unsigned index = 1) {
  return assignment(entryOf(device, number), raw, index);
}

RawValue typed(const Device& device, std::uint16_t number, const std::string& text, unsigned index = 1) {
  return rawFrom(entryOf(device, number), text, index);
}

TEST(ParameterText, ValuesWithUnitAndName) {
  EXPECT_EQ("P509 = 4 PROFIBUS", shown(Series::kSk5xxe, 509, 4));
  EXPECT_EQ("P509 = 3 System bus", shown(Series::kSk2xxe, 509, 3));
  EXPECT_EQ("P509 = 10 PROFIBUS", shown(Series::kSk300e, 509, 10));
  EXPECT_EQ("P509 = 17", shown(Series::kSk300e, 509, 17));
  EXPECT_EQ("P102 = 10.00 s", shown(Series::kSk5xxe, 102, 1000));
  EXPECT_EQ("P105 = 50.0 Hz", shown(Series::kSk5xxe, 105, 500));
  EXPECT_EQ("P151 = 0.200 s", shown(Module::kProfibus, 151, 200));
  EXPECT_EQ("P482[-03] = -100 %", shown(Series::kSk5xxe, 482, 0xFF9C, 3));
  EXPECT_EQ("P700[-01] = 10.2", shown(Series::kSk5xxe, 700, 102));
  EXPECT_EQ("P740[-01] = 047Eh", shown(Series::kSk5xxe, 740, 0x047E));
  EXPECT_EQ("object 6042h = -1500 rpm", shown(Module::kInterbus, 0x6042, -1500));
  EXPECT_EQ("object 6048h:2 = 3 s", shown(Module::kInterbus, 0x6048, 3, 2));
}

// P513 = -0.1 s arrives as FFFFh: signed, whatever stands in the high word (BU 0020 6.1.2).
TEST(ParameterText, SignedWords) {
  EXPECT_EQ("P513 = -0.1 s No error", shown(Series::kSk5xxe, 513, 0xFFFF));
  EXPECT_EQ("P513 = -0.1 s No error", shown(Series::kSk5xxe, 513, -1));
  EXPECT_EQ("P176[-02] = -1", shown(Module::kProfibus, 176, 0xFFFF, 2));
  EXPECT_EQ("P740[-02] = C000h", shown(Series::kSk5xxe, 740, -16384, 2));
}

TEST(ParameterText, BitFields) {
  EXPECT_EQ(
      "P173 = 0202h: Bus status operational (data exchange), FI 1 online, FI 2 offline, FI 3 offline, FI 4 offline",
      shown(Module::kProfibus, 173, 0x0202));
  EXPECT_EQ("P746 = 0603h: Bus interface ready, Connected to the master, Bus interface ID PROFIBUS",
            shown(Series::kSk5xxe, 746, 0x0603));
  EXPECT_EQ("P174 = 0005h: Input 1 (DIN1), Input 3 (DIN3)", shown(Module::kDevicenet, 174, 5));
  EXPECT_EQ(0x0603, typed(Series::kSk5xxe, 746, "0603h").raw);
}

// An element may have values of its own (BU 0280 5.2.2).
TEST(ParameterText, ElementsOfTheirOwn) {
  EXPECT_EQ("P162[-01] = 0 FI does not exist", shown(Module::kDevicenet, 162, 0, 1));
  EXPECT_EQ("P162[-03] = 2 NORDAC profile", shown(Module::kDevicenet, 162, 2, 3));
  EXPECT_EQ(2, typed(Module::kDevicenet, 162, "nordac profile", 3).raw);
  EXPECT_EQ(std::nullopt, typed(Module::kDevicenet, 162, "3", 3).raw);
  EXPECT_EQ(3, typed(Module::kDevicenet, 162, "3", 1).raw);
}

TEST(ParameterText, WhatPeopleType) {
  EXPECT_EQ(4, typed(Series::kSk5xxe, 509, "PROFIBUS").raw);
  EXPECT_EQ(4, typed(Series::kSk5xxe, 509, " profibus ").raw);
  EXPECT_EQ(4, typed(Series::kSk5xxe, 509, "4 PROFIBUS").raw);
  EXPECT_EQ(4, typed(Series::kSk5xxe, 509, "4").raw);
  EXPECT_EQ(1000, typed(Series::kSk5xxe, 102, "10").raw);
  EXPECT_EQ(1000, typed(Series::kSk5xxe, 102, "10.00 s").raw);
  EXPECT_EQ(1050, typed(Series::kSk5xxe, 102, "10.5s").raw);
  EXPECT_EQ(-1, typed(Series::kSk5xxe, 513, "-0.1").raw);
  EXPECT_EQ(-1, typed(Series::kSk5xxe, 513, "-0.1 s No error").raw);
  EXPECT_EQ(-1, typed(Series::kSk5xxe, 513, "no error").raw);
  EXPECT_EQ(200, typed(Module::kProfibus, 151, "0.2").raw);
  EXPECT_EQ(0x047E, typed(Series::kSk5xxe, 740, "0x047E").raw);
  EXPECT_EQ(126, typed(Module::kProfibus, 160, "126").raw);  // beyond 3 ... 125, but with a name
}

TEST(ParameterText, WhatIsRefusedIsSaid) {
  EXPECT_EQ("P509: \"PROFIBS\" is not valid, expected perhaps \"PROFIBUS\"",
            typed(Series::kSk5xxe, 509, "PROFIBS").error);
  EXPECT_EQ("P509: \"11\" is not valid, expected 0 to 10", typed(Series::kSk5xxe, 509, "11").error);
  EXPECT_EQ("P509: \"4 CANopen\" is not valid, expected \"4 PROFIBUS\", or the number alone",
            typed(Series::kSk5xxe, 509, "4 CANopen").error);
  EXPECT_EQ("P560: \"often\" is not valid, expected 0 to 1 or one of \"RAM only\", \"Write to EEPROM\"",
            typed(Series::kSk2xxe, 560, "often").error);
  EXPECT_EQ("P102: \"10.005\" is not valid, expected a multiple of 0.01 s",
            typed(Series::kSk5xxe, 102, "10.005").error);
  EXPECT_EQ("P102: \"10 ms\" is not valid, expected \"10.00 s\", or the number alone",
            typed(Series::kSk5xxe, 102, "10 ms").error);
  EXPECT_EQ("P102: \"\" is not valid, expected a value", typed(Series::kSk5xxe, 102, "  ").error);
  EXPECT_EQ("P102: \"nan\" is not valid, expected 0 to 655.35 s", typed(Series::kSk5xxe, 102, "nan").error);
  EXPECT_EQ("P102: \"999999999999999\" is not valid, expected 0 to 655.35 s",
            typed(Series::kSk5xxe, 102, "999999999999999").error);
  EXPECT_EQ("P513: \"-0.2\" is not valid, expected -0.1 to 100 s", typed(Series::kSk5xxe, 513, "-0.2").error);
  EXPECT_EQ("P740[-01]: \"10000h\" is not valid, expected 0000h to FFFFh", typed(Series::kSk5xxe, 740, "10000h").error);
}

// The numbers of P546 moved between two issues of the manual: no name may decide what is written (BU 0220, BU 0280).
TEST(ParameterText, NamesThatMovedAreNotTakenForNumbers) {
  EXPECT_EQ("P546[-02] = 17 Multiplication (BU 0280, 5.1.3 (2009, range 0 ... 24): Servo mode torque)",
            shown(Series::kSk2xxe, 546, 17, 2));
  for (const char* name : {"Multiplication", "Servo mode torque", "Bus I/O in bits 0...7"}) {
    EXPECT_EQ(std::nullopt, typed(Series::kSk2xxe, 546, name).raw) << name;
  }
  EXPECT_EQ(
      "P546[-01]: \"Multiplication\" is not valid, expected a number: BU 0280, 5.1.3 (2009, range 0 ... 24) names its "
      "values otherwise",
      typed(Series::kSk2xxe, 546, "Multiplication").error);
  EXPECT_EQ(1, typed(Series::kSk2xxe, 546, "Setpoint frequency (16 bit)").raw);
  EXPECT_EQ(17, typed(Series::kSk2xxe, 546, "17").raw);
}

// A reserved value has no name anybody could mean.
TEST(ParameterText, ReservedIsNoName) {
  EXPECT_EQ("P543 = 14 reserved", shown(Series::kSk5xxe, 543, 14));
  EXPECT_EQ(std::nullopt, typed(Series::kSk5xxe, 543, "reserved").raw);
  EXPECT_EQ(std::nullopt, typed(Series::kSk5xxe, 546, "reserved").raw);  // 12 alone is called so
}

// Where no manual tells whether it depends on the set: a plain one is tried, an array cannot be.
TEST(ParameterText, WhatIsNotSaidOfTheSets) {
  using profile::ParameterShape;
  ParameterEntry entry;
  EXPECT_EQ(ParameterShape::kPerSet, entry.shape());
  entry.read_only = true;
  EXPECT_EQ(ParameterShape::kPlain, entry.shape());
  entry.read_only = false;
  entry.elements = 2;
  EXPECT_EQ(ParameterShape::kArray, entry.shape());
  entry.per_set = true;
  EXPECT_EQ(ParameterShape::kArrayPerSet, entry.shape());
  EXPECT_EQ(ParameterShape::kArray, entryOf(Series::kSk2xxe, 465).shape());
}

TEST(ParameterText, WhatMayNotBeWritten) {
  EXPECT_EQ("P700 Current error can only be read", whyNotWritable(entryOf(Series::kSk5xxe, 700)));
  EXPECT_EQ(
      "P152 Factory setting is never written: 1 resets every parameter of the bus module: not written by the driver, "
      "neither alone nor in a restore",
      whyNotWritable(entryOf(Module::kProfibus, 152)));
  EXPECT_EQ("", whyNotWritable(entryOf(Series::kSk5xxe, 509)));
}

TEST(ParameterLookup, ByNumberAndName) {
  const ParameterEntry* entry = shipped().find(Series::kSk5xxe, 509);
  EXPECT_EQ(entry, shipped().look(Series::kSk5xxe, "509").entry);
  EXPECT_EQ(entry, shipped().look(Series::kSk5xxe, "P509").entry);
  EXPECT_EQ(entry, shipped().look(Series::kSk5xxe, "p509").entry);
  EXPECT_EQ(entry, shipped().look(Series::kSk5xxe, "source CONTROL word").entry);
  EXPECT_EQ(0x6042, shipped().look(Module::kInterbus, "0x6042").entry->number);
  EXPECT_EQ("\"sorce control word\" is not valid, expected perhaps \"Source control word\"",
            shipped().look(Series::kSk5xxe, "sorce control word").error);
  EXPECT_EQ("\"P999\" is not described for sk5xxe, expected a number of its catalogue",
            shipped().look(Series::kSk5xxe, "P999").error);
  EXPECT_EQ("\"something else entirely\" is not valid, expected the number or the name of a parameter of sk5xxe",
            shipped().look(Series::kSk5xxe, "something else entirely").error);
}

TEST(ParameterText, TellsHowAParameterIsAccessed) {
  EXPECT_EQ("", kindText(entryOf(Series::kSk5xxe, 509)));
  EXPECT_EQ("sets 1 to 4", kindText(entryOf(Series::kSk5xxe, 105)));
  EXPECT_EQ("perhaps sets 1 to 4", kindText(entryOf(Series::kSk5xxe, 506)));
  EXPECT_EQ("array of 3, read only", kindText(entryOf(Series::kSk5xxe, 700)));
  EXPECT_EQ("array of 3, sets 1 to 4", kindText(entryOf(Series::kSk2xxe, 543)));
  EXPECT_EQ("never written", kindText(entryOf(Module::kProfibus, 152)));
  EXPECT_EQ("0.01 s", stepText(entryOf(Series::kSk5xxe, 102)));
  EXPECT_EQ("1", stepText(entryOf(Series::kSk5xxe, 509)));
}

}  // namespace
}  // namespace nord_driver::catalogue
