// Under which name a drive's EEPROM writes are counted.
#include <gtest/gtest.h>

#include <memory>

#include "support/map_settings.h"
#include "tools/counted_write.h"

namespace nord_driver::tools {
namespace {

std::string countedAs(const std::string& series) {
  const test::MapSettings settings{"drives/left/", {{"address", 3}, {"series", series}}};
  return state::nameOf(placeOf("/dev/ttyUSB0", "profibus_dp", {"left", std::make_shared<test::MapSettings>(settings)}));
}

// One drive has one budget, however its series is written: as the series or as on the nameplate.
TEST(CountedWrite, EverySpellingOfASeriesHasOneCount) {
  const std::string name = "/dev/ttyUSB0, address 3, inverter 1, sk5xxe";
  for (const char* series : {"sk5xxe", "SK5xxE", "sk535e", "SK 535E", "SK 535E-750-340-A"}) {
    EXPECT_EQ(name, countedAs(series)) << series;
  }
  EXPECT_EQ("/dev/ttyUSB0, address 3, inverter 1, sk54xe", countedAs("SK 540E-750-340-A"));
}

}  // namespace
}  // namespace nord_driver::tools
