#include <gtest/gtest.h>

#include "nord_driver/profile/fault_text.h"

namespace nord_driver::profile {
namespace {

// P700 carries the printed number times ten.
TEST(FaultText, NamesTheNumberAsTheDisplayDoes) {
  EXPECT_EQ("E10.2", faultName(102));
  EXPECT_EQ("E1.0", faultName(10));
  EXPECT_EQ("no fault", faultName(0));
  EXPECT_EQ("fault of unknown number", faultName(65535));
}

TEST(FaultText, KnowsTheFaultsOfTheBus) {
  const std::string unlisted = faultText(7);
  for (const unsigned raw : {0u, 100u, 101u, 102u, 103u, 104u, 105u, 106u, 107u, 108u, 109u, 65535u}) {
    EXPECT_NE(unlisted, faultText(static_cast<std::uint16_t>(raw))) << raw;
  }
  EXPECT_NE(std::string(faultText(102)), faultText(103));
}

}  // namespace
}  // namespace nord_driver::profile
