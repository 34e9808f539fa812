#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "nord_driver/core/bytes.h"
#include "nord_driver/profibus/gsd_file.h"
#include "profibus/gsd_samples.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

std::string problems(const GsdFile& file) {
  std::string all;
  for (const GsdProblem& problem : file.problems) all += std::to_string(problem.line) + ": " + problem.text + "\n";
  return all;
}

std::string modules(const GsdFile& file) {
  std::string all;
  for (const GsdModule& module : file.modules) all += module.name + ": " + toHex(module.configuration) + "; ";
  return all;
}

TEST(GsdFile, OfATechnologyUnit) {
  const GsdFile file = parseGsd(kGsd7531);
  EXPECT_EQ("", problems(file));
  EXPECT_EQ(0x7531, file.ident_number.value_or(0));
  EXPECT_EQ("Tester", file.vendor);
  EXPECT_EQ("PBR ; 1.5M", file.model);
  EXPECT_EQ("PPO 1: F3 F1; PPO 2: F3 F5; PPO 3: F1; PPO 4: F5; ", modules(file));
  EXPECT_EQ(150u, file.maxTsdrBits(1'500'000));
  EXPECT_EQ(100u, file.maxTsdrBits(500'000));
  EXPECT_EQ(0u, file.maxTsdrBits(19'200));
  EXPECT_EQ(0u, file.maxTsdrBits(12'000'000));
  EXPECT_EQ(600us, file.min_slave_interval);
  EXPECT_TRUE(file.auto_baud);
  EXPECT_TRUE(file.sync_supported);
  EXPECT_TRUE(file.freeze_supported);
  EXPECT_FALSE(file.modular);
  EXPECT_FALSE(file.dpv1);
  EXPECT_EQ(8u, file.max_diagnosis_length);
  ASSERT_EQ(5u, file.rates.size());
  for (const GsdRate& rate : file.rates) EXPECT_EQ(rate.bits_per_second != 3'000'000, rate.supported);
}

TEST(GsdFile, OfAModularStation) {
  const GsdFile file = parseGsd(kGsd0ba8);
  EXPECT_EQ("", problems(file));
  EXPECT_EQ(0x0BA8, file.ident_number.value_or(0)) << "a block of texts says otherwise";
  EXPECT_TRUE(file.modular);
  EXPECT_EQ(5u, file.max_modules);
  EXPECT_EQ(130u, file.max_data_length);
  EXPECT_EQ("Bus I/O: 30; Empty: 00; PPO 1: F5; PPO 2: F7; ", modules(file));
  EXPECT_EQ("80 00 00", toHex(file.user_parameters));
  EXPECT_TRUE(file.dpv1);
  EXPECT_TRUE(file.c1_read_write);
  EXPECT_EQ(8u, file.c1_max_length);
  EXPECT_EQ(1s, file.c1_response_timeout);
  const GsdModule* const ppo1 = file.module("PPO 1");
  ASSERT_NE(nullptr, ppo1);
  EXPECT_EQ("11 22", toHex(ppo1->user_parameters));
  EXPECT_EQ(nullptr, file.module("PPO 9"));
  EXPECT_EQ(800u, file.maxTsdrBits(12'000'000));
}

// Lines as they end on Windows, keys in any case, nothing behind the last line.
TEST(GsdFile, EndsOfLinesAndCases) {
  const GsdFile file = parseGsd("#PROFIBUS_DP\r\nIDENT_NUMBER = 30001\r\nuser_prm_data = 1,\\\r\n 2");
  EXPECT_EQ("", problems(file));
  EXPECT_EQ(0x7531, file.ident_number.value_or(0));
  EXPECT_EQ("01 02", toHex(file.user_parameters));
}

// Whatever is wrong is named with its line, and the rest is read all the same.
TEST(GsdFile, NamesWhatIsWrong) {
  const GsdFile file = parseGsd(
      "#Profibus_DP\n"
      "Ident_Number = 0x12345\n"
      "Vendor_Name = Tester\n"
      "MaxTsdr_500 = fast\n"
      "User_Prm_Data = 0x01, 0x100\n"
      "User_Prm_Data_Len = 2\n"
      "Ext_User_Prm_Data_Const(0) = 1,2,3\n"
      "Ext_User_Prm_Data_Const(230) = 1,2,3,4,5,6,7,8\n"
      "EndModule\n"
      "Module = PPO1 0xF1\n"
      "Module = \"PPO 3\" 0xF1,\n"
      "EndModule\n"
      "Module = \"PPO 4\" 0xF5\n"
      "PrmText=1\n");
  EXPECT_EQ(
      "2: ident_number = \"0x12345\": expected a number of at most 65535\n"
      "3: vendor_name without quotes\n"
      "4: maxtsdr_500 = \"fast\": expected a number of at most 65535\n"
      "5: User_Prm_Data is no list of at most 237 bytes\n"
      "8: Ext_User_Prm_Data_Const needs (offset) = bytes, 237 at most\n"
      "9: EndModule without Module\n"
      "10: a module without a name in quotes\n"
      "10: module \"\": \"PPO1 0xF1\" is no list of bytes\n"
      "11: Module inside of a Module\n"
      "11: module \"PPO 3\": \"0xF1,\" is no list of bytes\n"
      "14: this block has no end (endprmtext)\n"
      "13: this module has no EndModule\n"
      "1: no Ident_Number\n"
      "6: User_Prm_Data_Len is 2, but there are 3 bytes: all are kept\n",
      problems(file));
  EXPECT_EQ("01 02 03", toHex(file.user_parameters));
  EXPECT_EQ("PPO 4", file.modules.back().name);
}

TEST(GsdFile, TheSameModuleTwiceIsNone) {
  const GsdFile file =
      parseGsd("#Profibus_DP\nIdent_Number=1\nModule=\"A\" 0x10\nEndModule\nModule=\"A\" 0x20\nEndModule\n");
  EXPECT_EQ(nullptr, file.module("A"));
}

TEST(GsdFile, OfNothing) {
  EXPECT_EQ("1: no #Profibus_DP: this may be no GSD file\n1: no Ident_Number\n", problems(parseGsd("")));
}

// However a file is cut, it is read to its end, and every problem names a line of it.
RC_GTEST_PROP(GsdFile, CutAnywhere, ()) {
  const std::string whole = kGsd0ba8;
  const auto cut = *rc::gen::inRange<std::size_t>(0, whole.size());
  auto text = whole.substr(0, cut);
  if (!text.empty()) text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::arbitrary<char>();
  const GsdFile file = parseGsd(text);
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  for (const GsdProblem& problem : file.problems) RC_ASSERT(problem.line >= 1 && problem.line <= lines);
  RC_ASSERT(file.user_parameters.size() <= 237u);
}

}  // namespace
}  // namespace nord_driver::profibus
