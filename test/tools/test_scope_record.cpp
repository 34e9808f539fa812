// What a drive did, in the CSV of nord_param scope and out of a trace of the driver.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tools/first_words.h"
#include "tools/restore/scripted_drive.h"
#include "tools/scope_record.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {
namespace {

using ::testing::HasSubstr;

template <typename Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(ScopeCsv, KeepsEverything) {
  ScopeRecord record;
  record.drive = "left";
  record.max_frequency = 70.0;
  record.current_word = 2;
  ScopeSample sample;
  sample.time = 0.01;
  sample.answered = true;
  sample.output = {0x047F, {8192, 0, -1}};
  sample.input = {0x0B37, {-16384, 5, 0}};
  record.samples = {ScopeSample{}, sample};
  const std::string csv = scopeCsv(record);
  EXPECT_THAT(csv, HasSubstr("0.010000,1,047F,8192,0,-1,0B37,-16384,5,0,35.000,-70.000\n"));
  const ScopeRecord read = readScopeCsv(csv);
  EXPECT_EQ("left", read.drive);
  EXPECT_EQ(70.0, read.max_frequency);
  EXPECT_EQ(2, read.current_word);
  ASSERT_EQ(2u, read.samples.size());
  EXPECT_FALSE(read.samples[0].answered);
  EXPECT_TRUE(read.samples[1].answered);
  EXPECT_EQ(0.01, read.samples[1].time);
  EXPECT_EQ(sample.output, read.samples[1].output);
  EXPECT_EQ(sample.input, read.samples[1].input);
}

TEST(ScopeJson, HasTheCyclesOfTheCsv) {
  ScopeRecord record;
  record.drive = "left";
  ScopeSample sample;
  sample.time = 0.01;
  sample.answered = true;
  sample.output = {0x047F, {8192, 0, -1}};
  sample.input = {0x0B37, {-16384, 5, 0}};
  record.samples = {ScopeSample{}, sample};
  EXPECT_EQ(
      R"({"drive": "left", "time_s": 0, "answered": false, "STW": "0000", "SW1": 0, "SW2": 0, "SW3": 0, "ZSW": "0000", "IW1": 0, "IW2": 0, "IW3": 0}
{"drive": "left", "time_s": 0.01, "answered": true, "STW": "047F", "SW1": 8192, "SW2": 0, "SW3": -1, "ZSW": "0B37", "IW1": -16384, "IW2": 5, "IW3": 0}
)",
      scopeJson(record));
  record.max_frequency = 70.0;
  EXPECT_THAT(scopeJson(record), HasSubstr(R"("IW3": 0, "setpoint_Hz": 35, "frequency_Hz": -70})"));
}

// Over DeviceNet nothing is exchanged: what nobody has told is no 0, in no form and when it is read again.
TEST(ScopeRecord, HasNoWordsWhereNoneAreExchanged) {
  ScopeRecord record;
  record.drive = "left";
  record.max_frequency = 50.0;
  record.commands_known = record.words_known = false;
  ScopeSample sample;
  sample.time = 0.01;
  sample.answered = true;
  sample.output.control_word = 0x047E;
  sample.input.status_word = 0x0237;
  record.samples = {ScopeSample{}, sample};
  const std::string csv = scopeCsv(record);
  EXPECT_THAT(csv, HasSubstr("\n0.010000,1,,,,,0027,,,,,\n"));
  const ScopeRecord read = readScopeCsv(csv);
  EXPECT_EQ(csv, scopeCsv(read));
  EXPECT_FALSE(read.commands_known || read.words_known);
  EXPECT_EQ(0x0027, read.samples.at(1).input.status_word);
  EXPECT_THAT(
      scopeJson(record),
      HasSubstr(
          R"("answered": true, "STW": null, "SW1": null, "SW2": null, "SW3": null, "ZSW": null, "IW1": null, "IW2": null, "IW3": null, "state": "operation enabled"})"));
  record.words_known = true;  // on InterBus words come, and none are sent
  EXPECT_THAT(scopeCsv(record), HasSubstr("\n0.010000,1,,,,,0237,0,0,0,,0.000\n"));
  EXPECT_EQ(scopeCsv(record), scopeCsv(readScopeCsv(scopeCsv(record))));
}

// A word that is a position has no frequency, in no form and when it is read again; the other one keeps its own.
TEST(ScopeRecord, HasNoFrequencyOfAPosition) {
  ScopeRecord record;
  record.drive = "lift";
  record.max_frequency = 70.0;
  ScopeSample sample;
  sample.output = {0x047F, {8192, 0, 0}};
  sample.input = {0x0B37, {-16384, 0, 0}};
  record.samples = {sample};
  record.actual_value_is_frequency = false;
  EXPECT_THAT(scopeCsv(record), HasSubstr(",0B37,-16384,0,0,35.000,\n"));
  EXPECT_THAT(scopeJson(record), HasSubstr(R"("IW3": 0, "setpoint_Hz": 35})"));
  const ScopeRecord read = readScopeCsv(scopeCsv(record));
  EXPECT_TRUE(read.setpoint_is_frequency);
  EXPECT_FALSE(read.actual_value_is_frequency);

  record.setpoint_is_frequency = false;
  record.actual_value_is_frequency = true;
  EXPECT_THAT(scopeCsv(record), HasSubstr(",0B37,-16384,0,0,,-70.000\n"));
  EXPECT_THAT(scopeJson(record), HasSubstr(R"("IW3": 0, "frequency_Hz": -70})"));
  EXPECT_FALSE(readScopeCsv(scopeCsv(record)).setpoint_is_frequency);
  EXPECT_TRUE(readScopeCsv(scopeCsv(record)).actual_value_is_frequency);
}

// An SK 5xxE: 23 and 10 are positions, 1 is the frequency. What cannot be read may be a position.
TEST(ScopeRecord, TakesFromTheDriveWhatItsFirstWordsAre) {
  ScopeRecord record;
  ScriptedDrive lift{{{"P543", 1}, {"P546", 23}}};
  readFirstWords(lift, record);
  EXPECT_FALSE(record.setpoint_is_frequency);
  EXPECT_TRUE(record.actual_value_is_frequency);
  ScriptedDrive other{{{"P543", 10}, {"P546", 1}}};
  readFirstWords(other, record);
  EXPECT_TRUE(record.setpoint_is_frequency);
  EXPECT_FALSE(record.actual_value_is_frequency);
  ScriptedDrive silent{{{"P546", 1}}};
  readFirstWords(silent, record);
  EXPECT_FALSE(record.actual_value_is_frequency);
}

// SK 2xxE has both in arrays, and the codes of SK 700E are others: 3 and 6 the position, 10 one in increments.
TEST(FirstWords, AreAskedForAsTheSeriesHasThem) {
  const auto array = firstWordFunction(profile::Series::kSk2xxe, true, 2);
  EXPECT_EQ(543, array.number);
  EXPECT_EQ(1, array.index);
  EXPECT_EQ(2, array.parameter_set);
  EXPECT_EQ(546, firstWordFunction(profile::Series::kSk2xxe, false, 0).number);
  EXPECT_EQ(0, firstWordFunction(profile::Series::kSk700e, true, 0).index);
  ParameterAnswer answer;
  answer.success = true;
  for (const int code : {6, 10, 0, 99}) {
    answer.raw = code;
    EXPECT_FALSE(saysFrequency(answer, profile::Series::kSk700e, true)) << code;
  }
  answer.raw = 3;
  EXPECT_FALSE(saysFrequency(answer, profile::Series::kSk700e, false));
  answer.raw = 1;
  EXPECT_TRUE(saysFrequency(answer, profile::Series::kSk700e, true));
  EXPECT_TRUE(saysFrequency(answer, profile::Series::kSk700e, false));
}

TEST(ScopeCsv, NamesALineThatIsNoCycle) {
  EXPECT_THAT(refusal([] { readScopeCsv("# drive: left\n0.1,1,047F,a\n"); }),
              HasSubstr("line 2: \"0.1,1,047F,a\" is no cycle, expected time_s,answered,"));
  // Out of the range of a word, no number, and a word of too many digits.
  for (const char* line : {"0.1,1,047F,40000,0,0,0B37,0,0,0,,", "x,1,047F,0,0,0,0B37,0,0,0,,",
                           "0.1,1,1047F,0,0,0,0B37,0,0,0,,", "0.1,1,047F,0,0,0,0B37,0,0,,,"}) {
    EXPECT_THAT(refusal([line] { readScopeCsv(std::string(line) + "\n"); }), HasSubstr("is no cycle")) << line;
  }
}

// As src/trace writes them: two cycles in the table, three answers among the telegrams.
constexpr char kProfibus[] = R"(nord_driver 1.0.0 trace
reason: asked for
time 0: 2026-11-23 05:00:00.000000 UTC
drive left: PROFIBUS station 3
drive right: PROFIBUS station 4

process data: time in s, words hexadecimal, ---- where the inverter did not answer in that cycle
          time  drive  STW  SW1  SW2  SW3   ZSW  IW1  IW2  IW3
     -0.010000  left   047F 2000 0000 0000  0B37 1FFF 0000 0000
     -0.010000  right  047F E000 0000 0000  1337 E000 0000 0000
      0.000000  left   047E 0000 0000 0000  ---- ---- ---- ----
      0.000000  right  047F E000 0000 0000  1337 E000 0000 0000

)";
constexpr char kTelegrams[] = R"(telegrams, 7: time in s, > sent, < received, ? bytes that are no telegram
     -0.022050 > 68 0F 0F 68 03 01 5D 00 16                              DX 3 <- 1 PKW 1 0000 STW 047F SW1 2000
     -0.021062 < 68 0F 0F 68 01 03 08 00 16                              DX 1 <- 3 ZSW 0B37 IW1 1000
     -0.020988 > 68 0F 0F 68 04 01 7D 00 16                              DX 4 <- 1 STW 047F SW1 E000
     -0.011062 < 68 0F 0F 68 01 03 08 00 16                              DX 1 <- 3 ZSW 0B37 IW1 1FFF
     -0.010000 < 68 0F 0F 68 01 04 08 00 16                              DX 1 <- 4 ZSW 1337 IW1 E000
     -0.002050 ? 68 0F                                                   no telegram
     -0.001062 < 68 0F 0F 68 01 03 08 00 16                              DX 1 <- 3 ZSW 0B3F IW1 0000
)";

TEST(ScopeTrace, ReadsTheTelegramsOfADrive) {
  const ScopeRecord left = readScopeTrace(std::string(kProfibus) + kTelegrams, "left");
  EXPECT_EQ("left", left.drive);
  ASSERT_EQ(3u, left.samples.size());
  EXPECT_DOUBLE_EQ(-0.021062, left.samples[0].time);
  EXPECT_EQ(0x047F, left.samples[0].output.control_word);
  EXPECT_EQ(0x2000, left.samples[0].output.setpoints[0]);
  EXPECT_EQ(0x1000, left.samples[0].input.actual_values[0]);
  EXPECT_EQ(0x0B3F, left.samples[2].input.status_word);
}

// A transport that keeps no telegrams, or none in words.
TEST(ScopeTrace, ReadsTheTableWhereThereIsNothingElse) {
  const ScopeRecord left = readScopeTrace(std::string(kProfibus) + "telegrams: this transport keeps none\n", "left");
  ASSERT_EQ(2u, left.samples.size());
  EXPECT_TRUE(left.samples[0].answered);
  EXPECT_EQ(0x1FFF, left.samples[0].input.actual_values[0]);
  EXPECT_FALSE(left.samples[1].answered);
  EXPECT_EQ(0x047E, left.samples[1].output.control_word);
  const ScopeRecord right = readScopeTrace(std::string(kProfibus) + kTelegrams, "right");
  ASSERT_EQ(2u, right.samples.size()) << "of the table: one telegram is less";
  EXPECT_EQ(-8192, right.samples[0].output.setpoints[0]);
}

ScopeRecord oneTelegram(const std::string& address, const std::string& words) {
  return readScopeTrace("x\ndrive lift: " + address + "\ntelegrams, 1:\n      0.5 < 01 02  " + words + "\n", "lift");
}

// Each bus has its own words for whose telegram it is.
TEST(ScopeTrace, FindsTheDriveOnEveryBus) {
  const struct {
    const char* address;
    const char* telegram;
  } kCases[] = {
      {"PROFIBUS station 3, inverter 2", "DX 1 <- 3 FI1 ZSW 0B31 IW1 0000 FI2 ZSW 0B37 IW1 2000"},
      {"CANopen node 50", "TPDO 50 ZSW 0B37 IW1 2000"},
      {"CANopen node 50, inverter 2", "TPDO 50/2 ZSW 0B37 IW1 2000"},
      {"DeviceNet MAC id 5", "answer 5 ZSW 0B37 IW1 2000"},
      {"DeviceNet MAC id 5, inverter 1", "answer 5 ZSW 0B37 IW1 2000"},
      {"DeviceNet MAC id 5, inverter 2", "answer 5 inverter 1 ZSW 0B31 IW1 0000 inverter 2 ZSW 0B37 IW1 2000"},
      {"InterBus position 1", "read 0 to 3: other ZSW 0B31 IW1 0000, lift ZSW 0B37 IW1 2000"}};
  for (const auto& one : kCases) {
    const ScopeRecord record = oneTelegram(one.address, one.telegram);
    ASSERT_EQ(1u, record.samples.size()) << one.address;
    EXPECT_EQ(0x0B37, record.samples[0].input.status_word) << one.address;
    EXPECT_EQ(0x2000, record.samples[0].input.actual_values[0]) << one.address;
  }
}

TEST(ScopeTrace, NamesADriveThatIsNotInIt) {
  EXPECT_EQ("drive \"lift\" is not in this trace", refusal([] { readScopeTrace(kProfibus, "lift"); }));
  EXPECT_EQ("this trace has no process data of drive \"lift\"",
            refusal([] { oneTelegram("CANopen node 50", "TPDO 51 ZSW 0B37 IW1 2000"); }));
}

}  // namespace
}  // namespace nord_driver::tools
