#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "devicenet/eds_entries.h"
#include "devicenet/eds_file.h"
#include "devicenet/eds_samples.h"

namespace nord_driver::devicenet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> problemsOf(const std::string& text) {
  std::vector<std::string> all;
  for (const EdsProblem& problem : parseEds(text).problems) {
    all.push_back(std::to_string(problem.line) + ": " + problem.text);
  }
  return all;
}

TEST(EdsFile, Sample) {
  const EdsFile file = parseEds(kEds);
  EXPECT_THAT(problemsOf(kEds), IsEmpty());
  EXPECT_EQ("SK CU4-DEV", file.product);
  EXPECT_EQ(389u, file.vendor_id->value);
  EXPECT_EQ(6u, file.vendor_id->line);
  EXPECT_EQ(2u, file.device_type->value);
  EXPECT_EQ(7u, file.product_code->value);
  EXPECT_EQ(13u, file.io_line);
  EXPECT_EQ(3u, file.poll->value);
  EXPECT_EQ(16u, file.strobe->line);
  EXPECT_EQ(4u, file.change_of_state->value);
  EXPECT_FALSE(file.cyclic);
  ASSERT_EQ(4u, file.inputs.size());
  EXPECT_EQ(5u, file.inputs[1].bytes);
  EXPECT_EQ(7u, file.inputs[1].kinds);
  EXPECT_EQ(std::uint8_t{110}, file.inputs[1].assembly) << "an entry over several lines, with comments between";
  EXPECT_EQ(19u, file.inputs[1].line);
  EXPECT_EQ(33u, file.inputs[2].bytes);
  ASSERT_EQ(3u, file.outputs.size());
  EXPECT_EQ(std::uint8_t{100}, file.outputs[1].assembly);
}

TEST(EdsFile, LineEndsOfWindowsAndAByteOrderMark) {
  std::string text = "\xEF\xBB\xBF";
  for (const char* at = kEds; *at != '\0'; ++at) text += *at == '\n' ? std::string{"\r\n"} : std::string{*at};
  EXPECT_THAT(problemsOf(text), IsEmpty());
  EXPECT_EQ(6u, parseEds(text).vendor_id->line);
}

TEST(EdsFile, ProblemsNameTheirLine) {
  EXPECT_THAT(problemsOf(""), ElementsAre("1: no section [Device]: this may be no EDS file of DeviceNet"));
  EXPECT_THAT(
      problemsOf("[Device]\nVendCode = 38x;\nProdCode = 70000;\nProdType = ;\n"),
      ElementsAre("2: VendCode: \"38x\" is no number from 0 to 65535",
                  "3: ProdCode: \"70000\" is no number from 0 to 65535", "4: ProdType has no value in field 1"));
  EXPECT_THAT(problemsOf("[Device]\nVendCode = 389\n[IO_Info]\nInput1 = 5, 0;\n"),
              ElementsAre("2: \"VendCode\" does not end with a semicolon", "4: Input1 has no value in field 3"));
  EXPECT_THAT(
      problemsOf("[Device\nVendCode = 1;\nVendCode = 2;\n"),
      ElementsAre("1: \"[Device\" has no closing bracket", "3: VendCode stands twice; the first one (line 2) holds"));
  EXPECT_THAT(problemsOf("VendCode = 1;\n[Device]\nProdName = \"SK;\nwhat\n"),
              ElementsAre("1: \"VendCode\" stands before the first section", "3: a text has no closing quotation mark",
                          "3: \"ProdName\" does not end with a semicolon"));
  EXPECT_THAT(problemsOf("[Device]\nwhat\nVendCode = 1;"),
              ElementsAre("2: \"what\" is no section, no key with a value and no comment"));
}

// What was wrong is left out, the rest is read.
TEST(EdsFile, GoesOnAfterAProblem) {
  EXPECT_EQ(389u, parseEds("[Device]\nwhat\nVendCode = 389;\n").vendor_id->value);
  const EdsFile file = parseEds("[Device]\nVendCode = 389\n[IO_Info]\nInput1 = x, 0, 1;\nOutput1 = 5, 0, 1;\n");
  EXPECT_EQ(389u, file.vendor_id->value);
  EXPECT_THAT(file.inputs, IsEmpty());
  ASSERT_EQ(1u, file.outputs.size());
  EXPECT_FALSE(file.outputs[0].assembly);
}

// No text takes it out of its way, whatever was cut off or put in.
TEST(EdsFile, AnyPartOfTheSample) {
  const std::string whole = kEds;
  for (std::size_t end = 0; end < whole.size(); ++end) {
    for (const EdsProblem& problem : parseEds(whole.substr(0, end)).problems) ASSERT_LT(0u, problem.line);
    for (const EdsProblem& problem : parseEds(whole.substr(end)).problems) ASSERT_LT(0u, problem.line);
    std::string changed = whole;
    changed[end] = "=;,\"[$\n\\"[end % 8];
    parseEds(changed);
  }
}

std::string firstField(const std::string& text) {
  std::vector<EdsProblem> problems;
  const auto entries = splitEds(text, problems);
  return entries.size() < 2 || entries[1].fields.empty() ? "none" : entries[1].fields[0].text;
}

// A backslash takes the character behind it as it is; at the end of a line or of the text there is none.
TEST(EdsEntries, BackslashesInTexts) {
  EXPECT_EQ("a \"b\" c", firstField("[Device]\nProdName = \"a \\\"b\\\" c\";"));
  EXPECT_EQ("a\\b", firstField("[Device]\nProdName = \"a\\\\b\";"));
  EXPECT_EQ("a\\", firstField("[Device]\nProdName = \"a\\\n;"));
  EXPECT_EQ("a\\", firstField("[Device]\nProdName = \"a\\"));
}

// A section begins a line, spaces before it or not; a bracket within a line is a part of what stands there.
TEST(EdsFile, WhatBeginsASection) {
  const std::string indented = "[Device]\nVendCode = 389\n  [IO_Info]\nPollInfo = 7, 1, 1;\n";
  EXPECT_THAT(problemsOf(indented), ElementsAre("2: \"VendCode\" does not end with a semicolon"));
  EXPECT_EQ(7u, parseEds(indented).poll->value);
  EXPECT_THAT(problemsOf("[Device]\nProdName = \"A\"\n,[ IO_Info ];\nVendCode = 389;\n"), IsEmpty());
}

TEST(EdsEntries, Numbers) {
  EXPECT_EQ(0u, edsNumber("0"));
  EXPECT_EQ(10u, edsNumber("010"));
  EXPECT_EQ(0xFFFFFFFFu, edsNumber("0xFFFFffff"));
  for (const char* none : {"", "0x", "-1", "4294967296", "0x100000000", "1.0", "A"})
    EXPECT_FALSE(edsNumber(none)) << none;
}

// Bits of kinds are 32, numbers of the identity 16: each up to its last one.
TEST(EdsFile, NumbersUpToTheirLast) {
  const std::string text =
      "[Device]\nVendCode = 65535;\nProdType = 65536;\n[IO_Info]\nPollInfo = 0xFFFFFFFF, 1, 1;\nInput1 = 65535, 0, "
      "0xFFFFFFFF;\nInput2 = 65536, 0, 1;\n";
  EXPECT_THAT(problemsOf(text), ElementsAre("3: ProdType: \"65536\" is no number from 0 to 65535",
                                            "7: Input2: \"65536\" is no number from 0 to 65535"));
  const EdsFile file = parseEds(text);
  EXPECT_EQ(65535u, file.vendor_id->value);
  EXPECT_FALSE(file.device_type);
  EXPECT_EQ(0xFFFFFFFFu, file.poll->value);
  ASSERT_EQ(1u, file.inputs.size());
  EXPECT_EQ(65535u, file.inputs[0].bytes);
  EXPECT_EQ(0xFFFFFFFFu, file.inputs[0].kinds);
}

// Class 4 and an instance, one byte each; what stands behind is the attribute.
TEST(EdsFile, APathOfAnotherFormNamesNoAssembly) {
  const auto assembly = [](const std::string& fields) {
    const EdsFile file = parseEds("[Device]\n[IO_Info]\nInput1 = 5, 0, 1, \"x\", 6" + fields + ";\n");
    return file.inputs.size() == 1 && file.inputs[0].assembly ? int{*file.inputs[0].assembly} : -1;
  };
  EXPECT_EQ(110, assembly(", \"20 04 24 6E 30 03\", \"\""));
  EXPECT_EQ(110, assembly(", \"20 04 24 6E\"")) << "the last field";
  EXPECT_EQ(-1, assembly("")) << "no field at all";
  for (const char* other :
       {"", "20 04 24", "21 04 24 6E", "20 05 24 6E", "20 04 25 6E", "20 04 24 6", "20 04 24 06E", "20 04 24 XY"}) {
    EXPECT_EQ(-1, assembly(std::string{", \""} + other + "\"")) << other;
  }
}

// Of a name, a section and a number the first holds; a key that only begins like an input is none.
TEST(EdsFile, TheFirstHolds) {
  const std::string text =
      "[Device]\nProdName = \"A\";\nProdName = \"B\";\n[IO_Info]\nStrobeInfo = 1, 1, 1;\n[IO_Info]\nStrobeInfo = 2, 1, "
      "1;\nInput = 5, 0, 1;\nInputX = 5, 0, 1;\nXInput1 = 5, 0, 1;\nOutput7 = 5, 0, 1;\n";
  EXPECT_THAT(problemsOf(text), ElementsAre("7: StrobeInfo stands twice; the first one (line 5) holds"));
  const EdsFile file = parseEds(text);
  EXPECT_EQ("A", file.product);
  EXPECT_EQ(4u, file.io_line);
  EXPECT_EQ(1u, file.strobe->value);
  EXPECT_THAT(file.inputs, IsEmpty());
  EXPECT_EQ(1u, file.outputs.size());
}

}  // namespace
}  // namespace nord_driver::devicenet
