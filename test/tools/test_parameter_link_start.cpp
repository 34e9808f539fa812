// For how long nord_param waits for the first answer: its transport listens first, and the file is the driver's.
#include <gtest/gtest.h>

#include "tools/linked_drive.h"

namespace nord_driver::tools {
namespace {

catalogue::ParameterAddress maximumFrequency() {
  catalogue::ParameterAddress address;
  address.number = 105;
  return address;
}

// Longer than it waits for an answer: nothing is sent meanwhile, and nobody can answer.
TEST(ParameterLinkStart, WaitsForAsLongAsItsTransportListens) {
  YAML::Node file = LinkedDrive::file();
  file["bus"]["listen_first"] = 8.0;
  LinkedDrive drive{file};
  EXPECT_EQ("", drive.trouble());
  EXPECT_TRUE(drive.link().read(maximumFrequency()).success);
}

// Behind a USB adapter every silent address costs 50 ms, twice.
TEST(ParameterLinkStart, AsksNoFurtherStationsWhereTheDriverScansTheBus) {
  YAML::Node file = LinkedDrive::file();
  file["bus"]["scan"] = true;
  file["bus"]["slot_time"] = 0.05;
  file["bus"]["watchdog"] = 0.6;
  LinkedDrive drive{file};
  EXPECT_EQ("", drive.trouble());
  EXPECT_TRUE(drive.link().read(maximumFrequency()).success);
}

}  // namespace
}  // namespace nord_driver::tools
