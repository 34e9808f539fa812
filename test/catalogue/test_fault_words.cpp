// A fault number in words, whatever number comes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalogue/fault_words.h"
#include "catalogue/shipped.h"
#include "profile/fault_number.h"

namespace nord_driver::catalogue {
namespace {

using profile::Series;
using ::testing::HasSubstr;

FaultWords of(Series series = Series::kSk5xxe) {
  return {shippedFaults(), series};
}

TEST(FaultWords, LabelTheNumberAsTheDisplayDoes) {
  EXPECT_EQ("E10.2", FaultWords::label(102));
  EXPECT_EQ("E1.0", FaultWords::label(10));
  EXPECT_EQ("no fault", FaultWords::label(0));
  EXPECT_EQ("fault of unknown number", FaultWords::label(profile::kFaultNumberUnknown));
}

// BU 0020 8.1, BU 2700 8.3; the same number in words of its own behind SK 2xxE (BU 0220 6.2.1) and in SK 700E.
TEST(FaultWords, SayOfTheBusFaultsWhatTheManualsOfTheSeriesSay) {
  EXPECT_THAT(of().remedy(100), HasSubstr("P513"));
  EXPECT_THAT(of().cause(102), HasSubstr("watchdog"));
  EXPECT_THAT(of().cause(103), HasSubstr("bit 10"));
  EXPECT_THAT(of().remedy(103), HasSubstr("P151"));
  EXPECT_THAT(of().remedy(104), HasSubstr("P746"));
  EXPECT_THAT(of().remedy(109), HasSubstr("P120"));
  EXPECT_EQ("timeout by P151", of(Series::kSk2xxe).name(103));
  EXPECT_EQ("system error of the option (10.3)", of(Series::kSk700e).name(103));
}

// A number everybody has the same words for.
TEST(FaultWords, FallBackToWhatHoldsForAll) {
  for (const Series series : profile::kAllSeries) EXPECT_EQ("motor overtemperature (I2t)", of(series).name(21));
  EXPECT_THAT(of().cause(21), HasSubstr("too hot"));
}

TEST(FaultWords, AnswerForEveryNumber) {
  EXPECT_EQ("no fault", of().name(0));
  EXPECT_EQ("", of().cause(0));
  EXPECT_EQ("", of().remedy(0));
  EXPECT_EQ("fault; its number could not be read", of().name(65535));
  EXPECT_EQ("a fault number this driver does not list", of().name(7));
  for (const Series series : profile::kAllSeries) {
    for (unsigned raw = 1; raw <= 0xFFFF; ++raw) {
      const auto number = static_cast<std::uint16_t>(raw);
      ASSERT_NE("", of(series).name(number)) << raw;
      // Where nobody says, the log leaves it out.
      ASSERT_NE("", of(series).cause(number) + of(series).remedy(number)) << raw;
    }
  }
}

}  // namespace
}  // namespace nord_driver::catalogue
