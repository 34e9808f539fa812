#include <gtest/gtest.h>

#include <string>

#include "profile/fault_table.h"
#include "profile/fault_text.h"

namespace nord_driver::profile {
namespace {

bool holds(const char* text, const char* part) {
  return std::string(text).find(part) != std::string::npos;
}

// P700 carries the printed number times ten.
TEST(FaultText, NamesTheNumberAsTheDisplayDoes) {
  EXPECT_EQ("E10.2", faultName(102));
  EXPECT_EQ("E1.0", faultName(10));
  EXPECT_EQ("E100.0", faultName(1000));
  EXPECT_EQ("no fault", faultName(0));
  EXPECT_EQ("fault of unknown number", faultName(65535));
}

// BU 2700 8.3, BU 0220 6.2.1, BU 0020 8.1: what the manuals tell the technician to check.
TEST(FaultText, SaysOfTheBusFaultsWhatTheManualsSay) {
  EXPECT_STREQ("PROFIBUS telegram failure", faultText(102));
  EXPECT_TRUE(holds(faultRemedy(100), "P513"));
  EXPECT_TRUE(holds(faultCause(102), "watchdog"));
  EXPECT_TRUE(holds(faultRemedy(102), "PLC"));
  EXPECT_TRUE(holds(faultCause(103), "bit 10"));
  EXPECT_TRUE(holds(faultRemedy(103), "P151"));
  EXPECT_TRUE(holds(faultRemedy(104), "P746"));
  EXPECT_TRUE(holds(faultCause(108), "between bus module and inverter"));
  EXPECT_TRUE(holds(faultRemedy(109), "P120"));
  EXPECT_TRUE(holds(faultRemedy(5010), "3 .. 125"));
}

// 10.6 is the Ethernet cable in one series and a fault inside the module in another: the reader is told.
TEST(FaultText, SaysWhereTheMeaningDependsOnTheSeries) {
  EXPECT_TRUE(holds(faultCause(106), "in other series"));
  for (const unsigned raw : {101u, 106u, 120u, 138u, 170u, 180u, 190u}) {
    EXPECT_TRUE(holds(faultRemedy(static_cast<std::uint16_t>(raw)), "see the inverter's manual")) << raw;
  }
}

// 0 is no fault, 65535 one without a number, and a number nobody described is said to be so.
TEST(FaultText, AnswersForEveryNumber) {
  EXPECT_STREQ("no fault", faultText(0));
  EXPECT_STREQ("", faultCause(0));
  EXPECT_STREQ("", faultRemedy(0));
  EXPECT_STREQ("fault; its number could not be read", faultText(65535));
  EXPECT_STREQ("a fault number this driver does not list", faultText(7));
  for (unsigned raw = 1; raw <= 65535; ++raw) {
    const auto number = static_cast<std::uint16_t>(raw);
    ASSERT_STRNE("", faultText(number)) << raw;
    ASSERT_STRNE("", faultCause(number)) << raw;
    ASSERT_STRNE("", faultRemedy(number)) << raw;
  }
}

// The numbers of P700 in the sources, typed here a second time: each has its row, and its row alone.
TEST(FaultTable, ListsEveryKnownNumber) {
  const unsigned known[] = {
      10,  11,  20,  21,  22,  30,  31,   32,   33,   34,   37,   40,   41,   50,   51,   60,   61,  70,  71,  80,
      81,  82,  84,  87,  90,  91,  92,   93,   94,   95,   96,   97,   98,   99,   100,  101,  102, 103, 104, 105,
      106, 107, 108, 109, 110, 120, 121,  122,  123,  124,  125,  128,  129,  130,  131,  132,  133, 138, 139, 160,
      161, 162, 170, 180, 185, 186, 190,  191,  192,  200,  201,  202,  203,  204,  205,  206,  207, 208, 213, 214,
      900, 910, 911, 912, 913, 990, 1000, 1010, 1020, 1030, 5000, 5010, 5020, 5210, 5211, 5212, 5220};
  const FaultInfo* row = faultTable().begin();
  for (const unsigned raw : known) {
    ASSERT_NE(faultTable().end(), row);
    ASSERT_EQ(raw, row->raw);
    EXPECT_EQ(row, findFault(static_cast<std::uint16_t>(raw)));
    ++row;
  }
  EXPECT_EQ(faultTable().end(), row);
  EXPECT_EQ(nullptr, findFault(0));
  EXPECT_EQ(nullptr, findFault(112));
  EXPECT_EQ(nullptr, findFault(65535));
}

}  // namespace
}  // namespace nord_driver::profile
