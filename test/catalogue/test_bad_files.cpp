// What is wrong in a file is said in one sentence: file, line, key, value, expectation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "catalogue/catalogue.h"
#include "catalogue/fault_catalogue.h"
#include "catalogue/temporary_file.h"

namespace nord_driver::catalogue {
namespace {

// The sentence about a file, without the file's name in front.
template <typename Load>
std::string sentence(const std::string& text, Load load) {
  const TemporaryFile file(text);
  try {
    load(file.path());
  } catch (const ConfigError& error) {
    const std::string words = error.what();
    if (words.rfind(file.path() + ":", 0) != 0) return "the file is not named: " + words;
    return words.substr(file.path().size() + 1);
  }
  return "nothing is wrong";
}

std::string aboutParameters(const std::string& text) {
  return sentence(text, [](const std::string& path) { Catalogue::load({path}); });
}

std::string aboutFaults(const std::string& text) {
  return sentence(text, [](const std::string& path) { FaultCatalogue::load({path}); });
}

// One entry in a file that is right otherwise; its first line is line 3.
std::string aboutEntry(const std::string& entry) {
  return aboutParameters("devices: [sk5xxe]\nparameters:\n" + entry);
}

const std::string kGood = "  - number: 509\n    name: Source control word\n    source: BU 0020\n";

TEST(BadParameterFiles, AGoodOneIsRead) {
  EXPECT_EQ("nothing is wrong", aboutEntry(kGood));
}

TEST(BadParameterFiles, NoYaml) {
  EXPECT_THAT(aboutParameters("devices: [sk5xxe\n"), testing::EndsWith("; expected a readable YAML file"));
  EXPECT_EQ("1: \"words\" is not valid, expected a file of keys and values", aboutParameters("words\n"));
  try {
    Catalogue::load({"/nowhere/at/all.yaml"});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ("/nowhere/at/all.yaml: cannot be opened, expected a readable YAML file", error.what());
  }
}

// A name from the parameter server holds nobody up and takes no memory.
TEST(BadParameterFiles, APipeADeviceAndATreeWithoutEnd) {
  for (const char* const path : {"/dev/zero", "/tmp"}) {
    try {
      Catalogue::load({path});
      FAIL() << path;
    } catch (const ConfigError& error) {
      EXPECT_EQ(std::string(path) + ": it is no ordinary file, expected a readable YAML file", error.what());
    }
  }
  EXPECT_EQ("1: it is more than 50 groups and lists deep, expected a file of keys and values",
            aboutParameters("devices: [sk5xxe]\nparameters: &a [*a]\n"));
}

TEST(BadParameterFiles, TheFileItself) {
  EXPECT_EQ("1: devices is missing, expected a list of series or bus modules", aboutParameters("parameters: []\n"));
  EXPECT_EQ("1: parameters is missing, expected a list of parameters", aboutParameters("devices: [sk5xxe]\n"));
  EXPECT_EQ("2: parameters: \"none\" is not valid, expected a list of parameters",
            aboutParameters("devices: [sk5xxe]\nparameters: none\n"));
  EXPECT_EQ("1: devices: [sk5xe] is not valid, expected perhaps \"sk5xxe\"",
            aboutParameters("devices: [sk5xe]\nparameters: []\n"));
  EXPECT_EQ("1: devices: [sk5xxe, sk5xxe] is not valid, expected every device once",
            aboutParameters("devices: [sk5xxe, sk5xxe]\nparameters: []\n"));
  EXPECT_EQ("2: parameter is not a key of this file, expected perhaps \"parameters\"",
            aboutParameters("devices: [sk5xxe]\nparameter: []\nparameters: []\n"));
  EXPECT_EQ("2: devices stands here twice, expected every key once",
            aboutParameters("devices: [sk5xxe]\ndevices: [sk54xe]\nparameters: []\n"));
}

TEST(BadParameterFiles, UnknownKeys) {
  EXPECT_EQ(
      "4: number 509: titel is not a key of this file, expected one of number, name, unit, resolution, unit_unknown, "
      "range, "
      "default, per_set, elements, values, other_values, bits, format, signed, size, read_only, never_write, "
      "supervisor, note, erratum, source",
      aboutEntry("  - number: 509\n    titel: X\n    source: BU 0020\n"));
  EXPECT_EQ("6: number 509: readonly is not a key of this file, expected perhaps \"read_only\"",
            aboutEntry(kGood + "    readonly: true\n"));
}

// Found by fuzzing: what() is a text that ends at its first zero.
TEST(BadFaultFiles, AZeroDoesNotCutTheSentence) {
  const std::string codes = std::string("p7") + char{0} + "00";
  const std::string words = aboutFaults("codes: " + codes + "\nresolution: 0.1\n");
  EXPECT_THAT(words, testing::HasSubstr("p7?"));
  EXPECT_THAT(words, testing::HasSubstr("xpected"));
}

TEST(BadParameterFiles, Numbers) {
  EXPECT_EQ("3: parameters: number is missing, expected the number of the parameter", aboutEntry("  - name: X\n"));
  EXPECT_EQ("3: parameters: number: \"P509\" is not valid, expected a whole number", aboutEntry("  - number: P509\n"));
  EXPECT_EQ("3: parameters: number: \"70000\" is not valid, expected 0 ... 65535", aboutEntry("  - number: 70000\n"));
  EXPECT_EQ("6: number 509 stands twice in this file, expected it once", aboutEntry(kGood + kGood));
  EXPECT_EQ("3: parameters: \"509\" is not valid, expected a group of keys and values", aboutEntry("  - 509\n"));
}

TEST(BadParameterFiles, WhatIsMissing) {
  EXPECT_EQ("3: number 509: name is missing, expected the name of the parameter",
            aboutEntry("  - number: 509\n    source: BU 0020\n"));
  EXPECT_EQ("3: number 509: source is missing, expected where this is known from",
            aboutEntry("  - number: 509\n    name: X\n"));
}

TEST(BadParameterFiles, WrongKinds) {
  EXPECT_EQ("6: number 509: resolution: \"fine\" is not valid, expected a number",
            aboutEntry(kGood + "    resolution: fine\n"));
  EXPECT_EQ("6: number 509: resolution: \"0\" is not valid, expected a number above 0",
            aboutEntry(kGood + "    resolution: 0\n"));
  EXPECT_EQ("6: number 509: per_set: \"perhaps\" is not valid, expected true or false",
            aboutEntry(kGood + "    per_set: perhaps\n"));
  EXPECT_EQ("6: number 509: unit: [s, ms] is not valid, expected a text", aboutEntry(kGood + "    unit: [s, ms]\n"));
  EXPECT_EQ("6: number 509: size: \"24\" is not valid, expected 8, 16 or 32 bits",
            aboutEntry(kGood + "    size: 24\n"));
  EXPECT_EQ("6: number 509: format: \"octal\" is not valid, expected hex or decimal",
            aboutEntry(kGood + "    format: octal\n"));
  EXPECT_EQ("6: number 509: default: nothing is not valid, expected a number", aboutEntry(kGood + "    default:\n"));
}

TEST(BadParameterFiles, Ranges) {
  EXPECT_EQ("6: number 509: range: [10, 0] is not valid, expected the lowest value first",
            aboutEntry(kGood + "    range: [10, 0]\n"));
  EXPECT_EQ("6: number 509: range: [10] is not valid, expected two numbers, the lowest and the highest value: [0, 10]",
            aboutEntry(kGood + "    range: [10]\n"));
  EXPECT_EQ("3: number 509: range: 0 ... 70000 needs more than 16 bits, expected another size",
            aboutEntry(kGood + "    range: [0, 70000]\n"));
  EXPECT_EQ("3: number 509: default: 12 is not valid, expected a value of 0 ... 10 or one that has a name",
            aboutEntry(kGood + "    range: [0, 10]\n    default: 12\n"));
}

TEST(BadParameterFiles, NamedValues) {
  EXPECT_EQ(
      "7: number 509: values: \"four\" is not valid, expected a whole number of -2147483648 ... 2147483647, or two "
      "of them with the lower one first (13..16)",
      aboutEntry(kGood + "    values:\n      four: PROFIBUS\n"));
  EXPECT_EQ("8: number 509: values: \"3..5\" is not valid, expected every number once: it stands in two rows",
            aboutEntry(kGood + "    values:\n      4: PROFIBUS\n      3..5: reserved\n"));
  EXPECT_EQ("8: number 509: values: 4 stands here twice, expected every key once",
            aboutEntry(kGood + "    values:\n      4: PROFIBUS\n      4: CANopen\n"));
  EXPECT_EQ("7: number 509: values: 4: nothing is not valid, expected a text",
            aboutEntry(kGood + "    values:\n      4:\n"));
}

TEST(BadParameterFiles, ElementsAndBits) {
  EXPECT_EQ("6: number 509: elements: \"65\" is not valid, expected 1 ... 64, or a name for every element",
            aboutEntry(kGood + "    elements: 65\n"));
  EXPECT_EQ("3: number 509: elements: 2 has no name, expected one for every element of 1 ... 3",
            aboutEntry(kGood + "    elements: {1: A, 3: C}\n"));
  EXPECT_EQ("6: number 509: elements: 1: nam is not a key of this file, expected perhaps \"name\"",
            aboutEntry(kGood + "    elements: {1: {nam: A}}\n"));
  EXPECT_EQ("3: number 509: bits: 16 is not valid, expected 0 ... 15", aboutEntry(kGood + "    bits: {16: A}\n"));
  EXPECT_EQ("6: number 509: bits: \"8..9\" is not valid, expected every number once: it stands in two rows",
            aboutEntry(kGood + "    bits: {9: A, 8..9: B}\n"));
}

TEST(BadFaultFiles, AreNamed) {
  const std::string head = "codes: p700\nresolution: 0.1\nfaults:\n";
  EXPECT_EQ("nothing is wrong", aboutFaults(head + "  - {number: 10.2, name: X, source: S}\n"));
  EXPECT_EQ(
      "1: codes is missing, expected one of p700, p170, emcy, drivecom, pkw, dpv1, dpv1_abort, sdo_abort, "
      "devicenet_general, devicenet_allocate",
      aboutFaults("faults: []\n"));
  EXPECT_EQ("1: codes: \"p70\" is not valid, expected perhaps \"p700\"", aboutFaults("codes: p70\nfaults: []\n"));
  EXPECT_EQ("4: faults: number: \"10.25\" is not valid, expected a number as it is printed (10.2)",
            aboutFaults(head + "  - {number: 10.25, name: X, source: S}\n"));
  EXPECT_EQ(
      "4: number 10.2: reason is not a key of this file, expected one of number, name, cause, remedy, note, erratum, "
      "stands_for, source",
      aboutFaults(head + "  - {number: 10.2, name: X, reason: Y, source: S}\n"));
  EXPECT_EQ("4: number 10.2: name is missing, expected the name of the fault",
            aboutFaults(head + "  - {number: 10.2, source: S}\n"));
  EXPECT_EQ("4: number 10.2: source is missing, expected where this is known from",
            aboutFaults(head + "  - {number: 10.2, name: X}\n"));
  EXPECT_EQ("5: number 10.2 stands twice in this file, expected it once",
            aboutFaults(head + "  - {number: 10.2, name: X, source: S}\n  - {number: 10.2, name: Y, source: S}\n"));
  EXPECT_EQ("4: faults: number is missing, expected the number of the fault", aboutFaults(head + "  - {name: X}\n"));
  EXPECT_EQ("2: resolution: \"10\" is not valid, expected a number above 0 and up to 1",
            aboutFaults("codes: p700\nresolution: 10\nfaults: []\n"));
}

TEST(BadFolders, AreNamed) {
  try {
    yamlFilesIn("/nowhere/at/all");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ("/nowhere/at/all: holds no YAML file, expected the files of the catalogue", error.what());
  }
}

}  // namespace
}  // namespace nord_driver::catalogue
