// The picture of nord_param scope.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tools/scope_svg.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ScopeRecord ramp(int cycles) {
  ScopeRecord record;
  record.drive = "left & right";
  for (int i = 0; i < cycles; ++i) {
    ScopeSample sample;
    sample.time = 0.01 * i;
    sample.answered = true;
    sample.output = {0x047F, {8192, 0, 0}};
    sample.input = {0x0B37, {static_cast<std::int16_t>(i * 16), 0, 0}};
    record.samples.push_back(sample);
  }
  return record;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(ScopeSvg, NamesWhatItShows) {
  ScopeRecord record = ramp(200);
  const std::string shares = scopeSvg(record);
  EXPECT_THAT(shares, HasSubstr("Drive left &amp; right<"));
  EXPECT_THAT(shares, HasSubstr(">actual value 1, % of P105<"));
  EXPECT_THAT(shares, HasSubstr(">time in s<"));
  EXPECT_THAT(shares, HasSubstr(">operation enabled<"));
  EXPECT_THAT(shares, Not(HasSubstr("current")));
  record.max_frequency = 50.0;
  record.current_word = 2;
  for (ScopeSample& sample : record.samples) sample.input.actual_values[1] = 1638;
  const std::string picture = scopeSvg(record);
  EXPECT_THAT(picture, HasSubstr(">setpoint 1, Hz<"));
  EXPECT_THAT(picture, HasSubstr(">frequency, Hz<"));
  EXPECT_THAT(picture, HasSubstr(">current, % of rated<"));
  EXPECT_EQ(6u, count(picture, "<polyline")) << "three curves, and three in the legend";
}

// Its words are shares of nothing in Hz: beside a frequency they are drawn on the axis of the other words.
TEST(ScopeSvg, NamesNoPositionAFrequency) {
  ScopeRecord record = ramp(200);
  record.max_frequency = 50.0;
  record.actual_value_is_frequency = false;
  const std::string one = scopeSvg(record);
  EXPECT_THAT(one, HasSubstr(">setpoint 1, Hz<"));
  EXPECT_THAT(one, HasSubstr(">actual value 1, %<"));
  EXPECT_THAT(one, Not(HasSubstr(">frequency, Hz<")));
  EXPECT_THAT(one, HasSubstr(">Hz<"));
  EXPECT_THAT(one, HasSubstr(">%<"));
  record.setpoint_is_frequency = false;
  const std::string both = scopeSvg(record);
  EXPECT_THAT(both, HasSubstr(">setpoint 1, %<"));
  EXPECT_THAT(both, HasSubstr(">actual value 1, %<"));
  EXPECT_THAT(both, Not(HasSubstr("Hz<")));
  EXPECT_EQ(1u, count(both, ">%<")) << "one axis";
}

// What nobody answered is no line; the band says so.
TEST(ScopeSvg, LeavesAGapWhereNobodyAnswered) {
  ScopeRecord record = ramp(300);
  const std::size_t whole = count(scopeSvg(record), "<polyline");
  for (std::size_t i = 100; i < 200; ++i) record.samples[i].answered = false;
  const std::string picture = scopeSvg(record);
  EXPECT_EQ(whole + 1, count(picture, "<polyline"));
  EXPECT_THAT(picture, HasSubstr(">no answer<"));
  EXPECT_EQ(2u, count(picture, ">operation enabled<"));
}

// An hour is as small a file as a second.
TEST(ScopeSvg, DrawsNoMoreThanCanBeSeen) {
  EXPECT_LT(scopeSvg(ramp(360'000)).size(), 100'000u);
}

TEST(ScopeSvg, RefusesWhatIsNoTime) {
  EXPECT_THROW(scopeSvg(ramp(1)), UsageError);
}

std::string contentsOf(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// doc/pictures/README.md says how both are made.
TEST(ScopeSvg, IsThePictureOfTheDocuments) {
  const std::string base = NORD_DRIVER_SOURCE_DIR "/doc/pictures/scope";
  const std::string values = contentsOf(base + ".csv");
  ASSERT_FALSE(values.empty());
  EXPECT_EQ(contentsOf(base + ".svg"), scopeSvg(readScopeCsv(values)))
      << "nord_param scope left --from doc/pictures/scope.csv --svg doc/pictures/scope.svg";
}

}  // namespace
}  // namespace nord_driver::tools
