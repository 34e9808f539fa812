// What the drives of a configuration are told, and what their transport is.
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

TEST(MakeDrives, TellsTheTransportTheTimesOfTheirStops) {
  CycleConfig config = CycleBench::config();
  config.shutdown_timeout = seconds(42.0);
  const CycleBench bench{config};
  EXPECT_EQ(seconds(42.0), bench.transport.told_shutdown_timeout);
  EXPECT_EQ(config.drives[0].drive.drive_timeout, bench.transport.told_drive_timeout);
}

}  // namespace
}  // namespace nord_driver::cycle
