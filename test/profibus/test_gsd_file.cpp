#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "nord_driver/core/bytes.h"
#include "profibus/gsd_file.h"
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

// What a file does not speak of its device cannot, and nothing is known of its limits.
TEST(GsdFile, OfADeviceThatCanDoNothing) {
  const GsdFile file = parseGsd("#Profibus_DP\nIdent_Number = 1\n19.2_supp = 1\n");
  EXPECT_EQ("", problems(file));
  EXPECT_FALSE(file.auto_baud || file.sync_supported || file.freeze_supported || file.modular);
  EXPECT_FALSE(file.dpv1 || file.c1_read_write);
  EXPECT_EQ(0u, file.c1_max_length);
  EXPECT_EQ(0u, file.revision);
  EXPECT_EQ(0u, file.max_modules + file.max_input_length + file.max_output_length + file.max_data_length);
  EXPECT_EQ(0u, file.max_diagnosis_length + file.max_user_parameters);
  EXPECT_EQ(0u, file.maxTsdrBits(19'200));
  EXPECT_EQ(Duration::zero(), file.min_slave_interval);
  EXPECT_EQ(Duration::zero(), file.c1_response_timeout);
}

// A comment behind a text: the quotation mark that ends the text ends it for the comment, too.
TEST(GsdFile, CommentsBehindATextInQuotes) {
  const GsdFile file = parseGsd(
      "#Profibus_DP\nIdent_Number=1\nModule = \"PPO; 1\" 0xF3,0xF1 ; 4 words, 2 words\nEndModule\n"
      "Module = 'it is \"2\"' 0xF7 ; another\nEndModule\n");
  EXPECT_EQ("", problems(file));
  EXPECT_EQ("PPO; 1: F3 F1; it is \"2\": F7; ", modules(file));
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

// What an engineering tool would offer: its defaults lie over the constant bytes (EN 50170-8, Ext_User_Prm_Data_Ref).
constexpr const char* kReferences = R"(#Profibus_DP
Ident_Number = 1
ExtUserPrmData = 1 "Supply"
Bit(3) 1 0-1
Prm_Text_Ref = 7
EndExtUserPrmData
ExtUserPrmData = 2 "Filter"
BitArea(4-6) 5 0-7
EndExtUserPrmData
ExtUserPrmData = 3 "Unit"
Unsigned8 0x2A 0-255
EndExtUserPrmData
extuserprmdata = 0x04 "Limit"
UNSIGNED16 1000 0-2000
EndExtUserPrmData
ExtUserPrmData = 5 "Offset"
Signed16 -2 -100-100
EndExtUserPrmData
ExtUserPrmData = 6 "Mask"
Unsigned32 4042322160 0-4294967295
EndExtUserPrmData
ExtUserPrmData = 7 "Off"
Bit ( 0 ) 0 0-1
EndExtUserPrmData
ExtUserPrmData = 8 "Trim"
Signed8 -1 -128-127
EndExtUserPrmData
ExtUserPrmData = 9 "Way"
Signed32 -2 -10,-2,0,5
EndExtUserPrmData
PrmText = 7
Text(0) = "off"
EndPrmText
)";

std::string stationParameters(const std::string& lines) {
  const GsdFile file = parseGsd(kReferences + lines);
  EXPECT_EQ("", problems(file)) << lines;
  return toHex(file.user_parameters);
}

TEST(GsdFile, DefaultsLieOverTheConstantBytes) {
  EXPECT_EQ("80 FF 2A FF", stationParameters("Ext_User_Prm_Data_Const(0) = 0x80,0xFF,0xFF,0xFF\n"
                                             "Ext_User_Prm_Data_Ref(2) = 3\n"));
  EXPECT_EQ("00 03 E8", stationParameters("Ext_User_Prm_Data_Const(0) = 0,0,0\nExt_User_Prm_Data_Ref(1) = 4\n"))
      << "high byte first";
  EXPECT_EQ("FF FE", stationParameters("Ext_User_Prm_Data_Ref(0) = 5\n")) << "nothing below: zeros";
  EXPECT_EQ("F0 F0 F0 F0", stationParameters("Ext_User_Prm_Data_Ref(0) = 6\n"));
  EXPECT_EQ("FF FF FF FE FF", stationParameters("Ext_User_Prm_Data_Ref(0) = 9\nExt_User_Prm_Data_Ref(4) = 8\n"));
  EXPECT_EQ("2A 00", stationParameters("Ext_User_Prm_Data_Ref(0) = 3\nExt_User_Prm_Data_Const(0) = 0,0\n"))
      << "the reference wins wherever it stands";
}

// The older key has a general value for all bytes, the newer one those that must be as they are, in whatever order.
TEST(GsdFile, ConstantBytesLieOverTheUserParametersWhereverTheyStand) {
  const std::string data = "User_Prm_Data_Len = 5\nUser_Prm_Data = 0x11,0x12,0x13,0x14\n";
  const std::string constants = "Ext_User_Prm_Data_Const(0) = 0x80\nExt_User_Prm_Data_Const(2) = 0xFF,0xFE\n";
  EXPECT_EQ("80 12 FF FE 00", stationParameters(data + constants));
  EXPECT_EQ("80 12 FF FE 00", stationParameters(constants + data));
  EXPECT_EQ("80 2A FF FE 00", stationParameters(constants + "Ext_User_Prm_Data_Ref(1) = 3\n" + data))
      << "and the defaults over both";
  EXPECT_EQ("02", stationParameters("Ext_User_Prm_Data_Const(0) = 1\nExt_User_Prm_Data_Const(0) = 2\n"))
      << "of two the one further below counts";
}

// Of a byte only the bits of the field are replaced.
TEST(GsdFile, BitsAreLaidIntoTheirByte) {
  EXPECT_EQ("08", stationParameters("Ext_User_Prm_Data_Ref(0) = 1\n"));
  EXPECT_EQ("D8", stationParameters("Ext_User_Prm_Data_Const(0) = 0x80\n"
                                    "Ext_User_Prm_Data_Ref(0) = 1\nExt_User_Prm_Data_Ref(0) = 2\n"));
  EXPECT_EQ("DE", stationParameters("Ext_User_Prm_Data_Const(0) = 0xFF\n"
                                    "Ext_User_Prm_Data_Ref(0) = 2\nExt_User_Prm_Data_Ref(0) = 7\n"));
}

TEST(GsdFile, EveryModuleHasItsOwnDefaults) {
  const GsdFile file = parseGsd(std::string{kReferences} +
                                "Ext_User_Prm_Data_Const(0) = 0x80\n"
                                "Module = \"A\" 0x10\n"
                                "1\n"
                                "Ext_Module_Prm_Data_Len = 4\n"
                                "Ext_User_Prm_Data_Const(0) = 0x01,0x02\n"
                                "Ext_User_Prm_Data_Ref(1) = 3\n"
                                "EndModule\n"
                                "Module = \"B\" 0x20\n"
                                "2\n"
                                "Ext_User_Prm_Data_Ref(0) = 4\n"
                                "EndModule\n");
  EXPECT_EQ("", problems(file));
  EXPECT_EQ("80", toHex(file.user_parameters));
  EXPECT_EQ("01 2A 00 00", toHex(file.module("A")->user_parameters)) << "filled up to Ext_Module_Prm_Data_Len";
  EXPECT_EQ("03 E8", toHex(file.module("B")->user_parameters));
}

// A definition may stand behind its first use.
TEST(GsdFile, DefinitionsCountWhereverTheyStand) {
  const GsdFile file = parseGsd(
      "#Profibus_DP\nIdent_Number=1\nExt_User_Prm_Data_Ref(0)=1\nExtUserPrmData=1 \"x\"\nUnsigned8 7 0-9\n"
      "EndExtUserPrmData\n");
  EXPECT_EQ("", problems(file));
  EXPECT_EQ("07", toHex(file.user_parameters));
}

TEST(GsdFile, ReferencesThatCannotBeFollowedAreNamed) {
  const GsdFile file = parseGsd(
      "#Profibus_DP\n"
      "Ident_Number=1\n"
      "ExtUserPrmData=1 \"a\"\n"
      "Float 1 0-9\n"
      "EndExtUserPrmData\n"
      "ExtUserPrmData=2 \"b\"\n"
      "Unsigned8 300 0-300\n"
      "EndExtUserPrmData\n"
      "ExtUserPrmData=3 \"c\"\n"
      "Bit(9) 1 0-1\n"
      "EndExtUserPrmData\n"
      "ExtUserPrmData=4 \"d\"\n"
      "Unsigned8\n"
      "EndExtUserPrmData\n"
      "ExtUserPrmData=\"e\"\n"
      "Unsigned8 1 0-1\n"
      "EndExtUserPrmData\n"
      "ExtUserPrmData=6 \"f\"\n"
      "Unsigned16 1 0-1\n"
      "EndExtUserPrmData\n"
      "ExtUserPrmData=7 \"g\"\n"
      "EndExtUserPrmData\n"
      "Ext_User_Prm_Data_Const(0)=1\n"
      "Ext_User_Prm_Data_Ref(0)=1\n"
      "Ext_User_Prm_Data_Ref(0)=99\n"
      "Ext_User_Prm_Data_Ref(236)=6\n"
      "Ext_User_Prm_Data_Ref=6\n");
  EXPECT_EQ(
      "4: ExtUserPrmData 1: \"Float 1 0-9\" is no data type and default of a parameter\n"
      "7: ExtUserPrmData 2: the default 300 does not fit into Unsigned8\n"
      "10: ExtUserPrmData 3: \"Bit(9) 1 0-1\" is no data type and default of a parameter\n"
      "13: ExtUserPrmData 4: \"Unsigned8\" is no data type and default of a parameter\n"
      "15: ExtUserPrmData without a number\n"
      "27: Ext_User_Prm_Data_Ref needs (offset) = number, in 237 bytes at most\n"
      "24: Ext_User_Prm_Data_Ref names ExtUserPrmData 1, which gives no default: the constant bytes are kept\n"
      "25: Ext_User_Prm_Data_Ref names ExtUserPrmData 99, which gives no default: the constant bytes are kept\n"
      "26: Ext_User_Prm_Data_Ref needs (offset) = number, in 237 bytes at most\n",
      problems(file));
  EXPECT_EQ("01", toHex(file.user_parameters));
}

// The least and the most of each type fit.
TEST(GsdFile, DefaultsAtTheEndOfTheirType) {
  for (const char* type : {"Unsigned8 255 0-255", "Unsigned8 0 0-255", "Signed8 127 -128-127", "Signed8 -128 -128-127",
                           "Signed8 - 5 -10-10", "Unsigned16 65535 0-65535", "Signed16 -32768 -32768-32767"}) {
    EXPECT_EQ("", problems(parseGsd("#Profibus_DP\nIdent_Number=1\nExtUserPrmData=1 \"a\"\n" + std::string(type) +
                                    "\nEndExtUserPrmData\n")))
        << type;
  }
  for (const char* type : {"Unsigned8 256 0-256", "Signed8 128 0-128", "Signed8 -129 -129-0"}) {
    EXPECT_NE("", problems(parseGsd("#Profibus_DP\nIdent_Number=1\nExtUserPrmData=1 \"a\"\n" + std::string(type) +
                                    "\nEndExtUserPrmData\n")))
        << type;
  }
}

// As editors on Windows save it: three bytes before the text.
TEST(GsdFile, AByteOrderMarkIsNoPartOfTheText) {
  const GsdFile file = parseGsd("\xEF\xBB\xBF#Profibus_DP\r\nIdent_Number=0x7531\r\n");
  EXPECT_EQ("", problems(file));
  EXPECT_EQ(0x7531, file.ident_number.value_or(0));
}

// However a file is cut, it is read to its end, and every problem names a line of it.
RC_GTEST_PROP(GsdFile, CutAnywhere, ()) {
  const std::string whole =
      std::string{kReferences} + "Ext_User_Prm_Data_Ref(1)=4\nExt_User_Prm_Data_Ref(0)=2\n" + kGsd0ba8;
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
